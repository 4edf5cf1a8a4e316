#include "rasterizer/methods/internal/polygon_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numeric>
#include <optional>

#include "rasterizer/internal/determinant.h"
#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/standard_pattern.h"
#include "rasterizer/methods/internal/clip_polygon.h"
#include "rasterizer/methods/internal/method_tap.h"
#include "rasterizer/methods/internal/window_map.h"
#include "rasterizer/methods/polygon.h"

namespace rastercheck::rasterizer {
namespace {

// Indices of a vertex's parameters that are linear in window space: z/w, then one for each
// noperspective attribute.
constexpr std::size_t kDepth = 0;
constexpr std::size_t kFirstNoperspective = 1;

using Values = std::array<float, kMaxAttributes>;

/// Rounds to the nearest float32; infinite if out of range.
float rounded(double value) {
  static_assert(std::numeric_limits<float>::is_iec559);
  return static_cast<float>(value);
}

int sign(float value) { return (value > 0) - (value < 0); }

/// The orientation, 1 or −1, of window positions whose clip positions turn from x to y.
int viewport_sign(const State& state) {
  const int turned = state.convention == Convention::d3d ? -1 : 1;
  return turned * sign(state.viewport.size.x) * sign(state.viewport.size.y);
}

/// True if samples on horizontal edges of least v are inside: the window displays these edges on
/// the side, top or bottom, that the fill rule includes.
bool least_v_included(const State& state) {
  const bool v_points_down = state.convention != Convention::opengl;
  return (state.fill_rule == FillRule::top_left) == v_points_down;
}

/// Maps z/w to window depth.
class DepthMap {
 public:
  explicit DepthMap(const State& state)
      : near_(state.viewport.min_depth),
        far_(state.viewport.max_depth),
        from_minus_one_(state.convention == Convention::opengl) {}

  /// The depth before rounding to float32.
  double operator()(double z) const {
    const double fraction = from_minus_one_ ? (z + 1) / 2 : z;
    const double depth = near_ + (far_ - near_) * fraction;
    return std::clamp(depth, std::min(near_, far_), std::max(near_, far_));
  }

 private:
  double near_;
  double far_;
  bool from_minus_one_;
};

/// X_a Y_b − X_b Y_a.
double cross(const Numerators& a, const Numerators& b) { return a.x * b.y - b.x * a.y; }

/// Step 4, the division by w, for positions.
void divide(const WindowMap& map, const ClipVertex& from, WindowVertex& to) {
  const Numerators at = map(from.x, from.y, from.w);
  to.u = at.x / from.w;
  to.v = at.y / from.w;
  to.s[kDepth] = from.z / from.w;
  to.closed = from.closed;
}

/// Returns the union of the columns of all samples.
PixelRange columns_of(const DrawBounds& bounds, std::size_t samples) {
  PixelRange columns = bounds.sample_columns[0];
  for (std::size_t i = 1; i < samples; ++i) {
    columns.begin = std::min(columns.begin, bounds.sample_columns[i].begin);
    columns.end = std::max(columns.end, bounds.sample_columns[i].end);
  }
  return columns;
}

/// How an attribute is computed.
struct Source {
  Interpolation interpolation = Interpolation::flat;
  Location location = Location::sample;
  std::size_t index = 0;  ///< among the smooth or the noperspective attributes
};

/// The values at a place, before rounding.
struct PlaceValues {
  double u = 0;
  double v = 0;
  bool is_from_plane = false;  ///< from the triangle's plane, not from a span
  double depth = 0;
  std::array<double, kMaxAttributes> attributes{};
};

/// One draw: data shared by its polygons, and working memory.
class Drawing {
 public:
  Drawing(const State& state, const Mesh& mesh, const TargetSize& size,
          ScanFormula<double>& formula, Claim claims, Fragments& fragments, MethodTap* tap)
      : state_(state),
        mesh_(mesh),
        formula_(formula),
        claims_(claims),
        fragments_(fragments),
        tap_(tap),
        pattern_(standard_pattern(size.samples)),
        bounds_(draw_bounds(state, size)),
        window_bounds_(draw_bounds_of_window(state, size)),
        window_map_(state),
        depth_map_(state),
        has_location_{has(Location::sample), has(Location::center), has(Location::centroid)},
        viewport_sign_(viewport_sign(state)),
        least_v_included_(least_v_included(state)) {
    for (std::size_t i = 0; i < state.attributes.size(); ++i) {
      const Qualifier& qualifier = state.attributes[i];
      const bool is_smooth = qualifier.interpolation == Interpolation::smooth;
      const bool is_noperspective = qualifier.interpolation == Interpolation::noperspective;
      sources_[i] = {qualifier.interpolation, qualifier.location,
                     is_smooth ? smooth_count_ : noperspective_count_};
      smooth_count_ += is_smooth ? 1 : 0;
      noperspective_count_ += is_noperspective ? 1 : 0;
    }
    volume_ = {state.convention, state.depth_clamp, smooth_count_ + noperspective_count_,
               state.clip_distance_count};
  }

