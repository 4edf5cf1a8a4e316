#pragma once

// Makes a run's cases and backends again and draws the cases, for everything that inspects a run.

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case.h"
#include "cases/clip_case.h"
#include "properties/campaign/frozen_case.h"
#include "properties/campaign/known_defects.h"
#include "properties/inspect/case_to_draw.h"
#include "properties/inspect/focus.h"
#include "properties/inspect/inspect.h"
#include "records/case_record.h"
#include "records/inspection.h"
#include "records/plan.h"

namespace rastercheck::properties {

/// The sources of a run's cases, other than its seed.
struct CaseSources {
  std::span<const cases::Case> corpus = {};
  std::span<const cases::Case> saved = {};  ///< counterexamples of earlier runs
  KnownByBackend known = {};
  const cases::Case* scene = nullptr;  ///< without a camera; nullptr: none
};

/// Draws cases with backends that it makes on first use. Keeps the drawings, so that an inspection
/// and a specimen of the same case share one.
class CaseDrawer {
 public:
  explicit CaseDrawer(backends::BackendFactory factory) : factory_(std::move(factory)) {}

  /// Returns the backend; nullptr if it can no longer be made or is lost.
  backends::Backend* find(const std::string& specification);
  /// Returns a drawing, valid until the next call; nullptr if the case cannot be drawn.
  const backends::Drawn* draw(const cases::ClipCase& c, const std::string& specification);

 private:
  struct Kept {
    std::string specification;
    cases::ClipCase source;
    backends::Drawn drawn;
  };

  backends::BackendFactory factory_;
  std::map<std::string, std::unique_ptr<backends::Backend>> made_;
  std::vector<Kept> kept_;
  std::size_t fragments_ = 0;  ///< of all kept drawings
};

/// A triangle, and a case that contains it and little else.
struct CasePart {
  cases::ClipCase source;      ///< as drawn (case_to_draw)
  std::uint32_t triangle = 0;  ///< index into the triangles of `source`
};

/// Returns the case, or the triangle alone if the case is large; empty if the triangle does not
/// exist or cannot be drawn.
std::optional<CasePart> part_of(const cases::Case& c, std::uint32_t triangle);

/// Draws and inspects a part. Empty if it cannot be drawn or has no such sample or value.
std::optional<records::Inspection> inspect_part(const cases::Case& c,
                                                const std::string& specification, Focus focus,
                                                CaseDrawer& drawer, const InspectOptions& options);

/// True if the sample in focus has exactly this value.
bool shows(const records::Inspection& inspection, std::optional<std::uint32_t> attribute,
           float actual);

}  // namespace rastercheck::properties
