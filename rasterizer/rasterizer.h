#pragma once

// Public interface of the rasterizer, which is a library of its own: clip-space triangles, lines
// and points in, fragments or pictures out. It depends on GLM and on nothing else of this project.
//
// Conventions. Window coordinates are in pixels; pixel (i, j) has its centre at (i + 1/2, j + 1/2).
// A vertex is a clip position (x, y, z, w) as a vertex shader writes it; w <= 0 is allowed. All
// inputs are float32. A triangle with a position that is not finite is discarded and counted.
//
// See also vertex_stage.h (object space to clip space), shading.h (fragments to colours) and
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

/// Maximum width and height of a framebuffer in pixels, inclusive.
inline constexpr int kMaxSize = 16384;
/// Maximum number of float attributes per vertex, inclusive.
inline constexpr std::size_t kMaxAttributes = 32;
/// Maximum number of user clip distances per vertex, inclusive.
inline constexpr std::size_t kMaxClipDistances = 8;
/// Maximum number of triangles per draw, inclusive.
inline constexpr std::size_t kMaxTriangles = std::size_t{1} << 31;

/// Clip depth range, direction of window y and provoking vertex, by API:
/// | | opengl | vulkan | d3d |
/// | clip depth | −w…w | 0…w | 0…w |
/// | window y | up | down, as NDC y | down, NDC y up |
/// | provoking vertex | last | first | first |
enum class Convention { opengl, vulkan, d3d };

enum class Cull { none, back, front };
/// Orientation of front faces, as displayed.
enum class FrontFace { ccw, cw };
/// The edges that own a sample lying exactly on them, as displayed.
enum class FillRule { top_left, bottom_left };
/// Condition for keeping a fragment: with `less`, its depth must be less than the sample's, and so
/// on.
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

/// How a drawn colour s combines with the stored colour d, per sample, in submission order.
///
///   off        s
///   over       s_a s + (1 − s_a) d for the first three channels, s_a + (1 − s_a) d_a for the last,
///              where s_a is the last of four channels; the colour is not premultiplied
///   additive   s + d
///
/// Computed in double, with every operation rounded, then rounded to the framebuffer's format. With
/// ColorFormat::rgba8, the drawn colour is first clamped to [0, 1] (NaN to 0) and then blended in
/// units of bytes: 255 times the drawn colour stands for s, the stored byte for d, and the result
/// is rounded to the nearest byte, ties to even.
enum class Blend { off, over, additive };

/// Storage format of depths, as fragments and framebuffers have them and depth tests compare them.
///
///   float32   the nearest float
///   unormB    k/(2^B − 1) with the nearest whole number k, handed over as the nearest float. These
///             floats differ for different k and have the same order, so a depth test that compares
///             them compares the k.
enum class DepthFormat { float32, unorm16, unorm24 };

/// An offset o that is added to the depths of a triangle:
///
///   o = m · slope + r · constant, at most `clamp` if that is above 0, at least `clamp` if below 0
///   m = max(|∂d/∂u|, |∂d/∂v|) of the window depth d, per pixel of window x and y
///   r   unormB: 2^-B; Convention::d3d: the least positive depth 1/(2^B − 1) as float32
///       float32: 2^(e − 23) with 2^e <= d_max < 2^(e + 1), where d_max is the greatest depth of
///       the three vertices, each clamped to the viewport's depth range; a vertex with w <= 0
///       counts as the range's greater end. 0 if d_max = 0.
///
/// m belongs to the plane that depths come from (State::basis); it is 0 for triangles that
/// Conservative::outer draws without area. The sum d + o is clamped to the viewport's depth range
/// if State::depth_clamp is set or the convention is d3d, else to [0, 1].
struct DepthBias {
  float constant = 0;
  float slope = 0;
  float clamp = 0;

  /// True if nothing is added; `clamp` then means nothing.
  bool is_none() const { return constant == 0 && slope == 0; }
};

/// Storage format of a sample's colour.
enum class ColorFormat {
  float32,  ///< any number of attributes
  /// Four channels of a byte each. Byte k means k/255. Values are rounded to the nearest byte, ties
  /// to even; values below 0 and NaN become 0, values above 1 become 255.
  rgba8,
};

