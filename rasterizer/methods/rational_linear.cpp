// rational-linear: the rational linear rendering algorithm of Heckbert and Moreton, Interpolation
// for Polygon Texture Mapping and Shading, §3.5 (seed 002), in double.
//
// The mathematics (seed 002 §3.2). Parameters r_i that are affine in clip space divide into
//
//   s_i = r_i / w,   s_{n+1} = 1 / w,
//
// which are affine in window space. So: clip the triangle, with r_i linear in clip space; at each
// vertex divide by w; interpolate s_i linearly along the edges and along the rows; at each sample
// divide:
//
//   r_i = s_i / s_{n+1}.
//
// Depth z / w is affine in window space as it is (seed 002 §3.2, α x + β y + γ). An attribute
// declared `noperspective` is affine in window space by definition; r_i w is then what is linear in
// clip space, and s_i = (r_i w) / w, so that clipping does not change it.
//
// Window positions. With the viewport (x0, y0, W, H):
//   u = (x W/2 + w (x0 + W/2)) / w     v = (±y H/2 + w (y0 + H/2)) / w     (− for D3D)
// Row v of the target is displayed below the others where v points down (Vulkan, D3D), above where
// it points up (OpenGL). Depth is n + (f − n) z/w; OpenGL: n + (f − n)(z/w + 1)/2; held to the
// range between n and f, which without depth clamp takes away rounding only.
//
// Facing is the sign of det (X, Y, w), X = u w and Y = v w, which is W H times that of (x, y, w)
// and found exactly (internal/determinant.h); it needs no w > 0. Zero covers nothing and is
// counted.
//
// Locations. `sample`: where the fragment's sample lies. `center`: on the span of the centre's row
// where that covers the centre, otherwise by the plane of s_i, undefined where s_{n+1} <= 0 there.
// The plane is the whole triangle's, as what clipping left of it may be too thin to carry one. With
// the centre as origin of window space and e_0 = X_1 Y_2 - X_2 Y_1 and so on,
//
//   s_k = (sum of p_ik e_i) / (sum of w_i e_i),   p_ik what is linear in clip space (r, r w, or 1).
//
// No w_i is divided by, so vertices with w <= 0 are no different. `centroid`: the centre where
// every sample of the pixel is drawn (viewport included), otherwise the first sample that is.
//
// Error, first order, u = 2^-53 (rounding to float32, once, comes on top).
//
// Vertices. X and Y have at most two roundings of products and sums and one of the division, so
// they are off by δ <= 2 u (|x W/2w| + |x0 + W/2|) + u |position| pixels; s_i has one, relative u.
//
// Crossings. Off by δ_c <= 11 u max|u_end| (internal/convex_scan.h), besides what the errors of the
// vertices move the edge. Coordinates reach 2^10 half widths (internal/clip_polygon.h), so a far
// end costs up to 2^-39 half widths; ends within the target cost some 2^-49 widths.
//
// Means. Along an edge and along a span s_i is a mean of two ends, five roundings each time, so
// with the rounding at the vertices |δs_i| <= 11 u max|s_i|. To this comes what the places
// contribute: an edge that is off by δ carries the values of a row or column δ away, (|∂s_i/∂u| +
// |∂s_i/∂v|) δ.
//
// Quotients. |δr_i| <= (|δs_i| + |r_i| |δs_{n+1}|) / s_{n+1} + u |r_i|, that is
//
//   |δr_i| <= (|∂r_i/∂u| + |∂r_i/∂v|) δ + 23 u max|r_i| max(1/w) / s_{n+1}.
//
// The first term has no bound in terms of the triangle's values alone: a sliver d pixels wide has
// derivatives of about the range of its values over d, so they are off by δ/d of that range. The
// second grows towards the horizon, where s_{n+1} is small against the greatest 1/w.
//
// By the plane. δe_0 <= 8 u (|X_1| + |w_1| m) (|Y_2| + |w_2| m) and its mirror, m the distance of
// the centre from the viewport's middle; then |δr_i| <= 2 max|r_i| (sum of |δe_i|) / |sum of e_i|.
//
// Coverage. Wrong only for samples within δ_c, and what the vertices' errors move the edge, of it.
//
// What it does not do: snap positions to a subpixel grid; decide coverage exactly (ties come out
// right where positions lie on a coarse grid, see internal/convex_scan.h, but not always on an edge
// that clipping has cut, whose new end is rounded); draw a triangle that touches a clip plane in
// one point only; keep one whose plane passes through the eye but for roundings, which clipping may
// lose whole; bound its errors. Seed 002's reciprocal and products in place of the n divisions per
// pixel are not taken: they cost a rounding more.
//
// Triangles with a clip distance that is not finite are counted with those that have such a
// position.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <span>

