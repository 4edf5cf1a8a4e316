#include "rasterizer/internal/checked_draw.h"

#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>

#include "rasterizer/internal/standard_pattern.h"
#include "rasterizer/internal/try_allocating.h"

namespace rastercheck::rasterizer {
namespace {

bool is_depth(float value) { return 0 <= value && value <= 1; }

bool is_viewport(const Viewport& viewport) {
  return std::isfinite(viewport.origin.x) && std::isfinite(viewport.origin.y) &&
         std::isfinite(viewport.size.x) && std::isfinite(viewport.size.y) &&
         is_depth(viewport.min_depth) && is_depth(viewport.max_depth);
}

bool is_finite(const DepthBias& bias) {
  return std::isfinite(bias.constant) && std::isfinite(bias.slope) && std::isfinite(bias.clamp);
}

/// How many floats the attributes and the derivatives have.
struct FloatCounts {
  std::size_t attributes = 0;
  std::size_t derivatives = 0;
};

/// Truncates the fragments to `size`, and their floats to `floats`.
void cut_back(Fragments& fragments, std::size_t size, const FloatCounts& floats) {
  fragments.triangle.resize(size);
  fragments.x.resize(size);
  fragments.y.resize(size);
  fragments.sample.resize(size);
  fragments.depth.resize(size);
  fragments.attributes.resize(floats.attributes);
  fragments.derivatives.resize(floats.derivatives);
}

}  // namespace

std::optional<Error> check_size(const TargetSize& size) {
  if (size.width < 1 || size.width > kMaxSize) return Error::target_size;
  if (size.height < 1 || size.height > kMaxSize) return Error::target_size;
  if (standard_pattern(size.samples).empty()) return Error::sample_count;
  return std::nullopt;
}

std::optional<Error> check_state(const State& state) {
  if (!is_viewport(state.viewport)) return Error::viewport;
  if (state.scissor.size.x < 0 || state.scissor.size.y < 0) return Error::scissor;
  if (!is_finite(state.depth_bias)) return Error::depth_bias;
  if (state.snapping && (state.snapping->subpixel_bits < kLeastSubpixelBits ||
                         state.snapping->subpixel_bits > kMostSubpixelBits)) {
    return Error::subpixel_bits;
  }
  if (state.snapping && state.conservative != Conservative::off) {
    return Error::snapped_conservative;
  }
  const auto is_size = [](float size) { return std::isfinite(size) && size > 0; };
  if (!is_size(state.line_width) || !is_size(state.point_size)) return Error::primitive_size;
  if (state.primitive != Primitive::triangles &&
      (state.conservative != Conservative::off || !state.depth_bias.is_none())) {
    return Error::primitive_state;
  }
  if (state.attributes.size() > kMaxAttributes) return Error::attribute_count;
  if (state.clip_distance_count > kMaxClipDistances) return Error::clip_distance_count;
  return std::nullopt;
}

std::optional<Error> check_mesh(const State& state, const Mesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  if (mesh.triangles.size() > kMaxTriangles) return Error::triangle_count;
  if (mesh.attributes.size() != vertices * state.attributes.size()) return Error::attribute_values;
  if (mesh.clip_distances.size() != vertices * state.clip_distance_count) {
    return Error::clip_distance_values;
  }
  for (const glm::uvec3& corner : mesh.triangles) {
    if (corner.x >= vertices || corner.y >= vertices || corner.z >= vertices) return Error::index;
  }
  return std::nullopt;
}

std::optional<Error> check_draw(const State& state, const Mesh& mesh, const TargetSize& size) {
  std::optional<Error> error = check_size(size);
  if (!error) error = check_state(state);
  if (!error) error = check_mesh(state, mesh);
  return error;
}

DrawResult draw_checked(const DrawCall& draw, const State& state, const Mesh& mesh,
                        const TargetSize& size, Fragments& fragments) {
  if (const std::optional<Error> error = check_draw(state, mesh, size)) return {error, {}};

  const std::size_t before = fragments.size();
  const FloatCounts floats_before{fragments.attributes.size(), fragments.derivatives.size()};
  DrawCounts counts;
  const auto error = try_allocating([&] { counts = draw(state, mesh, size, fragments); });
  if (!error) return {std::nullopt, counts};
  cut_back(fragments, before, floats_before);
  return {error, {}};
}

TraceResult trace_checked(const TraceCall& trace, const State& state, const Mesh& mesh,
                          const TargetSize& size, const SamplePlace& address) {
  std::optional<Error> error = check_draw(state, mesh, size);
  if (!error && (address.triangle >= mesh.triangles.size())) error = Error::index;
  if (error) return {error, std::nullopt};
  const auto is_below = [](int value, int count) { return value >= 0 && value < count; };
  if (!is_below(address.x, size.width) || !is_below(address.y, size.height) ||
      !is_below(address.sample, size.samples)) {
    return {std::nullopt, std::nullopt};
  }
  TraceResult result;
  result.error = try_allocating([&] { result.trace = trace(state, mesh, size, address); });
  return result;
}

}  // namespace rastercheck::rasterizer
