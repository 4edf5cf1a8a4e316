#include "backends/cpu/fragments.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <vector>

#include "backends/cpu/case_state.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

/// The fragments that a depth test `less` leaves: of each sample the nearest, of equals the first
/// drawn, if it is nearer than what the depth buffer begins with. Indices in ascending order.
std::vector<std::size_t> nearest(const ras::Fragments& fragments,
                                 std::optional<float> clear_depth) {
  std::map<std::tuple<int, int, int>, std::size_t> best;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (clear_depth && !(fragments.depth[i] < *clear_depth)) continue;
    const auto [entry, is_first] =
        best.try_emplace({fragments.y[i], fragments.x[i], fragments.sample[i]}, i);
    if (!is_first && fragments.depth[i] < fragments.depth[entry->second]) entry->second = i;
  }
  std::vector<std::size_t> kept;
  kept.reserve(best.size());
  for (const auto& [place, index] : best) kept.push_back(index);
  std::sort(kept.begin(), kept.end());
  return kept;
}

cases::Fragments framebuffer(const ras::Fragments& fragments,
                             const std::vector<std::size_t>& indices, std::size_t attributes) {
  const auto append = [](std::vector<float>& to, const std::vector<float>& from,
                         std::size_t fragment, std::size_t count) {
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(fragment * count);
    to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(count));
  };
  cases::Fragments result;
  result.attribute_count = attributes;
  for (const std::size_t i : indices) {
    result.triangle.push_back(fragments.triangle[i]);
    result.x.push_back(fragments.x[i]);
    result.y.push_back(fragments.y[i]);
    result.sample.push_back(fragments.sample[i]);
    result.depth.push_back(fragments.depth[i]);
    append(result.attributes, fragments.attributes, i, attributes);
    if (!fragments.derivatives.empty()) {
      append(result.derivatives, fragments.derivatives, i, attributes * 2);
    }
  }
  return result;
}

}  // namespace

Result<cases::Fragments> drawn_fragments(const cases::Case& c, const ras::DrawResult& drawn,
                                         const ras::Fragments& fragments) {
  if (drawn.error) return tl::unexpected(refused(*drawn.error));
  std::vector<std::size_t> indices(fragments.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  if (c.depth_test == cases::DepthTest::less) indices = nearest(fragments, c.depth_clear);
  return framebuffer(fragments, indices, c.attributes.size());
}

}  // namespace rastercheck::backends