#include "rasterizer/internal/clip_polygon.h"
#include "rasterizer/internal/convex_scan.h"
#include "rasterizer/internal/determinant.h"
#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/standard_pattern.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

// The parameters of a window vertex: z/w, 1/w, then one for each attribute.
constexpr std::size_t kDepth = 0;
constexpr std::size_t kReciprocalW = 1;
constexpr std::size_t kFirstAttribute = 2;

using Values = std::array<float, kMaxAttributes>;

/// The nearest float32; beyond them infinity.
float rounded(double value) {
  static_assert(std::numeric_limits<float>::is_iec559);
  return static_cast<float>(value);
}

int sign(float value) { return (value > 0) - (value < 0); }

/// How the window positions turn for clip positions that turn from x to y.
int viewport_sign(const State& state) {
  const int turned = state.convention == Convention::d3d ? -1 : 1;
  return turned * sign(state.viewport.size.x) * sign(state.viewport.size.y);
}

/// Whether the rows belong to the edges of least v: so it is where those are displayed as the rule
/// says.
bool least_v_included(const State& state) {
  const bool v_points_down = state.convention != Convention::opengl;
  return (state.fill_rule == FillRule::top_left) == v_points_down;
}

/// Window depth from z/w.
class DepthMap {
 public:
  explicit DepthMap(const State& state)
      : near_(state.viewport.min_depth),
        far_(state.viewport.max_depth),
        from_minus_one_(state.convention == Convention::opengl) {}

  float operator()(double z) const {
    const double fraction = from_minus_one_ ? (z + 1) / 2 : z;
    const double depth = near_ + (far_ - near_) * fraction;
    return rounded(std::clamp(depth, std::min(near_, far_), std::max(near_, far_)));
  }

 private:
  double near_;
  double far_;
  bool from_minus_one_;
};

/// A window position times w.
struct Numerators {
  double x = 0;
  double y = 0;
};

/// X_a Y_b − X_b Y_a.
double cross(const Numerators& a, const Numerators& b) { return a.x * b.y - b.x * a.y; }

/// Clip positions to window vertices.
class WindowMap {
 public:
  explicit WindowMap(const State& state)
      : half_width_(double{state.viewport.size.x} / 2),
        half_height_(double{state.viewport.size.y} /
                     (state.convention == Convention::d3d ? -2 : 2)),
        center_u_(double{state.viewport.origin.x} + double{state.viewport.size.x} / 2),
        center_v_(double{state.viewport.origin.y} + double{state.viewport.size.y} / 2) {}

  /// Step 4: the division by w.
  void divide(const ClipVertex& from, std::size_t attribute_count, WindowVertex& to) const {
    to.u = (from.x * half_width_ + from.w * center_u_) / from.w;
    to.v = (from.y * half_height_ + from.w * center_v_) / from.w;
    to.s[kDepth] = from.z / from.w;
    to.s[kReciprocalW] = 1 / from.w;
    for (std::size_t i = 0; i < attribute_count; ++i) {
      to.s[kFirstAttribute + i] = from.parameters[i] / from.w;
    }
    to.closed = from.closed;
  }

  /// The window position times w, with the origin at (u, v).
  Numerators numerators(const ClipVertex& from, double u, double v) const {
    return {from.x * half_width_ + from.w * (center_u_ - u),
            from.y * half_height_ + from.w * (center_v_ - v)};
  }

 private:
  double half_width_;
  double half_height_;
  double center_u_;
  double center_v_;
};