  DrawCounts draw_triangles() {
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) draw_triangle(i);
    return counts_;
  }

  DrawCounts draw_polygon() {
    std::array<std::uint32_t, kMaxPolygonCorners> corners{};
    std::iota(corners.begin(), corners.end(), 0U);
    draw_corners(std::span(corners).first(mesh_.positions.size()), polygon_orientation());
    return counts_;
  }

 private:
  static constexpr std::size_t kMaxSamples = DrawBounds::kMaxSamples;

  /// The place of a row of samples: at `v`, and `offset` from the left sides of their pixels.
  struct RowPlace {
    double v = 0;
    double offset = 0;
    PixelRange columns;  ///< columns that may be drawn
    PixelRange window;   ///< columns that might be drawn without a scissor
  };

  /// One row of samples: all samples with the same index in one row of pixels.
  struct SampleRow {
    double v = 0;
    PixelRange columns;         ///< covered
    SpanEnds<double> ends;      ///< defined if `columns` is not empty
    SpanEnds<double> smooth{};  ///< the ends with the formula's parameters
  };

  bool has(Location location) const;
  int polygon_orientation() const;
  void draw_triangle(std::size_t index);
  void draw_corners(std::span<const std::uint32_t> corners, int orientation);
  void load(std::span<const std::uint32_t> corners);
  void load_vertex(std::uint32_t vertex, ClipVertex& to) const;
  void divide(int orientation);
  void scan();
  void scan_row(const ConvexScan& scan, int y);
  void set_row(const ConvexScan& scan, const RowPlace& place, SampleRow& row) const;
  void set_smooth_ends(const ScanSpan& span, double first, SampleRow& row) const;
  void draw_pixel(const ConvexScan& scan, int x, int y);
  void interpolate(const ConvexScan& scan, SampleRow& row, double u, PlaceValues& at) const;
  bool is_traced() const { return tap_ != nullptr && tap_->address().triangle == triangle_; }
  void show_vertices() const;
  void show_attribute(std::size_t attribute, const PlaceValues& at, float value) const;
  void center_values(const ConvexScan& scan, int x, int y, PlaceValues& at);
  void extrapolate(double u, double v, PlaceValues& at) const;
  void round(Location location, const PlaceValues& at, Values& values) const;
  void append(int x, int y, std::size_t sample, const PlaceValues& at, const Values& values);
  void show_fragment(const PlaceValues& at, double depth) const;

  const State& state_;
  const Mesh& mesh_;
  ScanFormula<double>& formula_;
  Claim claims_;
  Fragments& fragments_;
  MethodTap* tap_;  ///< or nullptr
  std::span<const SampleOffset> pattern_;
  DrawBounds bounds_;
  DrawBounds window_bounds_;  ///< without a scissor
  ClipVolume volume_;
  WindowMap window_map_;
  DepthMap depth_map_;
  std::array<Source, kMaxAttributes> sources_;  ///< [attribute]
  std::size_t smooth_count_ = 0;
  std::size_t noperspective_count_ = 0;
  std::array<bool, 3> has_location_;  ///< [location]: true if an attribute is evaluated there
  int viewport_sign_;
  bool least_v_included_;
  DrawCounts counts_;

