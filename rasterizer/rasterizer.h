#pragma once

// The public face of the rasterizer, a library of its own: clip-space triangles in, fragments or
// pictures out. It needs GLM and nothing else of this project.
//
// Conventions. Window coordinates are in pixels; pixel (i, j) has its centre at (i + 1/2, j + 1/2).
// A vertex is a clip position (x, y, z, w) as a vertex shader writes it; w <= 0 is allowed. All
// inputs are float32; triangles with a position that is not finite are discarded and counted.
//
// What it does not do: shade, blend, resolve samples, run a vertex stage.

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
enum class DepthTest { none, less };

/// The vertices' window positions rounded to the nearest point of a grid, ties to even, before
/// edges are set up (RULES §3).
struct Snapping {
  int subpixel_bits = 8;  ///< a grid of 2^-subpixel_bits pixels, 4…16
};
inline constexpr int kLeastSubpixelBits = 4;
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
  Viewport viewport;
  /// The pixels that may be drawn; by default all.
  Rectangle scissor{{0, 0}, {kMaxSize, kMaxSize}};
  Cull cull = Cull::none;
  FrontFace front_face = FrontFace::ccw;
  FillRule fill_rule = FillRule::top_left;
  DepthTest depth_test = DepthTest::none;
  std::optional<Snapping> snapping;  ///< nothing: the triangle of the clip positions, exactly
  Basis basis = Basis::ideal;
  Precision precision = Precision::float64;
  bool depth_clamp = false;
  /// Whether fragments carry their attributes' screen derivatives. draw_fragments alone asks.
  bool derivatives = false;
  std::vector<Qualifier> attributes;    ///< one for each float attribute of a vertex
  std::size_t clip_distance_count = 0;  ///< user clip distances of a vertex
};

/// Indexed triangles. The spans must outlive the draw.
struct Mesh {
  std::span<const glm::vec4> positions;   ///< [vertex], clip space
  std::span<const float> attributes;      ///< [vertex][attribute]
  std::span<const float> clip_distances;  ///< [vertex][distance]
  std::span<const glm::uvec3> triangles;  ///< vertex indices, in submission order
};

/// Width and height in pixels, samples per pixel (1, 2, 4, 8 or 16, the standard patterns).
struct TargetSize {
  int width = 0;
  int height = 0;
  int samples = 1;
};

/// Why a draw was refused; nothing is drawn then, unless memory ran out on the way.
enum class Error {
  target_size,           ///< width or height not in 1…kMaxSize
  sample_count,          ///< not 1, 2, 4, 8 or 16
  viewport,              ///< a number that is not finite, or depths outside [0, 1]
  scissor,               ///< a negative size
  subpixel_bits,         ///< not 4…16
  attribute_count,       ///< more than kMaxAttributes
  clip_distance_count,   ///< more than kMaxClipDistances
  attribute_values,      ///< not one value for each vertex and attribute
  clip_distance_values,  ///< not one value for each vertex and distance
  index,                 ///< a vertex index beyond the positions
  unknown_method,        ///< no textbook method of that name
  out_of_memory,
};

/// One sentence about an error, naming the argument.
std::string_view to_string(Error error);

/// What became of the triangles of a draw.
struct DrawCounts {
  std::size_t discarded_not_finite = 0;
  std::size_t discarded_degenerate = 0;
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

/// What a framebuffer holds after a depth-tested draw.
struct Framebuffer {
  using Values = std::vector<float, CacheLineAllocator<float>>;

  TargetSize size;
  std::size_t attribute_count = 0;
  Values depth;       ///< [y][x][sample]
  Values attributes;  ///< [y][x][sample][attribute]
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

/// A framebuffer whose samples all have this depth and zero attributes; an error where the size is
/// not valid or memory runs out.
std::optional<Error> clear(Framebuffer& framebuffer, const TargetSize& size,
                           std::size_t attribute_count, float depth);

/// Draws into the framebuffer, triangle by triangle in submission order: with DepthTest::less a
/// fragment is kept iff its depth is less than the sample's. On that many threads, 0: as many as
/// the machine has; the picture is the same for any number. Where memory runs out tiles of 64 × 64
/// pixels hold some of what was to be drawn, or are what they were.
DrawResult draw(const State& state, const Mesh& mesh, Framebuffer& framebuffer,
                unsigned threads = 1);

/// clear() and draw() in one: each tile is cleared where it is drawn, so that most often the memory
/// of the framebuffer is written once. Where memory runs out it holds some of what was to be drawn,
/// or any numbers.
DrawResult clear_and_draw(const State& state, const Mesh& mesh, const TargetSize& size, float depth,
                          Framebuffer& framebuffer, unsigned threads = 1);

}  // namespace rastercheck::rasterizer