/// One draw: what stays the same for its triangles, and working memory.
class Drawing {
 public:
  Drawing(const State& state, const Mesh& mesh, const TargetSize& size, Fragments& fragments)
      : state_(state),
        mesh_(mesh),
        fragments_(fragments),
        pattern_(standard_pattern(size.samples)),
        bounds_(draw_bounds(state, size)),
        volume_{state.convention, state.depth_clamp, state.attributes.size(),
                state.clip_distance_count},
        window_map_(state),
        depth_map_(state),
        has_location_{has(Location::sample), has(Location::center), has(Location::centroid)},
        viewport_sign_(viewport_sign(state)),
        least_v_included_(least_v_included(state)) {}

  DrawCounts draw() {
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) draw_triangle(i);
    return counts_;
  }

 private:
  static constexpr std::size_t kMaxSamples = DrawBounds::kMaxSamples;

  /// One row of samples: those with the same index, of one row of pixels.
  struct SampleRow {
    PixelRange columns;  ///< covered
    SpanEnds ends;       ///< defined where there are columns
  };

  bool has(Location location) const;
  void draw_triangle(std::size_t index);
  void load(const glm::uvec3& corners);
  void load_vertex(std::uint32_t vertex, ClipVertex& to) const;
  void divide(int orientation);
  void scan();
  void scan_row(const ConvexScan& scan, int y);
  void set_row(const ConvexScan& scan, double v, double offset, const PixelRange& columns,
               SampleRow& row) const;
  void draw_pixel(const ConvexScan& scan, int x, int y);
  void center_parameters(const ConvexScan& scan, int x, int y, ScanParameters& s) const;
  void extrapolate(double u, double v, ScanParameters& s) const;
  void evaluate(Location location, const ScanParameters& s, Values& values) const;
  void append(int x, int y, std::size_t sample, const ScanParameters& s, const Values& values);

  const State& state_;
  const Mesh& mesh_;
  Fragments& fragments_;
  std::span<const SampleOffset> pattern_;
  DrawBounds bounds_;
  ClipVolume volume_;
  WindowMap window_map_;
  DepthMap depth_map_;
  std::array<bool, 3> has_location_;  ///< [location]: whether an attribute is evaluated there
  int viewport_sign_;
  bool least_v_included_;
  DrawCounts counts_;

  // Of the triangle at hand.
  std::uint32_t triangle_ = 0;
  std::array<ClipVertex, 3> corners_;
  ClipPolygon clipped_;
  ClipPolygon spare_;
  WindowPolygon window_;
  Values flat_{};  ///< [attribute]: the provoking vertex's value
  /// [attribute]: whether all three values are the same zero. Sums and products of zeros may come
  /// out as the other one.
  std::array<bool, kMaxAttributes> is_zero_{};
  // Of the row of pixels at hand.
  std::array<SampleRow, kMaxSamples> rows_;
  SampleRow center_row_;
};

bool Drawing::has(Location location) const {
  return std::any_of(
      state_.attributes.begin(), state_.attributes.end(), [location](const Qualifier& qualifier) {
        return qualifier.interpolation != Interpolation::flat && qualifier.location == location;
      });
}

void Drawing::draw_triangle(std::size_t index) {
  const std::optional<InputTriangle> triangle = input_triangle(state_, mesh_, index);
  if (!triangle) return count(Fate::not_finite, counts_);
  const auto& p = triangle->positions;
  const int orientation = viewport_sign_ * determinant_sign(p[0], p[1], p[2]);
  if (orientation == 0) return count(Fate::degenerate, counts_);
  if (is_culled(state_, orientation)) return;

  triangle_ = triangle->index;
  load(mesh_.triangles[index]);                  // steps 1 and 2
  if (!clip(volume_, clipped_, spare_)) return;  // step 3
  divide(orientation);                           // step 4
  scan();                                        // step 5
}