  // The current polygon.
  std::uint32_t triangle_ = 0;
  /// Its vertices' parameters are the smooth attributes, then the noperspective attributes times w.
  ClipPolygon clipped_;
  std::array<ClipVertex, 3> corners_;  ///< before clipping
  ClipPolygon spare_;
  WindowPolygon window_;
  Values flat_{};  ///< [attribute]: the provoking vertex's value
  /// [attribute]: true if all values are the same zero, which is copied because sums and products
  /// may change its sign.
  std::array<bool, kMaxAttributes> is_zero_{};
  // The current row of pixels.
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
  const glm::uvec3& corners = mesh_.triangles[index];
  triangle_ = triangle->index;
  draw_corners(std::array{corners.x, corners.y, corners.z},
               viewport_sign_ * determinant_sign(p[0], p[1], p[2]));
}

/// Returns the orientation of a convex polygon: that of any of its triangles with area, because all
/// turn the same way.
int Drawing::polygon_orientation() const {
  const std::span<const glm::vec4> p = mesh_.positions;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      for (std::size_t k = j + 1; k < p.size(); ++k) {
        const int turn = determinant_sign(p[i], p[j], p[k]);
        if (turn != 0) return viewport_sign_ * turn;
      }
    }
  }
  return 0;
}

void Drawing::draw_corners(std::span<const std::uint32_t> corners, int orientation) {
  if (orientation == 0) return count(Fate::degenerate, counts_);
  if (is_culled(state_, orientation)) return;

  load(corners);                                 // steps 1 and 2
  if (!clip(volume_, clipped_, spare_)) return;  // step 3
  divide(orientation);                           // step 4
  if (is_traced()) show_vertices();
  scan();  // step 5
}

void Drawing::load(std::span<const std::uint32_t> corners) {
  clipped_.size = corners.size();
  for (std::size_t i = 0; i < corners.size(); ++i) load_vertex(corners[i], clipped_.vertices[i]);
  std::copy_n(clipped_.vertices.begin(), corners_.size(), corners_.begin());
  const std::uint32_t provoking =
      state_.convention == Convention::opengl ? corners.back() : corners.front();
  const std::size_t count = state_.attributes.size();
  std::copy_n(mesh_.attributes.begin() + static_cast<std::ptrdiff_t>(provoking * count), count,
              flat_.begin());
  for (std::size_t i = 0; i < count; ++i) {
    is_zero_[i] = std::all_of(corners.begin(), corners.end(), [&](std::uint32_t vertex) {
      const float value = mesh_.attributes[vertex * count + i];
      return value == 0 && std::signbit(value) == std::signbit(flat_[i]);
    });
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
    const Source& source = sources_[i];
    if (source.interpolation == Interpolation::smooth) to.parameters[source.index] = r;
    if (source.interpolation == Interpolation::noperspective) {
      to.parameters[smooth_count_ + source.index] = r * to.w;
    }
  }
  for (std::size_t i = 0; i < state_.clip_distance_count; ++i) {
    to.distances[i] = mesh_.clip_distances[vertex * state_.clip_distance_count + i];
  }
}

