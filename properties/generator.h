#pragma once

// Generators: where cases come from. A file in properties/generators/ defines one and registers it:
//
//   const GeneratorRegistration kRegistration({"slivers", "triangles as thin as …", &make});
//
// docs/adding-a-generator.md walks through it.

#include <span>
#include <string_view>

#include "cases/case.h"
#include "properties/draw.h"

namespace rastercheck::properties {

/// Makes cases of one kind, which the records call a stratum.
struct Generator {
  std::string_view name;
  std::string_view summary;
  /// Makes a valid case of at most 4,096 pixels (64×64, or wider and lower) with clip positions (no
  /// camera) and an empty name.
  cases::Case (*make)(Draw& draw);
  /// False if only laws that name the generator use it (find_generator()), because other laws
  /// assume what its cases do not keep.
  bool is_for_all_laws = true;
};

/// All generators, in the order of their names.
std::span<const Generator> generators();
/// The generators whose cases all laws draw, in the same order.
std::span<const Generator> general_generators();
/// The generator with that name; nullptr if none.
const Generator* find_generator(std::string_view name);

struct GeneratorRegistration {
  explicit GeneratorRegistration(const Generator& generator);
};

}  // namespace rastercheck::properties
