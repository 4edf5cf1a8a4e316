#include "backends/gl/internal/varyings.h"

#include <algorithm>

namespace rastercheck::backends::gl {
namespace {

using cases::Interpolation;
using cases::Location;

using Classes = std::vector<VaryingClass>;

VaryingClass class_of(const cases::Attribute& attribute, int samples) {
  VaryingClass varies{attribute.interpolation, attribute.location};
  if (attribute.interpolation == Interpolation::flat || samples == 1) {
    varies.location = Location::center;
  }
  return varies;
}

/// All classes at these locations: smooth, and noperspective if available.
Classes classes_at(const std::vector<Location>& locations, bool has_noperspective) {
  Classes classes;
  for (const Location location : locations) {
    classes.push_back({Interpolation::smooth, location});
    if (has_noperspective) classes.push_back({Interpolation::noperspective, location});
  }
  return classes;
}

/// Puts the attribute into the first pass from `begin` on that has room, or into a new pass.
void put(std::size_t attribute, const VaryingClass& varies, const Classes& classes,
         std::size_t begin, std::vector<Pass>& passes) {
  for (std::size_t i = begin;; ++i) {
    if (i == passes.size()) {
      Pass& pass = passes.emplace_back();
      for (const VaryingClass& one : classes) pass.push_back({one, {}, 0});
    }
    const auto varying =
        std::find_if(passes[i].begin(), passes[i].end(),
                     [&](const Varying& candidate) { return candidate.varies == varies; });
    if (varying == passes[i].end()) return;
    if (varying->count == varying->attributes.size()) continue;
    varying->attributes[varying->count++] = attribute;
    return;
  }
}

}  // namespace

std::vector<Pass> pack(const std::vector<cases::Attribute>& attributes, int samples,
                       bool has_noperspective) {
  Classes of_pixels = classes_at(samples == 1 ? std::vector{Location::center}
                                              : std::vector{Location::center, Location::centroid},
                                 has_noperspective);
  of_pixels.push_back({Interpolation::flat, Location::center});
  const Classes of_samples = classes_at({Location::sample}, has_noperspective);
  std::vector<Pass> passes;
  for (const bool at_samples : {false, true}) {
    const Classes& classes = at_samples ? of_samples : of_pixels;
    const std::size_t begin = passes.size();
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      const VaryingClass varies = class_of(attributes[i], samples);
      if ((varies.location == Location::sample) == at_samples) {
        put(i, varies, classes, begin, passes);
      }
    }
  }
  if (passes.empty()) {
    Pass& pass = passes.emplace_back();
    for (const VaryingClass& one : of_pixels) pass.push_back({one, {}, 0});
  }
  return passes;
}

Pass pack_together(std::span<const cases::Attribute> attributes, int samples) {
  Pass pass;
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const VaryingClass varies = class_of(attributes[i], samples);
    auto varying = std::find_if(pass.begin(), pass.end(), [&](const Varying& candidate) {
      return candidate.varies == varies && candidate.count < candidate.attributes.size();
    });
    if (varying == pass.end()) varying = pass.insert(pass.end(), Varying{varies, {}, 0});
    varying->attributes[varying->count++] = i;
  }
  return pass;
}

}  // namespace rastercheck::backends::gl