/// The grid point that a position is rounded to, along each axis.
enum class Rounding {
  nearest_even,  ///< the nearest; halfway between two, the one with the even coordinate
  half_up,       ///< the nearest; halfway between two, the one with the larger coordinate
  floor,         ///< the next one with a lesser coordinate
};

/// Rounds the vertices' window positions to a grid, before edges are set up (RULES §3).
struct Snapping {
  int subpixel_bits = 8;  ///< grid spacing 2^-subpixel_bits pixels; 0…16
  Rounding rounding = Rounding::nearest_even;
};
inline constexpr int kLeastSubpixelBits = 0;
inline constexpr int kMostSubpixelBits = 16;
/// Snapped vertices lie within this many pixels of the window's origin along x and along y. The
/// parts of a triangle beyond this distance, beyond a depth plane or at negative clip distances are
/// clipped away, which makes new vertices.
inline constexpr int kGuardBand = 32768;

/// With Snapping: whether depth, attributes and facing come from the triangle of the clip positions
/// or from the triangle of the snapped vertices.
enum class Basis { ideal, snapped };

/// Whether whole pixels are covered, with all their samples. S is a pixel's open square, and T the
/// triangle inside all clip planes, user clip distances and the viewport.
///
///   off     samples are covered, one by one
///   outer   pixels whose S meets T. A triangle that only touches a pixel's border does not cover
///   the
///           pixel. A triangle without area covers the pixels whose S it meets, is back-facing, and
///           has its provoking vertex's attributes and depth everywhere. If all vertices have the
///           same z/w, that is the depth; else, if that vertex has w <= 0, z = 0 is.
///   inner   pixels whose S lies in T
///
/// Decided as exact arithmetic does. Values of samples outside T come from the triangle's planes; a
/// smooth attribute is the provoking vertex's value where 1/w <= 0. Depths of `outer` are clamped
/// only if State::depth_clamp is set or the convention is d3d. Not with State::snapping.
enum class Conservative { off, outer, inner };

/// Arithmetic of fragment attributes: double with one rounding to float32 at the end, or float32.
/// Depth always uses double, and so do all values that are drawn into framebuffers.
enum class Precision { float64, float32 };

/// Maximum error of a value f, in scale ULP: (f − r) / ulp(max(|r|, max |r_i|)), where r is the
/// exact result for the vertices' values r_i and ulp is that of float32. For depth,
/// max(|min_depth|, |max_depth|) takes the place of max |r_i|. Half an ULP comes from the rounding
/// to float32, and 2^-7 from the error of double before it (derived in internal/certificates.h).
inline constexpr double kValueBound = 0.5 + 0x1p-7;
/// Maximum error of attributes with Precision::float32, in scale ULP. kFloatSmoothBound is for
/// smooth attributes, kFloatAffineBound for attributes that are linear in the window
/// (noperspective, or smooth with all w equal). They are 6 29/36 + 3/128 and 3 11/12 + 3/128,
/// rounded up (derived in internal/float_kernels.h).
inline constexpr double kFloatSmoothBound = 6.83;
inline constexpr double kFloatAffineBound = 3.95;
/// Maximum error of a screen derivative d, in ulp(max(|d|, M)). d is a difference of terms, and M
/// is their size (derived in internal/derivatives.h).
inline constexpr double kDerivativeBound = 0.5 + 0x1p-7 + 0x1p-22;

/// `smooth`: linear in clip space; `noperspective`: linear in window space; `flat`: the provoking
/// vertex's value.
enum class Interpolation { smooth, noperspective, flat };
/// Where an attribute is evaluated. `centroid`: the pixel's centre if all its samples are covered,
/// else its first covered sample.
enum class Location { sample, center, centroid };

struct Qualifier {
  Interpolation interpolation = Interpolation::smooth;
  Location location = Location::sample;
};

/// NDC [−1, 1]² maps to `origin` … `origin + size` in window pixels; sizes may be negative. Depth
/// maps to [min_depth, max_depth]; either may be the greater, and both must be within [0, 1].
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

/// What the vertices of a mesh are joined to.
enum class Primitive { triangles, lines, points };

