#include "backends/drawn/draw_file.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include "backends/plugin/draw_state.h"

namespace rastercheck::backends {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Appends the bytes of a vector of 32-bit members.
template <typename T>
void append(std::string& to, const std::vector<T>& values) {
  static_assert(sizeof(T) % 4 == 0);
  if (values.empty()) return;
  const std::size_t size = values.size() * sizeof(T);
  const std::size_t begin = to.size();
  to.resize(begin + size);
  std::memcpy(to.data() + begin, values.data(), size);
}

std::uint32_t word(float number) { return std::bit_cast<std::uint32_t>(number); }
std::uint32_t word(std::int32_t number) { return static_cast<std::uint32_t>(number); }

}  // namespace

std::string draw_file(const cases::Case& c, const cases::Contract& promised) {
  const rastercheck_draw d = draw_state(c, promised);
  const bool has_primitive_words = d.primitive != RASTERCHECK_TRIANGLES;
  const bool has_depth_words = has_primitive_words || d.depth_bits != 0 || !c.depth_bias.is_none();
  std::string bytes = has_primitive_words ? "RCDRAW3\n"
                      : has_depth_words   ? "RCDRAW2\n"
                                          : "RCDRAW1\n";
  append(bytes, std::vector<std::uint32_t>{
                    d.rules,
                    d.width,
                    d.height,
                    d.samples,
                    word(d.viewport_x),
                    word(d.viewport_y),
                    word(d.viewport_width),
                    word(d.viewport_height),
                    word(d.min_depth),
                    word(d.max_depth),
                    word(d.scissor_x),
                    word(d.scissor_y),
                    word(d.scissor_width),
                    word(d.scissor_height),
                    d.cull,
                    d.front_face,
                    d.depth_test,
                    d.depth_clamp,
                    d.coverage,
                    d.subpixel_bits,
                    d.rounding,
                    d.tie_rule,
                    d.basis,
                    d.vertex_count,
                    d.attribute_count,
                    d.clip_distance_count,
                    static_cast<std::uint32_t>(c.triangles.size()),
                    word(d.depth_clear),
                });
  if (has_depth_words) {
    append(bytes, std::vector<std::uint32_t>{word(d.bias_constant), word(d.bias_slope),
                                             word(d.bias_clamp), d.depth_bits});
  }
  if (has_primitive_words) {
    append(bytes, std::vector<std::uint32_t>{d.primitive, d.line_mode, word(d.line_width),
                                             word(d.point_size)});
  }
  append(bytes, sample_places(c));
  append(bytes, c.positions);
  append(bytes, plugin_attributes(c));
  append(bytes, c.attribute_values);
  append(bytes, c.clip_distances);
  append(bytes, c.triangles);
  return bytes;
}

}  // namespace rastercheck::backends
