#include "properties/laws/internal/drawn_values.h"

#include <algorithm>
#include <cmath>

#include "properties/float_numbers.h"

namespace rastercheck::properties {

bool all_in_front(const cases::Case& c, const cases::Triangle& triangle) {
  return std::all_of(triangle.begin(), triangle.end(),
                     [&](std::uint32_t index) { return c.positions[index].w > 0; });
}

bool is_at_sample(const cases::Case& c, std::uint32_t attribute) {
  const cases::Location location = c.attributes[attribute].location;
  return location == cases::Location::sample ||
         (location == cases::Location::center && c.framebuffer.samples == 1);
}

double DrawnValues::vertex_ulp(std::size_t fragment, const MaybeAttribute& attribute) const {
  double greatest{std::max(case_->viewport.min_depth, case_->viewport.max_depth)};
  if (attribute) {
    greatest = 0;
    for (const std::uint32_t vertex : corners(fragment)) {
      greatest = std::max(greatest, std::abs(double{case_->attributes_of(vertex)[*attribute]}));
    }
  }
  return ulp_of(greatest);
}

}  // namespace rastercheck::properties