/// The samples that a line covers. a and b are the window positions of its ends; the *major axis*
/// is the one along which they are farther apart, x if equally far.
///
///   rectangular     at most half of `line_width` from the line through a and b, and between the
///                   two perpendiculars through a and b
///   parallelogram   at most half of `line_width` from it along the minor axis, and between a and b
///                   along the major one
///   bresenham       all samples of the pixels that the diamond-exit rule selects, replicated along
///                   the minor axis to as many as `line_width` is when rounded, at least 1
///
/// Decided as exact arithmetic does; samples on borders by the fill rule. A line without length
/// covers nothing. Clip planes, clip distances and the viewport's sides cut the line through the
/// middle.
enum class LineMode { rectangular, parallelogram, bresenham };

/// The settings of a draw.
struct State {
  Convention convention = Convention::vulkan;
  Primitive primitive = Primitive::triangles;
  LineMode line_mode = LineMode::rectangular;
  /// In pixels, above 0. A point covers the samples of the square that is `point_size` wide around
  /// its vertex; it is not drawn if the vertex has w <= 0 or is clipped.
  float line_width = 1;
  float point_size = 1;
  Viewport viewport = {};
  /// The pixels that may be drawn; by default, all.
  Rectangle scissor{{0, 0}, {kMaxSize, kMaxSize}};
  Cull cull = Cull::none;
  FrontFace front_face = FrontFace::ccw;
  FillRule fill_rule = FillRule::top_left;
  DepthTest depth_test = DepthTest::always;
  bool depth_write = true;  ///< true if a kept fragment writes its depth
  Blend blend = Blend::off;
  std::optional<Snapping> snapping =
      {};  ///< empty: draws the triangle of the clip positions exactly
  Basis basis = Basis::ideal;
  Conservative conservative = Conservative::off;
  Precision precision = Precision::float64;
  bool depth_clamp = false;
  DepthBias depth_bias = {};
  /// With a unorm format, depths are clamped as biased ones are.
  DepthFormat depth_format = DepthFormat::float32;
  /// True if fragments carry the screen derivatives of their attributes. Only draw_fragments()
  /// reads this.
  bool derivatives = false;
  std::vector<Qualifier> attributes = {};  ///< one for each float attribute of a vertex
  std::size_t clip_distance_count = 0;     ///< user clip distances of a vertex
};

/// Indexed triangles, lines or points (State::primitive). A line has the vertices a, b, b, and a
/// point a, a, a; so the provoking vertex of a line is b with Convention::opengl, else a. Culling
/// and Precision do not apply to lines and points, which count as front faces. The spans must
/// outlive the draw.
struct Mesh {
  std::span<const glm::vec4> positions = {};   ///< [vertex], clip space
  std::span<const float> attributes = {};      ///< [vertex][attribute]
  std::span<const float> clip_distances = {};  ///< [vertex][distance]
  std::span<const glm::uvec3> triangles = {};  ///< vertex indices, in submission order
};

/// Width and height in pixels; samples per pixel (1, 2, 4, 8 or 16, in the standard patterns).
struct TargetSize {
  int width = 0;
  int height = 0;
  int samples = 1;
};

/// The reason why a draw was refused. Nothing is drawn then, unless memory ran out during the draw.
enum class Error {
  target_size,           ///< width or height not in 1…kMaxSize, or arrays of another size
  sample_count,          ///< not 1, 2, 4, 8 or 16
  viewport,              ///< a number that is not finite, or depths outside [0, 1]
  scissor,               ///< a negative size
  depth_bias,            ///< a number that is not finite
  subpixel_bits,         ///< not 0…16
  snapped_conservative,  ///< conservative coverage of snapped vertices
  primitive_size,        ///< a line width or point size that is not finite and above 0
  primitive_state,       ///< conservative coverage or a depth bias of lines or points
  attribute_count,       ///< more than kMaxAttributes, or not the framebuffer's
  clip_distance_count,   ///< more than kMaxClipDistances
  attribute_values,      ///< too few or too many values for the vertices and attributes
  clip_distance_values,  ///< too few or too many values for the vertices and distances
  index,                 ///< a vertex index beyond the positions
  triangle_count,        ///< more than kMaxTriangles
  color_format,          ///< ColorFormat::rgba8 or Blend::over without exactly four channels
  output_count,          ///< a shader has fewer or more outputs than the framebuffer has channels
  unknown_method,        ///< no textbook method has that name
  out_of_memory,
};

