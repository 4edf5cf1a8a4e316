#pragma once

// What is drawn: the Case, as plain data. CONTRACT: the case file, version 1; docs/case-format.md.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/coverage.h"

namespace rastercheck::cases {

/// Width and height of a framebuffer, viewport or scissor, in pixels, inclusive.
inline constexpr int kMaxSize = 16384;
/// Attributes of a vertex, inclusive.
inline constexpr std::size_t kMaxAttributes = 32;
/// User clip distances of a vertex, inclusive.
inline constexpr std::size_t kMaxClipDistances = 8;

/// The API whose conventions hold: clip depth, direction of window y, depth map, provoking vertex.
enum class Rules { opengl, vulkan, d3d };

enum class Cull { none, back, front };

/// The orientation of a front face, as displayed.
enum class FrontFace { ccw, cw };

/// How an attribute varies: `smooth` linearly over the triangle in clip space, `noperspective`
/// linearly in window space, `flat` takes the provoking vertex's value.
enum class Interpolation { smooth, noperspective, flat };

/// Where in the pixel an attribute is evaluated. Depth always belongs to the sample.
enum class Location { sample, center, centroid };

/// `less` keeps the nearest fragment of each sample, the first drawn of equal ones, if it is nearer
/// than what the depth buffer begins with.
enum class DepthTest { none, less };

/// Pixels, and samples per pixel (1, 2, 4, 8 or 16).
struct FramebufferSize {
  int width = 0;
  int height = 0;
  int samples = 1;
  bool operator==(const FramebufferSize&) const = default;
};

/// NDC [-1, 1] maps to [x, x + width] × [y, y + height], in window pixels; sizes may be negative
/// and fractional. Depth maps to [min_depth, max_depth] within [0, 1]; the two may be in any order
/// but for `d3d`.
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

/// Where a counterexample comes from. Written with it, ignored when drawn.
struct Found {
  std::string law;
  std::string backend;
  std::string verdict;
  std::uint64_t seed = 0;
  std::uint64_t index = 0;
  std::string kind = {};       ///< of values, or coverage: what was wrong
  std::string condition = {};  ///< of the fragment that it was wrong of
  bool operator==(const Found&) const = default;
};

/// Indices of the triangle's vertices, in submission order.
using Triangle = std::array<std::uint32_t, 3>;

/// Everything that decides what is drawn. All numbers are finite.
struct Case {
  std::string name;
  FramebufferSize framebuffer;
  Viewport viewport;
  Rules rules = Rules::vulkan;
  Coverage coverage;
  /// Positions that attributes and facing come from; matters only when `coverage` is snapped.
  Basis basis = Basis::ideal;
  TieRule fill_rule = TieRule::top_left;  ///< never `unspecified` in a Case
  Cull cull = Cull::none;
  FrontFace front_face = FrontFace::ccw;
  std::optional<Scissor> scissor;
  DepthTest depth_test = DepthTest::none;
  /// The depth buffer begins with this, within [0, 1]; matters only where there is a depth test.
  /// Nothing: 1, or anything farther, so that a fragment of depth 1 may be drawn or not.
  std::optional<float> depth_clear;
  bool depth_clamp = false;
  std::vector<Attribute> attributes;
  std::optional<Camera> camera;
  std::vector<ClipVertex> positions;  ///< [vertex]
  /// [vertex][attribute], `attributes.size()` numbers a vertex.
  std::vector<float> attribute_values;
  /// [vertex][distance], `clip_distance_count` numbers a vertex.
  std::vector<float> clip_distances;
  std::size_t clip_distance_count = 0;
  std::vector<Triangle> triangles;
  /// Names what the case is about, by the names of cases::Feature and "rules", "samples" and
  /// "size": where something else keeps a backend from drawing it, that may be left out. Nothing:
  /// all but rules and samples. Ignored when drawn.
  std::optional<std::vector<std::string>> essential;
  std::optional<Found> found;

  /// The attribute values of one vertex, in the order of `attributes`.
  std::span<const float> attributes_of(std::size_t vertex) const;
  /// The clip distances of one vertex.
  std::span<const float> clip_distances_of(std::size_t vertex) const;
  bool operator==(const Case&) const = default;
};

/// The defaults that depend on the rules (RULES §3, §4): ties of `opengl` go to bottom-left edges,
/// those of `vulkan` and `d3d` to top-left ones; `d3d` takes attributes and facing from the snapped
/// positions.
TieRule default_fill_rule(Rules rules);
Basis default_basis(Rules rules);

}  // namespace rastercheck::cases
