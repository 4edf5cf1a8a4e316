#include "backends/cpu/fragments.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

#include "backends/cpu/case_state.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

/// The indices, in ascending order, of the fragments that pass a depth test `less`. A sample keeps
/// its nearest fragment, or the first of equally near ones, if that is nearer than the depth
/// buffer's initial value.
std::vector<std::size_t> nearest(const ras::Fragments& fragments, const cases::Case& c) {
  const auto samples = static_cast<std::size_t>(c.framebuffer.samples);
  const std::optional<float> initial = stored_clear(c);
  std::vector<std::vector<std::size_t>> rows(static_cast<std::size_t>(c.framebuffer.height));
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (initial && !(fragments.depth[i] < *initial)) continue;
    rows[static_cast<std::size_t>(fragments.y[i])].push_back(i);
  }
  const std::size_t none = fragments.size();
  std::vector<std::size_t> best(static_cast<std::size_t>(c.framebuffer.width) * samples);
  std::vector<bool> is_kept(fragments.size());
  for (const std::vector<std::size_t>& row : rows) {
    std::fill(best.begin(), best.end(), none);
    const auto best_at = [&](std::size_t i) -> std::size_t& {
      return best[static_cast<std::size_t>(fragments.x[i]) * samples +
                  static_cast<std::size_t>(fragments.sample[i])];
    };
    for (const std::size_t i : row) {
      std::size_t& so_far = best_at(i);
      if (so_far == none || fragments.depth[i] < fragments.depth[so_far]) so_far = i;
    }
    for (const std::size_t i : row) is_kept[i] = best_at(i) == i;
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (is_kept[i]) kept.push_back(i);
  }
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
  result.triangle.reserve(indices.size());
  result.x.reserve(indices.size());
  result.y.reserve(indices.size());
  result.sample.reserve(indices.size());
  result.depth.reserve(indices.size());
  result.attributes.reserve(indices.size() * attributes);
  if (!fragments.derivatives.empty()) result.derivatives.reserve(indices.size() * attributes * 2);
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
  if (c.depth_test == cases::DepthTest::less) indices = nearest(fragments, c);
  return framebuffer(fragments, indices, c.attributes.size());
}

}  // namespace rastercheck::backends
