#include "properties/law.h"

#include <algorithm>
#include <cassert>

#include "properties/generator.h"

namespace rastercheck::properties {
namespace {

std::vector<Law>& registry() {
  static std::vector<Law> all;
  return all;
}

}  // namespace

LawRegistration::LawRegistration(const Law& law) {
  const auto after = std::find_if(registry().begin(), registry().end(),
                                  [&law](const Law& other) { return other.name > law.name; });
  registry().insert(after, law);
}

std::span<const Law> laws() { return registry(); }

const Law* find_law(std::string_view name) {
  const auto found = std::find_if(registry().begin(), registry().end(),
                                  [name](const Law& law) { return law.name == name; });
  return found == registry().end() ? nullptr : &*found;
}

bool is_promised(const Law& law, const backends::Backend& backend) {
  return law.is_promised == nullptr || law.is_promised(backend);
}

Generated generate_any(Draw& draw) {
  const std::span<const Generator> all = generators();
  assert(!all.empty());
  const int chosen = draw.between(0, static_cast<int>(all.size()) - 1);
  const Generator& generator = all[static_cast<std::size_t>(chosen)];
  return {generator.make(draw), std::string(generator.name)};
}

}  // namespace rastercheck::properties