void Drawing::divide(int orientation) {
  window_.size = clipped_.size;
  window_.parameter_count = kFirstNoperspective + noperspective_count_;
  window_.positive = orientation > 0;
  std::array<ScanVertex<double>, ClipPolygon::kCapacity> vertices;
  for (std::size_t i = 0; i < clipped_.size; ++i) {
    const ClipVertex& from = clipped_.vertices[i];
    vertices[i] = {from.w, std::span(from.parameters).first(smooth_count_)};
  }
  formula_.set_polygon(std::span(vertices).first(clipped_.size), smooth_count_);
  for (std::size_t i = 0; i < clipped_.size; ++i) {
    const ClipVertex& from = clipped_.vertices[i];
    WindowVertex& to = window_.vertices[i];
    rasterizer::divide(window_map_, from, to);
    for (std::size_t k = 0; k < noperspective_count_; ++k) {
      to.s[kFirstNoperspective + k] = from.parameters[smooth_count_ + k] / from.w;
    }
    formula_.set_vertex(vertices[i], to.smooth);
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
    set_row(
        scan,
        {y + pattern_[i].y, pattern_[i].x, in_viewport ? bounds_.sample_columns[i] : PixelRange{},
         window_bounds_.sample_columns[i]},
        rows_[i]);
    if (rows_[i].columns.empty()) continue;
    columns.begin = std::min(columns.begin, rows_[i].columns.begin);
    columns.end = std::max(columns.end, rows_[i].columns.end);
  }
  if (columns.empty()) return;
  if (has_location_[static_cast<std::size_t>(Location::center)] ||
      has_location_[static_cast<std::size_t>(Location::centroid)]) {
    set_row(scan,
            {y + kPixelCenter.y, kPixelCenter.x, columns_of(bounds_, pattern_.size()),
             columns_of(window_bounds_, pattern_.size())},
            center_row_);
  }
  for (int x = columns.begin; x < columns.end; ++x) draw_pixel(scan, x, y);
}

void Drawing::set_row(const ConvexScan& scan, const RowPlace& place, SampleRow& row) const {
  row.v = place.v;
  row.columns = {};
  if (place.columns.empty()) return;
  const ScanSpan span = scan.span(place.v);
  if (span.left == nullptr || span.right == nullptr) return;
  const auto covered = span.right->closed ? pixels_from_through : pixels_from_to;
  row.columns = covered(place.columns, place.offset, span.left_u, span.right_u);
  if (row.columns.empty()) return;
  scan.set_ends(span, row.ends);
  // A formula's steps along a span must not depend on where the scissor begins.
  const PixelRange whole = covered(place.window, place.offset, span.left_u, span.right_u);
  set_smooth_ends(span, whole.begin + place.offset, row);
}

void Drawing::set_smooth_ends(const ScanSpan& span, double first, SampleRow& row) const {
  const auto along = [&](const ScanSpan::Edge& edge, Parameters<double>& s) {
    formula_.along_edge({span.v, edge.low->v, edge.high->v}, edge.low->smooth, edge.high->smooth,
                        s);
  };
  row.smooth.left_u = span.left_u;
  row.smooth.right_u = span.right_u;
  along(*span.left, row.smooth.left);
  along(*span.right, row.smooth.right);
  formula_.set_span(row.smooth, first);
}

void Drawing::draw_pixel(const ConvexScan& scan, int x, int y) {
  std::array<std::size_t, kMaxSamples> covered{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < pattern_.size(); ++i) {
    if (rows_[i].columns.contains(x)) covered[count++] = i;
  }
  if (count == 0) return;

  Values values = flat_;
  PlaceValues at;
  if (has_location_[static_cast<std::size_t>(Location::center)]) {
    center_values(scan, x, y, at);
    round(Location::center, at, values);
  }
  if (has_location_[static_cast<std::size_t>(Location::centroid)]) {
    if (count == pattern_.size()) {
      center_values(scan, x, y, at);
    } else {
      interpolate(scan, rows_[covered[0]], x + pattern_[covered[0]].x, at);
    }
    round(Location::centroid, at, values);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t sample = covered[i];
    interpolate(scan, rows_[sample], x + pattern_[sample].x, at);
    if (has_location_[static_cast<std::size_t>(Location::sample)]) {
      round(Location::sample, at, values);
    }
    append(x, y, sample, at, values);
  }
}

