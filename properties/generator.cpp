#include "properties/generator.h"

#include <algorithm>
#include <vector>

namespace rastercheck::properties {
namespace {

std::vector<Generator>& generator_registry() {
  static std::vector<Generator> all;
  return all;
}

std::vector<Generator>& general_registry() {
  static std::vector<Generator> all;
  return all;
}

void insert_by_name(std::vector<Generator>& all, const Generator& generator) {
  const auto after = std::find_if(all.begin(), all.end(), [&generator](const Generator& other) {
    return other.name > generator.name;
  });
  all.insert(after, generator);
}

}  // namespace

GeneratorRegistration::GeneratorRegistration(const Generator& generator) {
  // Files register in an order that the linker chooses. Sorting by name makes a random number pick
  // the same generator in every build.
  insert_by_name(generator_registry(), generator);
  if (generator.is_for_all_laws) insert_by_name(general_registry(), generator);
}

std::span<const Generator> generators() { return generator_registry(); }

std::span<const Generator> general_generators() { return general_registry(); }

const Generator* find_generator(std::string_view name) {
  const auto found =
      std::find_if(generator_registry().begin(), generator_registry().end(),
                   [name](const Generator& generator) { return generator.name == name; });
  return found == generator_registry().end() ? nullptr : &*found;
}

}  // namespace rastercheck::properties
