#include "backends/cpu/occlusion.h"

#include <limits>
#include <vector>

#include "backends/cpu/case_state.h"

namespace rastercheck::backends {
namespace {

/// The case without attributes, and with the triangles from `first` until before `end`.
cases::Case bare_part(const cases::Case& c, std::size_t first, std::size_t end,
                      cases::DepthTest test) {
  cases::Case part = c;
  part.attributes.clear();
  part.attribute_values.clear();
  part.depth_test = test;
  part.triangles.assign(c.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                        c.triangles.begin() + static_cast<std::ptrdiff_t>(end));
  return part;
}

std::size_t sample_index(const cases::Case& c, const cases::Fragments& drawn, std::size_t i) {
  const auto width = static_cast<std::size_t>(c.framebuffer.width);
  const auto samples = static_cast<std::size_t>(c.framebuffer.samples);
  return (drawn.y[i] * width + drawn.x[i]) * samples + drawn.sample[i];
}

}  // namespace

Result<bool> is_hidden_in_depth_buffer(const cases::Case& c, std::size_t occluders,
                                       const DrawFragments& draw) {
  const Result<cases::Fragments> hiding = draw(bare_part(c, 0, occluders, cases::DepthTest::less));
  if (!hiding) return tl::unexpected(hiding.error());
  const Result<cases::Fragments> asked_about =
      draw(bare_part(c, occluders, c.triangles.size(), cases::DepthTest::none));
  if (!asked_about) return tl::unexpected(asked_about.error());

  // A buffer whose initial value the case does not name begins farther than all depths.
  const float initial = stored_clear(c).value_or(std::numeric_limits<float>::infinity());
  const auto samples = static_cast<std::size_t>(c.framebuffer.width) *
                       static_cast<std::size_t>(c.framebuffer.height) *
                       static_cast<std::size_t>(c.framebuffer.samples);
  std::vector<float> depths(samples, initial);
  for (std::size_t i = 0; i < hiding->size(); ++i) {
    depths[sample_index(c, *hiding, i)] = hiding->depth[i];
  }
  for (std::size_t i = 0; i < asked_about->size(); ++i) {
    if (asked_about->depth[i] < depths[sample_index(c, *asked_about, i)]) return false;
  }
  return true;
}

}  // namespace rastercheck::backends