/// Computes the values at u on the span of a row.
void Drawing::interpolate(const ConvexScan& scan, SampleRow& row, double u, PlaceValues& at) const {
  at.u = u;
  at.v = row.v;
  at.is_from_plane = false;
  Parameters<double> linear;
  scan.interpolate(row.ends, u, linear);
  at.depth = linear[kDepth];
  Parameters<double> s;
  std::array<double, kMaxAttributes> smooth;
  formula_.along_span(row.smooth, u, s);
  formula_.values(s, std::span(smooth).first(smooth_count_));
  for (std::size_t i = 0; i < state_.attributes.size(); ++i) {
    const Source& source = sources_[i];
    if (source.interpolation == Interpolation::flat) continue;
    at.attributes[i] = source.interpolation == Interpolation::smooth
                           ? smooth[source.index]
                           : linear[kFirstNoperspective + source.index];
  }
}

void Drawing::center_values(const ConvexScan& scan, int x, int y, PlaceValues& at) {
  if (center_row_.columns.contains(x)) {
    interpolate(scan, center_row_, x + kPixelCenter.x, at);
  } else {
    extrapolate(x + kPixelCenter.x, y + kPixelCenter.y, at);
  }
}

/// Computes the attributes at a point of the window from the triangle's plane.
void Drawing::extrapolate(double u, double v, PlaceValues& at) const {
  at.u = u;
  at.v = v;
  at.is_from_plane = true;
  const auto& [a, b, c] = corners_;
  const Numerators at_a = window_map_(a.x, a.y, a.w, u, v);
  const Numerators at_b = window_map_(b.x, b.y, b.w, u, v);
  const Numerators at_c = window_map_(c.x, c.y, c.w, u, v);
  const double e_a = cross(at_b, at_c);
  const double e_b = cross(at_c, at_a);
  const double e_c = cross(at_a, at_b);
  const double determinant = a.w * e_a + b.w * e_b + c.w * e_c;
  const double reciprocal_w = (e_a + e_b + e_c) / determinant;
  for (std::size_t i = 0; i < state_.attributes.size(); ++i) {
    const Source& source = sources_[i];
    if (source.interpolation == Interpolation::flat) continue;
    const bool is_smooth = source.interpolation == Interpolation::smooth;
    const std::size_t k = is_smooth ? source.index : smooth_count_ + source.index;
    const bool is_affine = is_smooth && claims_ == Claim::affine;
    const auto part = [&](const ClipVertex& corner) {
      return is_affine ? corner.parameters[k] * corner.w : corner.parameters[k];
    };
    const double s = (part(a) * e_a + part(b) * e_b + part(c) * e_c) / determinant;
    at.attributes[i] = is_smooth && !is_affine ? s / reciprocal_w : s;
  }
}

/// Writes the attributes that are evaluated at this location.
void Drawing::round(Location location, const PlaceValues& at, Values& values) const {
  for (std::size_t i = 0; i < state_.attributes.size(); ++i) {
    const bool is_copied = sources_[i].interpolation == Interpolation::flat || is_zero_[i];
    if (is_copied || sources_[i].location != location) continue;
    values[i] = rounded(at.attributes[i]);
    if (is_traced()) show_attribute(i, at, values[i]);
  }
}

void Drawing::append(int x, int y, std::size_t sample, const PlaceValues& at,
                     const Values& values) {
  const double depth = depth_map_(at.depth);
  fragments_.triangle.push_back(triangle_);
  fragments_.x.push_back(static_cast<std::uint16_t>(x));
  fragments_.y.push_back(static_cast<std::uint16_t>(y));
  fragments_.sample.push_back(static_cast<std::uint8_t>(sample));
  fragments_.depth.push_back(rounded(depth));
  fragments_.attributes.insert(
      fragments_.attributes.end(), values.begin(),
      values.begin() + static_cast<std::ptrdiff_t>(state_.attributes.size()));
  if (tap_ != nullptr && tap_->is_at(triangle_, x, y, sample)) show_fragment(at, depth);
}

