#include "properties/generator.h"

#include <algorithm>
#include <vector>

namespace rastercheck::properties {
namespace {

std::vector<Generator>& generator_registry() {
  static std::vector<Generator> all;
  return all;
}

}  // namespace

GeneratorRegistration::GeneratorRegistration(const Generator& generator) {
  // Files register in an order that the linker chooses. Sorting by name makes a random number pick
  // the same generator in every build.
  const auto after =
      std::find_if(generator_registry().begin(), generator_registry().end(),
                   [&generator](const Generator& other) { return other.name > generator.name; });
  generator_registry().insert(after, generator);
}

std::span<const Generator> generators() { return generator_registry(); }

const Generator* find_generator(std::string_view name) {
  const auto found =
      std::find_if(generator_registry().begin(), generator_registry().end(),
                   [name](const Generator& generator) { return generator.name == name; });
  return found == generator_registry().end() ? nullptr : &*found;
}

}  // namespace rastercheck::properties
