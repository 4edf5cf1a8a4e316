#include "rasterizer/internal/kernel_setting.h"

#include <algorithm>
#include <cmath>

#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/grid_position.h"
#include "rasterizer/internal/weights.h"

namespace rastercheck::rasterizer {
namespace {

/// True if all values are evaluated at samples.
bool is_at_samples(const DrawSetting& setting) {
  const auto& attributes = setting.state.attributes;
  return setting.pattern.size() == 1 ||
         std::all_of(attributes.begin(), attributes.end(), [](const Qualifier& qualifier) {
           return qualifier.location == Location::sample ||
                  qualifier.interpolation == Interpolation::flat;
         });
}

bool is_same(const PixelRange& a, const PixelRange& b) {
  return a.begin == b.begin && a.end == b.end;
}

/// True if all samples have the same bounds, because the viewport cuts through no pixel.
bool has_one_box(const DrawSetting& setting) {
  const DrawBounds& bounds = setting.bounds;
  for (std::size_t s = 1; s < setting.pattern.size(); ++s) {
    if (!is_same(bounds.sample_columns[s], bounds.sample_columns[0])) return false;
    if (!is_same(bounds.sample_rows[s], bounds.sample_rows[0])) return false;
  }
  return true;
}

/// True if the kernels can draw conservative coverage: they move edges from the only sample, the
/// pixel's centre, and know no pixels that the viewport cuts.
bool is_conservative_by_kernels(const DrawSetting& setting) {
  const DrawBounds& bounds = setting.bounds;
  return setting.pattern.size() == 1 && is_same(bounds.sample_columns[0], bounds.whole_columns) &&
         is_same(bounds.sample_rows[0], bounds.whole_rows);
}

/// True if the kernels can snap the vertices. They support only rounding to even, and only grid
/// points that are one unit apart.
bool is_snapped_by_kernels(const State& state) {
  const auto& [bits, rounding] = *state.snapping;
  return state.basis == Basis::snapped && rounding == Rounding::nearest_even &&
         bits == unit_bits(*state.snapping) && bits <= kMostKernelBits;
}

}  // namespace

std::optional<KernelSetting> kernel_setting(const DrawSetting& setting, int tile_columns) {
  const State& state = setting.state;
  if (state.primitive != Primitive::triangles) return std::nullopt;
  const bool snaps = state.snapping.has_value();
  const SampleFrame frame =
      snaps ? grid_frame(setting.window, unit_bits(*state.snapping)) : setting.frame;
  const bool is_drawn =
      is_at_samples(setting) && has_one_box(setting) && state.clip_distance_count == 0 &&
      frame.u.is_exact && frame.v.is_exact && frame.t > 0 &&
      (!snaps || is_snapped_by_kernels(state)) &&
      (state.conservative == Conservative::off || is_conservative_by_kernels(setting));
  if (!is_drawn) return std::nullopt;
  KernelSetting out;
  out.samples = setting.pattern.size();
  out.least_offset = 1;
  for (std::size_t s = 0; s < out.samples; ++s) {
    const SampleOffset& offset = setting.pattern[s];
    out.u_first[s] = frame.u.at(offset.x);
    out.v_first[s] = frame.v.at(offset.y);
    out.least_offset = std::min({out.least_offset, offset.x, offset.y});
    out.greatest_offset = std::max({out.greatest_offset, offset.x, offset.y});
  }
  out.u_step = 2 * frame.u.scale;
  out.v_step = 2 * frame.v.scale;
  out.t = frame.t;
  out.u_greatest = frame.u.greatest;
  out.v_greatest = frame.v.greatest;
  out.u_grain = std::ldexp(1.0, frame.u.grain);
  out.v_grain = std::ldexp(1.0, frame.v.grain);
  out.t_grain = std::ldexp(1.0, lowest_bit(frame.t));
  out.u_owner = frame.u.direction;
  out.v_owner = setting.tie_sign * frame.v.direction;
  out.snaps = snaps;
  if (snaps) {
    out.grid = grid_of(state);
    out.units = out.u_step;
  }
  out.u_middle = frame.u.shift / 2;
  out.u_half = double{frame.u.size} / 2;
  out.v_middle = frame.v.shift / 2;
  out.v_half = (state.convention == Convention::d3d ? -1 : 1) * double{frame.v.size} / 2;
  if (state.conservative != Conservative::off) {
    out.corner_sign = state.conservative == Conservative::outer ? 1 : -1;
    out.u_reach = std::abs(out.u_step) / 2;
    out.v_reach = std::abs(out.v_step) / 2;
  }
  out.bounds = {setting.bounds.sample_columns[0], setting.bounds.sample_rows[0]};
  out.tile_columns = tile_columns;
  out.culls_positive = is_culled(state, snaps ? 1 : frame.displayed(1));
  out.culls_negative = is_culled(state, snaps ? -1 : frame.displayed(-1));
  out.clips_depth = !state.depth_clamp;
  out.near_w = state.convention == Convention::opengl ? 1 : 0;
  const DepthRange depth = depth_range(state);
  out.depth_low = depth.low;
  out.depth_span = depth.span;
  out.depth_least = depth.least;
  out.depth_greatest = depth.greatest;
  out.depth_steps = depth.steps;
  out.bias = bias_terms(state);
  out.tests_depth = state.depth_test == DepthTest::less;
  out.provoking = provoking_vertex(state);
  out.attributes = state.attributes.size();
  out.all_smooth = out.attributes > 0;
  for (std::size_t a = 0; a < out.attributes; ++a) {
    out.interpolation[a] = state.attributes[a].interpolation;
    out.all_smooth = out.all_smooth && out.interpolation[a] == Interpolation::smooth;
    out.has_smooth = out.has_smooth || out.interpolation[a] == Interpolation::smooth;
    out.has_affine = out.has_affine || out.interpolation[a] == Interpolation::noperspective;
  }
  out.is_plain = out.all_smooth && out.tests_depth && out.depth_steps == 0;
  return out;
}

}  // namespace rastercheck::rasterizer