void Drawing::load(const glm::uvec3& corners) {
  load_vertex(corners.x, corners_[0]);
  load_vertex(corners.y, corners_[1]);
  load_vertex(corners.z, corners_[2]);
  std::copy(corners_.begin(), corners_.end(), clipped_.vertices.begin());
  clipped_.size = 3;
  const std::uint32_t provoking = state_.convention == Convention::opengl ? corners.z : corners.x;
  const std::size_t count = state_.attributes.size();
  std::copy_n(mesh_.attributes.begin() + static_cast<std::ptrdiff_t>(provoking * count), count,
              flat_.begin());
  for (std::size_t i = 0; i < count; ++i) {
    const auto is_same_zero = [&](std::uint32_t vertex) {
      const float value = mesh_.attributes[vertex * count + i];
      return value == 0 && std::signbit(value) == std::signbit(flat_[i]);
    };
    is_zero_[i] = is_same_zero(corners.x) && is_same_zero(corners.y) && is_same_zero(corners.z);
  }
}

void Drawing::load_vertex(std::uint32_t vertex, ClipVertex& to) const {
  const glm::vec4& p = mesh_.positions[vertex];
  to.x = p.x;
  to.y = p.y;
  to.z = p.z;
  to.w = p.w;
  to.closed = false;
  const std::size_t count = state_.attributes.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double r = mesh_.attributes[vertex * count + i];
    const bool is_affine_in_window =
        state_.attributes[i].interpolation == Interpolation::noperspective;
    to.parameters[i] = is_affine_in_window ? r * to.w : r;
  }
  for (std::size_t i = 0; i < state_.clip_distance_count; ++i) {
    to.distances[i] = mesh_.clip_distances[vertex * state_.clip_distance_count + i];
  }
}

void Drawing::divide(int orientation) {
  window_.size = clipped_.size;
  window_.parameter_count = kFirstAttribute + state_.attributes.size();
  window_.positive = orientation > 0;
  for (std::size_t i = 0; i < clipped_.size; ++i) {
    window_map_.divide(clipped_.vertices[i], state_.attributes.size(), window_.vertices[i]);
  }
}

void Drawing::scan() {
  const ConvexScan scan(window_, least_v_included_);
  const double first = std::floor(scan.least_v());
  const PixelRange rows = pixels_from_through(bounds_.rows, 0, first, scan.greatest_v());
  for (int y = rows.begin; y < rows.end; ++y) scan_row(scan, y);
}

void Drawing::scan_row(const ConvexScan& scan, int y) {
  PixelRange columns{std::numeric_limits<int>::max(), 0};
  for (std::size_t i = 0; i < pattern_.size(); ++i) {
    const bool in_viewport = bounds_.sample_rows[i].contains(y);
    set_row(scan, y + pattern_[i].y, pattern_[i].x,
            in_viewport ? bounds_.sample_columns[i] : PixelRange{}, rows_[i]);
    if (rows_[i].columns.empty()) continue;
    columns.begin = std::min(columns.begin, rows_[i].columns.begin);
    columns.end = std::max(columns.end, rows_[i].columns.end);
  }
  if (columns.empty()) return;
  if (has_location_[static_cast<std::size_t>(Location::center)] ||
      has_location_[static_cast<std::size_t>(Location::centroid)]) {
    set_row(scan, y + kPixelCenter.y, kPixelCenter.x, bounds_.columns, center_row_);
  }
  for (int x = columns.begin; x < columns.end; ++x) draw_pixel(scan, x, y);
}

/// The samples at `v` and `offset` from the left of their pixels, those of `columns`.
void Drawing::set_row(const ConvexScan& scan, double v, double offset, const PixelRange& columns,
                      SampleRow& row) const {
  row.columns = {};
  if (columns.empty()) return;
  const ScanSpan span = scan.span(v);
  if (span.left == nullptr || span.right == nullptr) return;
  row.columns = span.right->closed ? pixels_from_through(columns, offset, span.left_u, span.right_u)
                                   : pixels_from_to(columns, offset, span.left_u, span.right_u);
  if (!row.columns.empty()) scan.set_ends(span, row.ends);
}

