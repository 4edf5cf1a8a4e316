#include "rasterizer/internal/checked_frame.h"

#include "rasterizer/internal/checked_draw.h"
#include "rasterizer/internal/frame_drawing.h"
#include "rasterizer/internal/parallel.h"
#include "rasterizer/internal/try_allocating.h"

namespace rastercheck::rasterizer {
namespace {

std::size_t sample_count(const TargetSize& size) {
  return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) *
         static_cast<std::size_t>(size.samples);
}

/// The lengths of a framebuffer's arrays in its format.
struct Sizes {
  std::size_t depth = 0;
  std::size_t attributes = 0;
  std::size_t bytes = 0;
};
Sizes sizes_of(const TargetSize& size, std::size_t attribute_count, ColorFormat format) {
  const std::size_t samples = sample_count(size);
  const bool has_bytes = format == ColorFormat::rgba8;
  return {samples, has_bytes ? 0 : samples * attribute_count,
          has_bytes ? samples * attribute_count : 0};
}

/// Allocates an array, or returns an empty one if the old one is large enough.
template <typename Array>
Array room_for(std::size_t size, const Array& old) {
  Array array;
  if (old.capacity() < size) array.reserve(size);
  return array;
}

/// Resizes the array. Uses the memory of `room` if `room` has any.
template <typename Array>
void move_into(Array& array, Array& room, std::size_t size) {
  if (room.capacity() > 0) array.swap(room);
  array.resize(size);
}

/// The number of channels that a draw writes.
std::size_t channel_count(const ShaderView* shader, const State& state) {
  return shader == nullptr ? state.attributes.size() : shader->outputs;
}

/// The error for a wrong channel count.
Error wrong_count(const ShaderView* shader) {
  return shader == nullptr ? Error::attribute_count : Error::output_count;
}

/// Checks that the format can hold the channels, and that the state's blending can blend them.
std::optional<Error> check_channels(const ShaderView* shader, const State& state,
                                    ColorFormat format) {
  const std::size_t channels = channel_count(shader, state);
  if (channels > kMaxAttributes) return wrong_count(shader);
  const bool needs_four = state.blend == Blend::over || format == ColorFormat::rgba8;
  if (needs_four && channels != 4) return Error::color_format;
  return std::nullopt;
}

DrawResult draw_allocating(const ShaderView* shader, const State& state, const Mesh& mesh,
                           Picture& framebuffer, unsigned threads,
                           std::optional<float> clear_depth) {
  DrawCounts counts;
  const auto error = try_allocating([&] {
    counts = draw_frame(state, mesh, framebuffer, worker_count(threads), clear_depth, shader);
  });
  if (error) return {error, {}};
  return {std::nullopt, counts};
}

}  // namespace

std::optional<Error> check_framebuffer(const Picture& framebuffer) {
  if (const std::optional<Error> error = check_size(framebuffer.size)) return error;
  if (framebuffer.attribute_count > kMaxAttributes) return Error::attribute_count;
  if (framebuffer.format == ColorFormat::rgba8 && framebuffer.attribute_count != 4) {
    return Error::color_format;
  }
  const Sizes sizes = sizes_of(framebuffer.size, framebuffer.attribute_count, framebuffer.format);
  if (framebuffer.depth.size() != sizes.depth ||
      framebuffer.attributes.size() != sizes.attributes ||
      framebuffer.bytes.size() != sizes.bytes) {
    return Error::target_size;
  }
  return std::nullopt;
}

std::optional<Error> resize(Picture& framebuffer, const TargetSize& size,
                            std::size_t attribute_count) {
  if (const std::optional<Error> error = check_size(size)) return error;
  if (attribute_count > kMaxAttributes) return Error::attribute_count;
  if (framebuffer.format == ColorFormat::rgba8 && attribute_count != 4) return Error::color_format;
  const Sizes sizes = sizes_of(size, attribute_count, framebuffer.format);
  return try_allocating([&] {
    // Allocates all new memory before releasing any of the old.
    auto depth = room_for(sizes.depth, framebuffer.depth);
    auto attributes = room_for(sizes.attributes, framebuffer.attributes);
    auto bytes = room_for(sizes.bytes, framebuffer.bytes);
    move_into(framebuffer.depth, depth, sizes.depth);
    move_into(framebuffer.attributes, attributes, sizes.attributes);
    move_into(framebuffer.bytes, bytes, sizes.bytes);
    framebuffer.size = size;
    framebuffer.attribute_count = attribute_count;
  });
}

DrawResult draw_checked_frame(const ShaderView* shader, const State& state, const Mesh& mesh,
                              Picture& framebuffer, unsigned threads) {
  std::optional<Error> error = check_state(state);
  if (!error) error = check_framebuffer(framebuffer);
  if (!error && framebuffer.attribute_count != channel_count(shader, state)) {
    error = wrong_count(shader);
  }
  if (!error) error = check_channels(shader, state, framebuffer.format);
  if (!error) error = check_mesh(state, mesh);
  if (error) return {error, {}};
  return draw_allocating(shader, state, mesh, framebuffer, threads, std::nullopt);
}

DrawResult clear_and_draw_checked_frame(const ShaderView* shader, const State& state,
                                        const Mesh& mesh, const TargetSize& size, float depth,
                                        Picture& framebuffer, unsigned threads) {
  std::optional<Error> error = check_draw(state, mesh, size);
  if (!error) error = check_channels(shader, state, framebuffer.format);
  if (!error) error = resize(framebuffer, size, channel_count(shader, state));
  if (error) return {error, {}};
  return draw_allocating(shader, state, mesh, framebuffer, threads, depth);
}

}  // namespace rastercheck::rasterizer
