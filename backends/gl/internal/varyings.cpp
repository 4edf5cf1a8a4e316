#include "backends/gl/internal/varyings.h"

#include <map>

namespace rastercheck::backends::gl {
namespace {

VaryingClass class_of(const cases::Attribute& attribute, int samples) {
  VaryingClass varies{attribute.interpolation, attribute.location};
  const bool is_flat = attribute.interpolation == cases::Interpolation::flat;
  if (is_flat || samples == 1) varies.location = cases::Location::center;
  return varies;
}

}  // namespace

std::vector<Pass> pack(const std::vector<cases::Attribute>& attributes, int samples,
                       std::size_t most) {
  std::map<VaryingClass, std::vector<std::size_t>> classes;
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    classes[class_of(attributes[i], samples)].push_back(i);
  }
  std::vector<Pass> passes(1);
  for (const auto& [varies, members] : classes) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i % 4 == 0) {
        if (passes.back().size() == most) passes.emplace_back();
        passes.back().push_back({varies, {}, 0});
      }
      Varying& last = passes.back().back();
      last.attributes[last.count++] = members[i];
    }
  }
  return passes;
}

}  // namespace rastercheck::backends::gl