void Drawing::draw_pixel(const ConvexScan& scan, int x, int y) {
  std::array<std::size_t, kMaxSamples> covered{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < pattern_.size(); ++i) {
    if (rows_[i].columns.contains(x)) covered[count++] = i;
  }
  if (count == 0) return;

  Values values = flat_;
  ScanParameters s;
  if (has_location_[static_cast<std::size_t>(Location::center)]) {
    center_parameters(scan, x, y, s);
    evaluate(Location::center, s, values);
  }
  if (has_location_[static_cast<std::size_t>(Location::centroid)]) {
    if (count == pattern_.size()) {
      center_parameters(scan, x, y, s);
    } else {
      scan.interpolate(rows_[covered[0]].ends, x + pattern_[covered[0]].x, s);
    }
    evaluate(Location::centroid, s, values);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t sample = covered[i];
    scan.interpolate(rows_[sample].ends, x + pattern_[sample].x, s);
    if (has_location_[static_cast<std::size_t>(Location::sample)]) {
      evaluate(Location::sample, s, values);
    }
    append(x, y, sample, s, values);
  }
}

void Drawing::center_parameters(const ConvexScan& scan, int x, int y, ScanParameters& s) const {
  if (center_row_.columns.contains(x)) {
    scan.interpolate(center_row_.ends, x + kPixelCenter.x, s);
  } else {
    extrapolate(x + kPixelCenter.x, y + kPixelCenter.y, s);
  }
}

/// The parameters at a point of the window by the triangle's plane; depth is left out.
void Drawing::extrapolate(double u, double v, ScanParameters& s) const {
  const auto& [a, b, c] = corners_;
  const Numerators at_a = window_map_.numerators(a, u, v);
  const Numerators at_b = window_map_.numerators(b, u, v);
  const Numerators at_c = window_map_.numerators(c, u, v);
  const double e_a = cross(at_b, at_c);
  const double e_b = cross(at_c, at_a);
  const double e_c = cross(at_a, at_b);
  const double determinant = a.w * e_a + b.w * e_b + c.w * e_c;
  s[kReciprocalW] = (e_a + e_b + e_c) / determinant;
  for (std::size_t i = 0; i < state_.attributes.size(); ++i) {
    s[kFirstAttribute + i] =
        (a.parameters[i] * e_a + b.parameters[i] * e_b + c.parameters[i] * e_c) / determinant;
  }
}

/// Writes the attributes that are evaluated at this location, from the parameters there.
void Drawing::evaluate(Location location, const ScanParameters& s, Values& values) const {
  for (std::size_t i = 0; i < state_.attributes.size(); ++i) {
    const Qualifier& qualifier = state_.attributes[i];
    const bool is_copied = qualifier.interpolation == Interpolation::flat || is_zero_[i];
    if (is_copied || qualifier.location != location) continue;
    const double numerator = s[kFirstAttribute + i];
    const bool is_smooth = qualifier.interpolation == Interpolation::smooth;
    values[i] = rounded(is_smooth ? numerator / s[kReciprocalW] : numerator);
  }
}

void Drawing::append(int x, int y, std::size_t sample, const ScanParameters& s,
                     const Values& values) {
  fragments_.triangle.push_back(triangle_);
  fragments_.x.push_back(static_cast<std::uint16_t>(x));
  fragments_.y.push_back(static_cast<std::uint16_t>(y));
  fragments_.sample.push_back(static_cast<std::uint8_t>(sample));
  fragments_.depth.push_back(depth_map_(s[kDepth]));
  fragments_.attributes.insert(
      fragments_.attributes.end(), values.begin(),
      values.begin() + static_cast<std::ptrdiff_t>(state_.attributes.size()));
}

DrawCounts draw(const State& state, const Mesh& mesh, const TargetSize& size,
                Fragments& fragments) {
  return Drawing(state, mesh, size, fragments).draw();
}

/// The derivation above with u = 2^-53: 23 u max|r_i| g is less than 2^-24 g scale ULP, as ulp(m)
/// >= 2^-24 m. Depth and noperspective values divide nothing.
Promise promise(const State& /*state*/, const Mesh& /*mesh*/, const TargetSize& /*size*/) {
  Promise promise;
  promise.scan = ScanKind::scanned;
  promise.smooth = {.constant = 0.5 + 0x1p-24, .per_horizon = 0x1p-24};
  promise.noperspective = {.constant = 0.5 + 0x1p-24};
  return promise;
}

const MethodRegistration kRegistration({.name = "rational-linear",
                                        .source = "seed 002 §3.5 (Heckbert and Moreton, 1991)",
                                        .draw = &draw,
                                        .promise = &promise});

}  // namespace
}  // namespace rastercheck::rasterizer