/// One sentence that explains the error and names the argument.
std::string_view to_string(Error error);

/// The numbers of a draw's triangles that were discarded, by reason.
struct DrawCounts {
  std::size_t discarded_not_finite = 0;  ///< a position or clip distance is infinite or NaN
  std::size_t discarded_degenerate = 0;  ///< no area, edge-on, or the viewport has no area
  bool operator==(const DrawCounts&) const = default;
};

/// Fragments as a structure of arrays, ordered by triangle, y, x and sample. Each triangle is drawn
/// as if it were alone.
struct Fragments {
  std::vector<std::uint32_t> triangle;
  std::vector<std::uint16_t> x;
  std::vector<std::uint16_t> y;
  std::vector<std::uint8_t> sample;
  std::vector<float> depth;
  std::vector<float> attributes;  ///< [fragment][attribute]
  /// [fragment][attribute][2]: ∂r/∂u and ∂r/∂v of the attribute r at its own location, per pixel of
  /// window x and y; 0 for flat attributes. Filled only if State::derivatives is set; otherwise
  /// left unchanged.
  std::vector<float> derivatives;

  std::size_t size() const { return triangle.size(); }
};

/// Allocates memory aligned to cache lines, so that whole lines can be written.
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

/// A framebuffer: depth, and attributes or the channels of a colour.
struct Picture {
  using Values = std::vector<float, CacheLineAllocator<float>>;
  using Bytes = std::vector<std::uint8_t, CacheLineAllocator<std::uint8_t>>;

  TargetSize size = {};
  std::size_t attribute_count = 0;
  ColorFormat format = ColorFormat::float32;
  Values depth = {};       ///< [y][x][sample]
  Values attributes = {};  ///< [y][x][sample][attribute]; for float32
  Bytes bytes = {};        ///< [y][x][sample][4]; for rgba8
};

/// If `error` is set, nothing was drawn, unless memory ran out. Otherwise `counts` has the numbers
/// of discarded triangles.
struct DrawResult {
  std::optional<Error> error;
  DrawCounts counts;
};

/// Appends every fragment of every triangle, as if each triangle were drawn alone. Ignores
/// `state.depth_test`.
DrawResult draw_fragments(const State& state, const Mesh& mesh, const TargetSize& size,
                          Fragments& fragments);

/// Returns the number that stands for `depth`, clamped to [0, 1], in a unorm format: what a depth
/// buffer of that format begins with. float32: `depth` itself. `depth` must not be NaN.
float stored_depth(DepthFormat format, float depth);

/// Sets the framebuffer to the given size, to `depth` (see stored_depth()) and to zero attributes,
/// in the framebuffer's own format. Returns an error if the size is invalid or memory runs out.
std::optional<Error> clear(Picture& framebuffer, const TargetSize& size,
                           std::size_t attribute_count, float depth);

/// Draws attributes into the framebuffer, triangle by triangle in submission order. `threads` = 0
/// uses as many threads as the machine has; the picture is the same for any number of threads. If
/// memory runs out, each tile of 64 × 64 pixels is drawn in part or unchanged.
DrawResult draw(const State& state, const Mesh& mesh, Picture& framebuffer, unsigned threads = 1);

/// Does clear() and draw() in one: each tile is cleared when it is drawn, so the framebuffer's
/// memory is usually written only once. If memory runs out, the framebuffer is drawn in part or
/// holds arbitrary numbers.
DrawResult clear_and_draw(const State& state, const Mesh& mesh, const TargetSize& size, float depth,
                          Picture& framebuffer, unsigned threads = 1);

/// Averages each pixel's samples, rounding once; takes depth from sample 0. `from` and `into` must
/// not be the same object. Returns an error if memory runs out or `from` is malformed.
std::optional<Error> resolve(const Picture& from, Picture& into);

}  // namespace rastercheck::rasterizer
