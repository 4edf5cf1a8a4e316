#pragma once

// The Case: everything that is drawn, as plain data. docs/case-format.md describes the case file,
// version 1.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/coverage.h"
#include "cases/picture_layout.h"

namespace rastercheck::cases {

/// The largest width and height of a framebuffer, viewport or scissor, in pixels, inclusive.
inline constexpr int kMaxSize = 16384;
/// The largest number of attributes, inclusive.
inline constexpr std::size_t kMaxAttributes = 32;
/// The largest number of user clip distances, inclusive.
inline constexpr std::size_t kMaxClipDistances = 8;
/// The largest line width and point size, in pixels, inclusive.
inline constexpr float kMostPrimitiveSize = 16384;

/// The API whose conventions apply: clip depth, direction of window y, depth map, provoking vertex.
enum class Rules { opengl, vulkan, d3d };

enum class Cull { none, back, front };

/// The orientation of a front face, as displayed.
enum class FrontFace { ccw, cw };

/// How an attribute varies: `smooth` linearly over the triangle in clip space, `noperspective`
/// linearly in window space, `flat` takes the provoking vertex's value.
enum class Interpolation { smooth, noperspective, flat };

/// Where in the pixel an attribute is evaluated. Depth always belongs to the sample.
enum class Location { sample, center, centroid };

/// `less` keeps the nearest fragment of each sample (of equally near ones, the first drawn) if the
/// fragment is nearer than the initial value of the depth buffer.
enum class DepthTest { none, less };

/// Adds m · slope + r · constant to all depths of a triangle before they are clamped, where m is
/// how much the depth changes from one pixel to the next, and r is the least difference that the
/// depth format resolves (RULES §8, cases::BiasPromise). `clamp` limits the sum: from above if
/// positive, from below if negative.
struct DepthBias {
  float constant = 0;
  float slope = 0;
  float clamp = 0;
  bool operator==(const DepthBias&) const = default;

