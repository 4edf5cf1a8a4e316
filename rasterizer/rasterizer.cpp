#include "rasterizer/rasterizer.h"

#include <algorithm>

#include "rasterizer/internal/checked_draw.h"
#include "rasterizer/internal/checked_frame.h"
#include "rasterizer/internal/depth_store.h"
#include "rasterizer/internal/fragment_drawing.h"
#include "rasterizer/trace.h"

namespace rastercheck::rasterizer {

std::string_view to_string(Error error) {
  switch (error) {
    case Error::target_size:
      return "the width or height of the target is not within 1 to 16384, or a framebuffer's "
             "arrays do not have its size";
    case Error::sample_count:
      return "the samples per pixel of the target are not 1, 2, 4, 8 or 16";
    case Error::viewport:
      return "the viewport has a number that is not finite, or a depth outside [0, 1]";
    case Error::scissor:
      return "the scissor has a negative size";
    case Error::depth_bias:
      return "the depth bias has a number that is not finite";
    case Error::subpixel_bits:
      return "the subpixel bits of the snapping are not within 0 to 16";
    case Error::snapped_conservative:
      return "conservative coverage cannot be combined with snapping";
    case Error::primitive_size:
      return "the line width or the point size is not a finite number above 0";
    case Error::primitive_state:
      return "conservative coverage and depth bias apply to triangles only";
    case Error::attribute_count:
      return "there are more than 32 attributes, or not as many as the framebuffer has";
    case Error::clip_distance_count:
      return "there are more than 8 clip distances";
    case Error::attribute_values:
      return "the number of attribute values of the mesh is not vertices times attributes";
    case Error::clip_distance_values:
      return "the number of clip distances of the mesh is not vertices times distances per vertex";
    case Error::index:
      return "a triangle of the mesh has a vertex index beyond the positions";
    case Error::triangle_count:
      return "there are more than 2^31 triangles";
    case Error::color_format:
      return "bytes, and blending over existing colours, need four channels, the last of them "
             "alpha";
    case Error::output_count:
      return "the shader does not have as many outputs as the framebuffer has channels";
    case Error::unknown_method:
      return "the method is not one of the registered methods";
    case Error::out_of_memory:
      return "the memory for the result cannot be allocated";
  }
  return "the error is not a value of the enumeration";
}

DrawResult draw_fragments(const State& state, const Mesh& mesh, const TargetSize& size,
                          Fragments& fragments) {
  return draw_checked(&draw_mesh, state, mesh, size, fragments);
}

float stored_depth(DepthFormat format, float depth) {
  if (format == DepthFormat::float32) return depth;
  return stored(std::clamp(depth, 0.0F, 1.0F), depth_steps(format));
}

TraceResult trace_sample(const State& state, const Mesh& mesh, const TargetSize& size,
                         const SamplePlace& address) {
  return trace_checked(&trace_mesh, state, mesh, size, address);
}

std::optional<Error> clear(Picture& framebuffer, const TargetSize& size,
                           std::size_t attribute_count, float depth) {
  if (const std::optional<Error> error = resize(framebuffer, size, attribute_count)) return error;
  std::fill(framebuffer.depth.begin(), framebuffer.depth.end(), depth);
  std::fill(framebuffer.attributes.begin(), framebuffer.attributes.end(), 0.0F);
  std::fill(framebuffer.bytes.begin(), framebuffer.bytes.end(), std::uint8_t{0});
  return std::nullopt;
}

DrawResult draw(const State& state, const Mesh& mesh, Picture& framebuffer, unsigned threads) {
  return draw_checked_frame(nullptr, state, mesh, framebuffer, threads);
}

DrawResult clear_and_draw(const State& state, const Mesh& mesh, const TargetSize& size, float depth,
                          Picture& framebuffer, unsigned threads) {
  return clear_and_draw_checked_frame(nullptr, state, mesh, size, depth, framebuffer, threads);
}

}  // namespace rastercheck::rasterizer
