#pragma once

// The public face of the rasterizer, a library of its own: clip-space triangles in, fragments or
// pictures out. It needs GLM and nothing else of this project.
//
// Conventions. Window coordinates are in pixels; pixel (i, j) has its centre at (i + 1/2, j + 1/2).
// A vertex is a clip position (x, y, z, w) as a vertex shader writes it; w <= 0 is allowed. All
// inputs are float32; triangles with a position that is not finite are discarded and counted.
//
// Beside it lie vertex_stage.h (object space to clip space), shading.h (fragments to colours) and
// texture.h.

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <new>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace rastercheck::rasterizer {

/// Pixels per side of a framebuffer, inclusive.
inline constexpr int kMaxSize = 16384;
/// Float attributes per vertex, inclusive.
inline constexpr std::size_t kMaxAttributes = 32;
/// User clip distances per vertex, inclusive.
inline constexpr std::size_t kMaxClipDistances = 8;
/// Triangles of a draw, inclusive.
inline constexpr std::size_t kMaxTriangles = std::size_t{1} << 31;

/// Clip depth, direction of window y, depth map and provoking vertex, by API:
/// | | opengl | vulkan | d3d |
/// | clip depth | −w…w | 0…w | 0…w |
/// | window y | up | down, as NDC y | down, NDC y up |
/// | provoking vertex | last | first | first |
enum class Convention { opengl, vulkan, d3d };

enum class Cull { none, back, front };
/// Orientation of front faces, as displayed.
enum class FrontFace { ccw, cw };
/// Which edges own a sample exactly on them, as displayed.
enum class FillRule { top_left, bottom_left };
/// When a fragment is kept: `less`, where its depth is less than the sample's, and so on.
enum class DepthTest {
  always,
  never,
  less,
  equal,
  less_or_equal,
  greater,
  not_equal,
  greater_or_equal
};

/// What becomes of a colour s that is drawn where d is, in submission order, sample by sample.
///
///   off        s
///   over       s_a s + (1 − s_a) d for the first three channels, s_a + (1 − s_a) d_a for the last;
///              s_a is the last of four channels, which are not multiplied with it
///   additive   s + d
///
/// In double, every operation rounded, then rounded to what the framebuffer holds. A colour for
/// ColorFormat::rgba8 is held to [0, 1] first, NaN as 0, and blended in units of its bytes: 255 s
/// for s, the byte that is there for d, the nearest byte, ties to even, for what it leaves.
enum class Blend { off, over, additive };

/// What a framebuffer holds of each sample.
enum class ColorFormat {
  float32,  ///< any number of attributes
  /// Four channels: bytes k for k/255, the nearest, ties to even; below 0 and NaN 0, above 1 255.
  rgba8,
};

/// Says where a position goes that is as near to two points of a grid, along each axis.
enum class Rounding {
  nearest_even,  ///< to the even one
  half_up,       ///< to the larger one
};

/// The vertices' window positions rounded to the nearest point of a grid, before edges are set up
/// (RULES §3).
struct Snapping {
  int subpixel_bits = 8;  ///< a grid of 2^-subpixel_bits pixels, 0…16
  Rounding rounding = Rounding::nearest_even;
};
inline constexpr int kLeastSubpixelBits = 0;
inline constexpr int kMostSubpixelBits = 16;
/// Snapped vertices lie within this many pixels of the window's origin along x and along y; beyond
/// it, and beyond depth planes and clip distances, triangles are clipped, which makes new vertices.
inline constexpr int kGuardBand = 32768;

/// Where depth, attributes and facing come from under Snapping: the triangle of the clip positions,
/// or that of the snapped vertices.
enum class Basis { ideal, snapped };

/// How attributes of fragments are computed: in double with one rounding to float32 at the end, or
/// in float32. Depth is always the former, and so is what goes into framebuffers.
enum class Precision { float64, float32 };

/// How far values are off at most, in scale ULP: (f − r) / ulp(max(|r|, max |r_i|)), with r what
/// exact arithmetic makes of the vertices' r_i and the ulp of float32; for depth max(|min_depth|,
/// |max_depth|) takes the place of max |r_i|. Half an ULP is the rounding to float32, 2^-7 what
/// double is off by before it (derived in internal/certificates.h).
inline constexpr double kValueBound = 0.5 + 0x1p-7;
/// The same of attributes with Precision::float32: smooth ones, and those that are linear in the
/// window (noperspective, or smooth where all w are equal). 6 29/36 + 3/128 and 3 11/12 + 3/128,
/// rounded up (derived in internal/float_kernels.h).
inline constexpr double kFloatSmoothBound = 6.83;
inline constexpr double kFloatAffineBound = 3.95;
/// The same of screen derivatives d, in ulp(max(|d|, M)), M the size of the terms that d is the
/// difference of (derived in internal/derivatives.h).
inline constexpr double kDerivativeBound = 0.5 + 0x1p-7 + 0x1p-22;

/// `smooth`: linear in clip space; `noperspective`: linear in window space; `flat`: the provoking
/// vertex's value.
enum class Interpolation { smooth, noperspective, flat };
/// Where an attribute is evaluated. `centroid`: the centre where all samples of the pixel are
/// covered, else the first covered sample.
enum class Location { sample, center, centroid };

struct Qualifier {
  Interpolation interpolation = Interpolation::smooth;
  Location location = Location::sample;
};

/// NDC [−1, 1]² maps to `origin` … `origin + size` in window pixels; sizes may be negative. Depth
/// maps to [min_depth, max_depth], in any order, both within [0, 1].
struct Viewport {
  glm::vec2 origin{0, 0};
  glm::vec2 size{0, 0};
  float min_depth = 0;
  float max_depth = 1;
};

/// Pixels (i, j) with origin <= (i, j) < origin + size.
struct Rectangle {
  glm::ivec2 origin{0, 0};
  glm::ivec2 size{0, 0};
};

/// What stays the same for a draw.
struct State {
  Convention convention = Convention::vulkan;
  Viewport viewport = {};
  /// The pixels that may be drawn; by default all.
  Rectangle scissor{{0, 0}, {kMaxSize, kMaxSize}};
  Cull cull = Cull::none;
  FrontFace front_face = FrontFace::ccw;
  FillRule fill_rule = FillRule::top_left;
  DepthTest depth_test = DepthTest::always;
  bool depth_write = true;  ///< whether what is kept leaves its depth
  Blend blend = Blend::off;
  std::optional<Snapping> snapping = {};  ///< nothing: the triangle of the clip positions, exactly
  Basis basis = Basis::ideal;
  Precision precision = Precision::float64;
  bool depth_clamp = false;
  /// Whether fragments carry their attributes' screen derivatives. draw_fragments alone asks.
  bool derivatives = false;
  std::vector<Qualifier> attributes = {};  ///< one for each float attribute of a vertex
  std::size_t clip_distance_count = 0;     ///< user clip distances of a vertex
};

/// Indexed triangles. The spans must outlive the draw.
struct Mesh {
  std::span<const glm::vec4> positions = {};   ///< [vertex], clip space
  std::span<const float> attributes = {};      ///< [vertex][attribute]
  std::span<const float> clip_distances = {};  ///< [vertex][distance]
  std::span<const glm::uvec3> triangles = {};  ///< vertex indices, in submission order
};

/// Width and height in pixels, samples per pixel (1, 2, 4, 8 or 16, the standard patterns).
struct TargetSize {
  int width = 0;
  int height = 0;
  int samples = 1;
};

/// Why a draw was refused; nothing is drawn then, unless memory ran out on the way.
enum class Error {
  target_size,           ///< width or height not in 1…kMaxSize, or arrays of another size
  sample_count,          ///< not 1, 2, 4, 8 or 16
  viewport,              ///< a number that is not finite, or depths outside [0, 1]
  scissor,               ///< a negative size
  subpixel_bits,         ///< not 0…16
  attribute_count,       ///< more than kMaxAttributes, or other than the framebuffer's
  clip_distance_count,   ///< more than kMaxClipDistances
  attribute_values,      ///< not one value for each vertex and attribute
  clip_distance_values,  ///< not one value for each vertex and distance
  index,                 ///< a vertex index beyond the positions
  triangle_count,        ///< more than kMaxTriangles
  color_format,          ///< ColorFormat::rgba8, or Blend::over, with other than four channels
  output_count,          ///< a shader has not as many outputs as the framebuffer has channels
  unknown_method,        ///< no textbook method of that name
  out_of_memory,
};

/// One sentence about an error, naming the argument.
std::string_view to_string(Error error);

/// What became of the triangles of a draw.
struct DrawCounts {
  std::size_t discarded_not_finite = 0;  ///< a position or clip distance is infinite or no number
  std::size_t discarded_degenerate = 0;  ///< without area, edge-on, or in a viewport without area
  bool operator==(const DrawCounts&) const = default;
};

/// Fragments as a structure of arrays, ordered by triangle, y, x, sample: each triangle as if drawn
/// alone.
struct Fragments {
  std::vector<std::uint32_t> triangle;
  std::vector<std::uint16_t> x;
  std::vector<std::uint16_t> y;
  std::vector<std::uint8_t> sample;
  std::vector<float> depth;
  std::vector<float> attributes;  ///< [fragment][attribute]
  /// [fragment][attribute][2], with State::derivatives; else left as it is. ∂r/∂u and ∂r/∂v of the
  /// attribute r at its own location, per pixel of window x and y; 0 of flat ones.
  std::vector<float> derivatives;

  std::size_t size() const { return triangle.size(); }
};

/// Memory that begins where a cache line does, so that whole ones can be written.
template <typename T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};

  CacheLineAllocator() = default;
  template <typename U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>& /*other*/) noexcept {}

  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), kLine));
  }
  void deallocate(T* memory, std::size_t /*count*/) { ::operator delete(memory, kLine); }
  template <typename U>
  bool operator==(const CacheLineAllocator<U>& /*other*/) const {
    return true;
  }
};