/// Records in the trace the data that the triangle's samples share. Window positions are recorded
/// only if the triangle is not clipped, because a corner made by clipping does not store which
/// vertices it came from.
void Drawing::show_vertices() const {
  Trace& trace = tap_->trace.emplace();
  const SamplePlace& address = tap_->address();
  const SampleOffset& offset = pattern_[static_cast<std::size_t>(address.sample)];
  trace.u = address.x + offset.x;
  trace.v = address.y + offset.y;
  trace.decision = Decision::by_span;
  tap_->attributes.assign(state_.attributes.size(), {});
  for (std::size_t i = 0; i < state_.attributes.size(); ++i) {
    tap_->attributes[i] = {.u = trace.u, .v = trace.v, .evaluated = flat_[i], .value = flat_[i]};
  }
  bool is_whole = clipped_.size == corners_.size();
  std::array<TracedCorner, 3> window;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const ClipVertex& p = corners_[i];
    const ClipVertex& q = clipped_.vertices[i];
    trace.positions[i] = {p.x, p.y, p.z, p.w};
    is_whole = is_whole && p.x == q.x && p.y == q.y && p.z == q.z && p.w == q.w;
    window[i] = {window_.vertices[i].u, window_.vertices[i].v, p.z, p.w, false, {}};
    window[i].share[i] = 1;
  }
  if (is_whole) trace.corners = window;
}

void Drawing::show_attribute(std::size_t attribute, const PlaceValues& at, float value) const {
  tap_->attributes[attribute] = {.u = at.u,
                                 .v = at.v,
                                 .is_from_vertices = at.is_from_plane,
                                 .evaluated = at.attributes[attribute],
                                 .value = value};
}

void Drawing::show_fragment(const PlaceValues& at, double depth) const {
  Trace& trace = *tap_->trace;
  trace.is_drawn = true;
  trace.depth = {.u = at.u, .v = at.v, .evaluated = depth, .value = rounded(depth)};
  trace.attributes = tap_->attributes;
}

/// True if clipping changes the triangle and leaves something to draw.
bool is_clipped(const ClipVolume& volume, const InputTriangle& triangle) {
  const auto& positions = triangle.positions;
  if (determinant_sign(positions[0], positions[1], positions[2]) == 0) return false;
  ClipPolygon polygon;
  polygon.size = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    ClipVertex& corner = polygon.vertices[i];
    const glm::vec4& p = positions[i];
    corner.x = p.x;
    corner.y = p.y;
    corner.z = p.z;
    corner.w = p.w;
    std::copy(triangle.distances[i].begin(), triangle.distances[i].end(), corner.distances.begin());
  }
  ClipPolygon spare;
  if (!clip(volume, polygon, spare)) return false;
  if (polygon.size != 3) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    const ClipVertex& left = polygon.vertices[i];
    const glm::vec4& p = positions[i];
    if (left.x != p.x || left.y != p.y || left.z != p.z || left.w != p.w) return true;
  }
  return false;
}

}  // namespace

DrawCounts scan_triangles(const State& state, const Mesh& mesh, const TargetSize& size,
                          ScanFormula<double>& formula, Claim claims, Fragments& fragments,
                          MethodTap* tap) {
  return Drawing(state, mesh, size, formula, claims, fragments, tap).draw_triangles();
}

DrawCounts scan_polygon(const State& state, const Mesh& mesh, const TargetSize& size,
                        ScanFormula<double>& formula, Fragments& fragments) {
  return Drawing(state, mesh, size, formula, Claim::perspective, fragments, nullptr).draw_polygon();
}

bool is_any_clipped(const State& state, const Mesh& mesh) {
  const ClipVolume volume{state.convention, state.depth_clamp, 0, state.clip_distance_count};
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::optional<InputTriangle> triangle = input_triangle(state, mesh, i);
    if (triangle && is_clipped(volume, *triangle)) return true;
  }
  return false;
}

}  // namespace rastercheck::rasterizer