  /// True if nothing is added to any depth.
  bool is_none() const { return constant == 0 && slope == 0; }
};

/// What the vertices are joined to.
enum class Primitive { triangles, lines, points };

/// Which samples a line covers (RULES §10). a and b are the window positions of its ends; the
/// *major axis* is that along which they are farther apart, x if equally far.
///
///   rectangular     those of the rectangle that is `line_width` wide, whose middle line is from a
///                   to b
///   parallelogram   those of the parallelogram whose middle line is from a to b and whose ends are
///                   `line_width` long and parallel to the other axis
///   bresenham       all samples of the pixels that the diamond-exit rule selects; if `line_width`
///                   is more than 1, of as many pixels along the other axis as it has when rounded
enum class LineMode { rectangular, parallelogram, bresenham };

/// Pixels, and samples per pixel (1, 2, 4, 8 or 16).
struct FramebufferSize {
  int width = 0;
  int height = 0;
  int samples = 1;
  bool operator==(const FramebufferSize&) const = default;
};

/// NDC [-1, 1] maps to [x, x + width] × [y, y + height], in window pixels; sizes may be negative
/// and fractional. Depth maps to [min_depth, max_depth] within [0, 1]; min_depth may exceed
/// max_depth except under `d3d`.
struct Viewport {
  float x = 0;
  float y = 0;
  float width = 0;
  float height = 0;
  float min_depth = 0;
  float max_depth = 1;
  bool operator==(const Viewport&) const = default;
};

/// Pixels (i, j) with x <= i < x + width and y <= j < y + height are drawn.
struct Scissor {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  bool operator==(const Scissor&) const = default;
};

struct Attribute {
  std::string name;
  Interpolation interpolation = Interpolation::smooth;
  Location location = Location::sample;
  bool operator==(const Attribute&) const = default;
};

/// A homogeneous position: clip space, or object space in a Case with a camera.
struct ClipVertex {
  float x = 0;
  float y = 0;
  float z = 0;
  float w = 1;
  bool operator==(const ClipVertex&) const = default;
};

/// x, y and z of a normal.
using Normal = std::array<float, 3>;

/// A 4×4 matrix, row-major, that multiplies column vectors from the left.
using Matrix4 = std::array<float, 16>;
inline constexpr Matrix4 kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// clip = projection · view · model · position.
struct Camera {
  Matrix4 model = kIdentity;
  Matrix4 view = kIdentity;
  Matrix4 projection = kIdentity;
  bool operator==(const Camera&) const = default;
};

/// The origin of a counterexample. Written with the case, ignored when drawn.
struct Found {
  std::string law;
  std::string backend;
  std::string verdict;
  std::uint64_t seed = 0;
  std::uint64_t index = 0;
  std::string kind = {};       ///< what was wrong: a kind of value, or coverage
  std::string condition = {};  ///< the condition of the wrong fragment
  bool operator==(const Found&) const = default;
};

/// Indices of the triangle's vertices, in submission order. A line has its second vertex twice, a
/// point has its vertex three times.
using Triangle = std::array<std::uint32_t, 3>;

/// Everything that decides what is drawn. All numbers are finite.
struct Case {
  std::string name;
  FramebufferSize framebuffer;
  Viewport viewport;
  Rules rules = Rules::vulkan;
  Coverage coverage;
  /// The positions that attributes and facing are computed from; matters only if `coverage` is
  /// snapped.
  Basis basis = Basis::ideal;
  TieRule fill_rule = TieRule::top_left;  ///< never `unspecified` in a Case
  Cull cull = Cull::none;
  FrontFace front_face = FrontFace::ccw;
  std::optional<Scissor> scissor;
  DepthTest depth_test = DepthTest::none;
  /// The initial value of the depth buffer, within [0, 1]; matters only with a depth test. Empty: 1
  /// or anything farther, so that a fragment of depth 1 may be drawn or not.
  std::optional<float> depth_clear;
  bool depth_clamp = false;
  DepthBias depth_bias;
  /// The format that depths are stored in, as fragments have them and depth tests compare them: one
  /// of kDepthFormatsOfCases. A unorm depth k/(2^n − 1) is handed over as the nearest float32.
  DepthFormat depth_format = DepthFormat::float32;
  std::vector<Attribute> attributes;
  std::optional<Camera> camera;
  std::vector<ClipVertex> positions;  ///< [vertex]
  /// [vertex][attribute], `attributes.size()` numbers per vertex.
  std::vector<float> attribute_values;
  /// [vertex][distance], `clip_distance_count` numbers per vertex.
  std::vector<float> clip_distances;
  std::size_t clip_distance_count = 0;
  Primitive primitive = Primitive::triangles;
  std::vector<Triangle> triangles;  ///< or the lines, or the points
  float line_width = 1;             ///< in pixels; > 0, at most kMostPrimitiveSize
  LineMode line_mode = LineMode::rectangular;
  float point_size = 1;  ///< the side of the square that a point is, in pixels; as line_width
  /// The features that the case is about: names of cases::Feature, "rules", "samples" and "size".
  /// Everything else may be removed from the case if a backend could not draw the case otherwise.
  /// Empty: everything but rules and samples is essential. Ignored when drawn.
  std::optional<std::vector<std::string>> essential;
  /// The seed of laws' choices (properties/choices.h); empty: a hash of the case. Ignored when
  /// drawn.
  std::optional<std::uint64_t> choices;
  std::optional<Found> found;
  /// The layout of pictures of the case (`rastercheck judge`). Ignored when drawn.
  std::optional<PictureLayout> picture;

  /// The attribute values of one vertex, in the order of `attributes`.
  std::span<const float> attributes_of(std::size_t vertex) const;
  /// The clip distances of one vertex.
  std::span<const float> clip_distances_of(std::size_t vertex) const;
  bool operator==(const Case&) const = default;
};

/// The defaults that depend on the rules (RULES §3, §4): ties go to bottom-left edges under
/// `opengl`, and to top-left edges under `vulkan` and `d3d`; `d3d` takes attributes and facing from
/// the snapped positions.
TieRule default_fill_rule(Rules rules);
Basis default_basis(Rules rules);
/// Bresenham's lines under `d3d`, and under `opengl` with one sample; else rectangular ones.
LineMode default_line_mode(Rules rules, int samples);

}  // namespace rastercheck::cases
