#include "cases/some_fragments.h"

#include <algorithm>
#include <vector>

namespace rastercheck::cases {

Fragments some_fragments(const Fragments& drawn, std::span<const std::size_t> some) {
  Fragments part;
  part.attribute_count = drawn.attribute_count;
  for (const std::size_t i : some) {
    part.triangle.push_back(drawn.triangle[i]);
    part.x.push_back(drawn.x[i]);
    part.y.push_back(drawn.y[i]);
    part.sample.push_back(drawn.sample[i]);
    part.depth.push_back(drawn.depth[i]);
    const auto values = drawn.attributes_of(i);
    part.attributes.insert(part.attributes.end(), values.begin(), values.end());
  }
  return part;
}

Fragments thinned(const Fragments& drawn, std::size_t count) {
  const std::size_t step = std::max<std::size_t>(drawn.size() / count, 1);
  std::vector<std::size_t> some;
  some.reserve(drawn.size() / step + 1);
  for (std::size_t i = 0; i < drawn.size(); i += step) some.push_back(i);
  return some_fragments(drawn, some);
}

}  // namespace rastercheck::cases
