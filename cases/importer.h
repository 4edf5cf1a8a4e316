#pragma once

// Importers: files of other programs that become cases. A file in cases/importers/ defines one and
// registers it:
//
//   const ImporterRegistration kRegistration(
//       {"renderdoc-csv", "vertices that RenderDoc exported …", &recognises, &import});
//
// docs/adding-an-importer.md walks through it. Meshes have a way of their own (mesh_process.h),
// because scenes are read by it as well.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/topology.h"

namespace rastercheck::cases {

/// What the user says about a drawing because its file does not. An importer guesses what is empty.
struct ImportOptions {
  std::optional<int> width;                      ///< of the framebuffer, in pixels, 1…kMaxSize
  std::optional<int> height;                     ///< likewise
  std::optional<int> samples;                    ///< per pixel
  std::optional<std::array<float, 4>> viewport;  ///< x, y, width, height; else the framebuffer
  std::optional<Rules> rules;
  std::optional<Topology> topology;
  std::optional<Cull> cull;
  std::optional<FrontFace> front_face;
  std::vector<std::string> flat;           ///< names of attributes that do not vary
  std::vector<std::string> noperspective;  ///< names of attributes that vary in window space
  bool round = false;                      ///< take the nearest float32 of decimals
  bool operator==(const ImportOptions&) const = default;
};

struct Imported {
  Case drawn;
  /// One sentence for each guess and each thing left out, for the user to check.
  std::vector<std::string> notes;
};

struct Importer {
  std::string_view name;
  std::string_view summary;
  /// True if a text, or its beginning, has this format.
  bool (*recognises)(std::string_view text);
  /// Makes a case of a text. `file` is the name used in errors.
  Result<Imported> (*import)(std::string_view text, const std::string& file,
                             const ImportOptions& options);
};

/// All importers, in the order of their names.
std::span<const Importer> importers();
/// The importer with that name; nullptr if none.
const Importer* find_importer(std::string_view name);
/// The importer that recognises a text; nullptr if none.
const Importer* importer_of(std::string_view text);

struct ImporterRegistration {
  explicit ImporterRegistration(const Importer& importer);
};

}  // namespace rastercheck::cases