/// What is drawn into: depth, and attributes, or the channels of a colour.
struct Picture {
  using Values = std::vector<float, CacheLineAllocator<float>>;
  using Bytes = std::vector<std::uint8_t, CacheLineAllocator<std::uint8_t>>;

  TargetSize size = {};
  std::size_t attribute_count = 0;
  ColorFormat format = ColorFormat::float32;
  Values depth = {};       ///< [y][x][sample]
  Values attributes = {};  ///< [y][x][sample][attribute]; of float32
  Bytes bytes = {};        ///< of rgba8: [y][x][sample][4]
};

/// `error` set: nothing was drawn. Otherwise `counts` says what was left out.
struct DrawResult {
  std::optional<Error> error;
  DrawCounts counts;
};

/// Appends every fragment of every triangle, as if each were drawn alone. `state.depth_test` has no
/// say.
DrawResult draw_fragments(const State& state, const Mesh& mesh, const TargetSize& size,
                          Fragments& fragments);

/// A framebuffer, of its own format, whose samples all have this depth and zero attributes; an
/// error where the size is not valid or memory runs out.
std::optional<Error> clear(Picture& framebuffer, const TargetSize& size,
                           std::size_t attribute_count, float depth);

/// Draws attributes into the framebuffer, triangle by triangle in submission order. On that many
/// threads, 0: as many as the machine has; the picture is the same for any number. Where memory
/// runs out tiles of 64 × 64 pixels hold some of what was to be drawn, or are what they were.
DrawResult draw(const State& state, const Mesh& mesh, Picture& framebuffer, unsigned threads = 1);

/// clear() and draw() in one: each tile is cleared where it is drawn, so that most often the memory
/// of the framebuffer is written once. Where memory runs out it holds some of what was to be drawn,
/// or any numbers.
DrawResult clear_and_draw(const State& state, const Mesh& mesh, const TargetSize& size, float depth,
                          Picture& framebuffer, unsigned threads = 1);

/// The mean of each pixel's samples, rounded once; depth is that of sample 0. `from` and `into` are
/// not the same; an error where memory runs out, or `from` is not well formed.
std::optional<Error> resolve(const Picture& from, Picture& into);

}  // namespace rastercheck::rasterizer
