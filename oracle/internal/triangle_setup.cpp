#include "oracle/internal/triangle_setup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "oracle/internal/conservative.h"

namespace rastercheck::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::array<RingVector3, 3> window_columns(const Scene& scene, const cases::Triangle& indices) {
  return {scene.window_column(indices[0]), scene.window_column(indices[1]),
          scene.window_column(indices[2])};
}

}  // namespace

TriangleSetup::TriangleSetup(const Scene& owner, std::size_t triangle)
    : scene(&owner),
      index(triangle),
      promise(cases::promise_of(owner.contract(), owner.source(), triangle)),
      indices(owner.source().triangles[triangle]),
      columns(window_columns(owner, indices)),
      ideal(map_of(columns)) {
  for (const RingVector3& column : columns) {
    has_nonpositive_w = has_nonpositive_w || sign_of(column[2]) <= 0;
  }
  if (!promise.is_made) return;
  set_up_clipping();
  if (scene->contract().culls_instead_of_clipping) set_up_leaving_out();
  if (!promise.is_made || is_left_out) return;
  if (scene->contract().coverage) {
    cases::Snapping snapping = *scene->contract().coverage;
    snapping.position_error = promise.position_error;
    if (is_triangle()) {
      set_up_snapping(snapping);
    } else {
      set_up_snapped_primitive(snapping);
    }
  }
  const float least_area = scene->contract().least_area;
  may_be_left_out = is_triangle() && least_area > 0 && has_less_area_than(double{least_area});
}

namespace {

/// The sign of a number, or 0 if its magnitude is at most `slack`: the sign of all numbers that are
/// at most `slack` away.
int certain_sign(const Ring& value, const Ring& slack) {
  return magnitude(value) <= slack ? 0 : sign_of(value);
}

}  // namespace

/// Finds out whether a vertex lies beyond the guard volume: behind the eye, beyond a depth plane or
/// beyond the guard band. Nothing is promised if an error that the contract allows decides.
void TriangleSetup::set_up_leaving_out() {
  const cases::Coverage& coverage = scene->contract().coverage;
  const Ring unit(scene->grid_unit());
  const Ring moved =
      coverage ? (Ring(promise.clip_tolerance) + exact_ring(promise.position_error)) * unit
               : Ring(0);
  bool is_open = false;
  const auto ask = [&](const Ring& inside, const Ring& slack) {
    // A vertex exactly on a side is inside.
    if (sign_of(inside) == 0 && sign_of(slack) == 0) return;
    const int sign = certain_sign(inside, slack);
    is_left_out = is_left_out || sign < 0;
    is_open = is_open || sign == 0;
  };
  const Ring share(coverage ? promise.clip_error : 0.0);
  for_each_clip_plane([&](const std::array<Ring, 3>& values, bool, bool is_user_distance) {
    if (is_user_distance) return;
    const Ring slack = sign_of(share) == 0 ? share : share * clip_size(values, false);
    for (const Ring& value : values) ask(value, slack);
  });
  for (const RingVector3& column : columns) {
    const Ring& w = column[2];
    is_left_out = is_left_out || sign_of(w) <= 0;
    if (is_left_out) return;
    const Ring slack = moved * w;
    ask(column[0] - scene->guard_band_lo().u * w, slack);
    ask(scene->guard_band_hi().u * w - column[0], slack);
    ask(column[1] - scene->guard_band_lo().v * w, slack);
    ask(scene->guard_band_hi().v * w - column[1], slack);
  }
  if (is_open && !is_left_out) promise.is_made = false;
}

/// True if what the contract draws of the triangle may have less area than this, in square pixels.
/// Moving every vertex by at most r along both axes changes twice the area by at most
/// r Σ (|Δu| + |Δv|) over the three sides, plus 8 r² for moves that meet in one product.
bool TriangleSetup::has_less_area_than(double area) const {
  const bool may_be_cut = has_nonpositive_w || has_clipped_vertex || !is_whole;
  if (may_be_cut) return true;
  const auto& [w, u, v] = near_positions();
  const double moved = reach.to_interval().second;
  double lengths = 0;
  double sizes = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    lengths += std::abs(u[(i + 1) % 3] - u[i]) + std::abs(v[(i + 1) % 3] - v[i]);
    sizes += std::abs(u[i]) + std::abs(v[i]);
  }
  const double twice = std::abs((u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]));
  // Positions are off by 2^-48 relative, and roundings add less than as much again.
  const double change = moved * (lengths + 8 * moved) + lengths * sizes * 0x1p-46;
  const double units = near_double(scene->units_per_pixel());
  // Written so that NaN counts as less.
  return !(twice - change >= 2 * area * units * units * (1 + 0x1p-48));
}

template <typename Take>
void TriangleSetup::for_each_clip_plane(const Take& take) const {
  const cases::Case& source = scene->source();
  if (!source.depth_clamp) {
    std::array<Ring, 3> near;
    std::array<Ring, 3> far;
    for (std::size_t i = 0; i < 3; ++i) {
      const RingVector4 p = scene->clip_position(indices[i]);
      near[i] = scene->conventions().near_z == 0 ? p[2] : p[2] + p[3];
      far[i] = p[3] - p[2];
    }
    take(near, false, false);
    take(far, false, false);
  }
  for (std::size_t d = 0; d < source.clip_distance_count; ++d) {
    std::array<Ring, 3> distances;
    for (std::size_t i = 0; i < 3; ++i) {
      distances[i] = exact_ring(source.clip_distances_of(indices[i])[d]);
    }
    take(distances, !scene->conventions().clip_distance_zero_inside, true);
  }
}

void TriangleSetup::set_up_clipping() {
  const cases::Case& source = scene->source();
  if (!source.camera && source.clip_distance_count == 0 && is_triangle()) {
    // Comparisons are exact. The floats are first converted to double, so this holds even if the
    // processor flushes subnormal floats.
    for (std::size_t i = 0; i < 3 && !source.depth_clamp; ++i) {
      const cases::ClipVertex& p = source.positions[indices[i]];
      const double z = exact_double(p.z);
      const double w = exact_double(p.w);
      const double near = scene->conventions().near_z == 0 ? 0.0 : -w;
      is_clipped[i] = z < near || z > w;
    }
  } else {
    for_each_clip_plane([this](const std::array<Ring, 3>& values, bool, bool is_user_distance) {
      for (std::size_t i = 0; i < 3; ++i) {
        const int sign = sign_of(values[i]);
        is_clipped[i] = is_clipped[i] || sign < 0;
        is_cut_by_planes = is_cut_by_planes || (sign == 0 && is_user_distance);
      }
    });
  }
  has_clipped_vertex = is_clipped[0] || is_clipped[1] || is_clipped[2];
  is_cut_by_planes = is_cut_by_planes || has_clipped_vertex;
}

/// The greatest magnitude of a user clip distance at a vertex; for a depth plane, max|z| + max|w|.
Ring TriangleSetup::clip_size(const std::array<Ring, 3>& distances, bool is_user_distance) const {
  std::array<Ring, 2> most{Ring(0), Ring(0)};
  for (std::size_t i = 0; i < 3; ++i) {
    if (is_user_distance) {
      most[0] = std::max(most[0], magnitude(distances[i]));
    } else {
      const RingVector4 p = scene->clip_position(indices[i]);
      most[0] = std::max(most[0], magnitude(p[2]));
      most[1] = std::max(most[1], magnitude(p[3]));
    }
  }
  return most[0] + most[1];
}

/// The functional with `more` added to the distances at all vertices: Σ E_i (s_i + more).
Line TriangleSetup::widened(const Line& line, const Ring& more) const {
  if (sign_of(more) == 0) return line;
  const Line& all = ideal.inverse_w();
  return {line.a + more * all.a, line.b + more * all.b, line.c + more * all.c};
}

const std::vector<ClipFunctional>& TriangleSetup::clip_functionals() const {
  if (clip_functionals_) return *clip_functionals_;
  clip_functionals_.emplace();
  const Ring share(scene->contract().coverage ? promise.clip_error : 0.0);
  for_each_clip_plane([&](const std::array<Ring, 3>& values, bool zero_is_tie, bool is_user) {
    const bool violated =
        std::any_of(values.begin(), values.end(), [](const Ring& v) { return sign_of(v) < 0; });
    const Line line = ideal.combine(values);
    const Ring error = sign_of(share) == 0 ? share : share * clip_size(values, is_user);
    clip_functionals_->push_back(
        {line, widened(line, error), widened(line, -error), zero_is_tie, is_user, violated});
  });
  return *clip_functionals_;
}

std::vector<std::array<Ring, 3>> TriangleSetup::clip_values() const {
  std::vector<std::array<Ring, 3>> all;
  for_each_clip_plane(
      [&all](const std::array<Ring, 3>& values, bool, bool) { all.push_back(values); });
  return all;
}

/// True if the clipped polygon has a point such that the square of half-width `distance` around it
/// lies inside every side. If corners move by no more than `distance`, the point stays inside, and
/// they keep their orientation around it.
bool TriangleSetup::has_points_deeper_than(const Ring& distance) const {
  ConvexRegion core = guard_band_of(*scene);
  const auto clip_inwards = [&](const Line& line) {
    core.clip_above(line, band_of(line, distance));
  };
  for (std::size_t i = 0; i < 3; ++i) clip_inwards(ideal.edge(i));
  for (const ClipFunctional& functional : clip_functionals()) {
    if (!functional.inner.is_constant()) clip_inwards(functional.inner);
  }
  return !core.is_empty();
}

bool TriangleSetup::is_beyond_guard_band(std::size_t vertex) const {
  const RingVector3& column = columns[vertex];
  const Point& lo = scene->guard_band_lo();
  const Point& hi = scene->guard_band_hi();
  return column[0] < lo.u * column[2] || column[0] > hi.u * column[2] ||
         column[1] < lo.v * column[2] || column[1] > hi.v * column[2];
}

void TriangleSetup::set_up_snapping(const cases::Snapping& snapping) {
  shape = Shape::placed;
  for (std::size_t i = 0; i < 3; ++i) {
    is_clipped[i] = is_clipped[i] || sign_of(columns[i][2]) <= 0 || is_beyond_guard_band(i);
    is_whole = is_whole && !is_clipped[i];
    // Under another viewport the vertex would be rounded differently.
    is_clipped[i] = is_clipped[i] || scene->contract().has_open_viewport();
    if (is_clipped[i]) {
      shape = Shape::cut;
    } else {
      snapped[i] = snap(columns[i], snapping, scene->units_per_pixel());
    }
  }
  const Ring unit(scene->grid_unit());
  side_reach = Ring(promise.side_tolerance) * unit;
  reach = candidate_radius(snapping) * unit;
  if (shape == Shape::cut) {
    tolerance = (Ring(promise.clip_tolerance) + exact_ring(promise.position_error)) * unit;
    reach = std::max(reach, tolerance);
    moved_alone = reach;
    if (scene->contract().has_open_viewport()) open_viewport();
    may_turn = ideal.orientation() == 0 || !has_points_deeper_than(moved_alone);
  } else {
    corner_count_ = 1;
    for (const auto& vertex : snapped) corner_count_ *= vertex->extreme_placements();
  }
  has_open_sides = sign_of(side_reach) > 0 && scene->has_samples_within(near_double(side_reach));
  for (std::size_t i = 0; i < 3; ++i) edge_bands[i] = band_of(ideal.edge(i), reach);
}

/// True if no vertex lies beyond a plane, a clip distance, the guard band or a side of the
/// viewport, or as near to one as the contract leaves open.
bool TriangleSetup::is_surely_unclipped() const {
  const Ring share(promise.clip_error);
  bool is_inside = true;
  for_each_clip_plane([&](const std::array<Ring, 3>& values, bool, bool is_user_distance) {
    const Ring slack = sign_of(share) == 0 ? share : share * clip_size(values, is_user_distance);
    for (const Ring& value : values) is_inside = is_inside && value >= slack;
  });
  const Point& lo = scene->viewport_lo();
  const Point& hi = scene->viewport_hi();
  for (std::size_t i = 0; i < 3; ++i) {
    const RingVector3& column = columns[i];
    const Ring& w = column[2];
    is_inside = is_inside && sign_of(w) > 0 && !is_beyond_guard_band(i) && column[0] >= lo.u * w &&
                column[0] <= hi.u * w && column[1] >= lo.v * w && column[1] <= hi.v * w;
  }
  return is_inside;
}

/// Lines and points are of shape placed only if their vertices have one placement. With several
/// they are of shape cut, known to within `reach`. What clipping makes of one whose vertices are
/// moved as well is not known well enough: then nothing is promised of it, nor if the viewport is
/// open, and of Bresenham's lines only with one placement.
void TriangleSetup::set_up_snapped_primitive(const cases::Snapping& snapping) {
  const cases::Case& source = scene->source();
  const bool is_line = source.primitive == cases::Primitive::lines;
  promise.is_made = is_surely_unclipped() && !scene->contract().has_open_viewport();
  if (!promise.is_made) return;
  long placements = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    snapped[i] = snap(columns[i], snapping, scene->units_per_pixel());
    if (i < (is_line ? 2U : 1U)) {
      placements = std::min(placements * snapped[i]->placements(), kMostPlacements);
    }
  }
  const Ring vertex_reach = candidate_radius(snapping) * Ring(scene->grid_unit());
  if (placements == 1) {
    const bool has_two_values = scene->contract().basis == cases::Basis::unspecified;
    const bool is_thin = is_line && source.line_mode == cases::LineMode::bresenham;
    promise.is_made = !(is_thin && has_two_values);
    if (!promise.is_made) return;
    shape = Shape::placed;
    corner_count_ = 1;
    reach = vertex_reach;
    return;
  }
  const std::optional<Ring> moved =
      is_line ? reach_of_line(vertex_reach.to_interval().second) : vertex_reach;
  promise.is_made = moved.has_value();
  if (!promise.is_made) return;
  shape = Shape::cut;
  reach = *moved;
  tolerance = reach;
}

/// Reduces an open viewport to the requested one. Let A be the affine map, one per axis, that takes
/// the sides of the requested viewport to those of the drawn one. Moving a vertex by δ in the drawn
/// viewport equals moving it by δ/s in the requested one, where s is the factor of A. The drawn
/// viewport shows at p what the requested viewport would show at A^-1(p). Between the sides, which
/// move by at most the error, A^-1(p) is no farther from p than the error; beyond the sides,
/// something can be drawn only because vertices move on their own. A is the same for all vertices,
/// so it turns no triangle round.
void TriangleSetup::open_viewport() {
  const double error = scene->contract().viewport_error;
  const Ring grown(cases::most_growth(scene->source().viewport, error));
  moved_alone = grown * moved_alone;
  const Ring moved_together = Ring(error) * scene->units_per_pixel();
  tolerance = moved_alone + moved_together;
  reach = tolerance;
  side_reach = grown * side_reach + moved_together;
}

const ProjectiveMap& TriangleSetup::corner(std::size_t number) const {
  if (!is_triangle() && corners_.empty()) {
    corners_.push_back(std::make_unique<const ProjectiveMap>(map_of(placed_columns_of_all())));
  }
  if (corners_.empty()) {
    for (std::size_t i = 0; i < 3; ++i) {
      extreme_columns_[i] = placed_columns(*snapped[i], scene->grid_unit(), true);
    }
    corners_.resize(corner_count_);
  }
  std::unique_ptr<const ProjectiveMap>& map = corners_[number];
  if (!map) {
    // `number` is read in mixed radix, one digit per vertex. The digits of vertices 1 and 2 are
    // offsets from that of vertex 0, so the lowest numbers choose the same extreme for all three
    // vertices.
    const auto& choices = extreme_columns_;
    const std::size_t first = number % choices[0].size();
    const std::size_t second = number / choices[0].size() % choices[1].size();
    const std::size_t third = number / choices[0].size() / choices[1].size();
    map = std::make_unique<const ProjectiveMap>(
        std::array{choices[0][first], choices[1][(first + second) % choices[1].size()],
                   choices[2][(first + third) % choices[2].size()]});
  }
  return *map;
}

const TriangleSetup::NearPositions& TriangleSetup::near_positions() const {
  if (!near_positions_) {
    near_positions_.emplace();
    for (std::size_t i = 0; i < 3; ++i) {
      const double w = near_double(columns[i][2]);
      near_positions_->w[i] = w;
      near_positions_->u[i] = near_double(columns[i][0]) / w;
      near_positions_->v[i] = near_double(columns[i][1]) / w;
    }
  }
  return *near_positions_;
}

const std::optional<DepthOffset>& TriangleSetup::depth_offset() const {
  if (!depth_offset_) {
    depth_offset_ = scene->has_depth_bias() ? oracle::depth_offset(*this) : std::nullopt;
  }
  return *depth_offset_;
}

const ProjectiveMap* TriangleSetup::value_map() const {
  const cases::Basis basis = scene->contract().basis;
  if (shape != Shape::exact && scene->contract().has_open_viewport()) return nullptr;
  if (shape == Shape::exact || basis == cases::Basis::ideal) return &ideal;
  return basis == cases::Basis::snapped && corner_count() == 1 ? &corner(0) : nullptr;
}

std::vector<HomogeneousPoint> TriangleSetup::corners_beside(std::size_t edge) const {
  std::vector<HomogeneousPoint> all;
  const auto take = [&all](const ConvexRegion& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) all.push_back(polygon.vertex(i));
  };
  take(clipped_to_triangle(guard_band_of(*scene)));
  if (promise.clip_error > 0) {  // adds the corners if planes cut off as much as they may
    ConvexRegion least = guard_band_of(*scene);
    for (std::size_t i = 0; i < 3; ++i) least.clip(ideal.edge(i));
    for (const ClipFunctional& functional : clip_functionals()) {
      if (functional.is_violated) least.clip(functional.inner);
    }
    take(least);
  }
  std::vector<HomogeneousPoint> corners;
  for (const HomogeneousPoint& p : all) {
    const auto is_at = [&p](const RingVector3& column) {
      return p.u * column[2] == column[0] * p.t && p.v * column[2] == column[1] * p.t;
    };
    if (is_at(columns[(edge + 1) % 3]) || is_at(columns[(edge + 2) % 3])) continue;
    corners.push_back(p);
  }
  return corners;
}

const std::vector<TriangleSetup::SnappedEdge>& TriangleSetup::snapped_edge(std::size_t edge) const {
  std::optional<std::vector<SnappedEdge>>& all = snapped_edges_[edge];
  if (all) return *all;
  all.emplace();
  const double unit = scene->grid_unit();
  const SnappedVertex& from = *snapped[(edge + 1) % 3];
  const SnappedVertex& to = *snapped[(edge + 2) % 3];
  // In double, because the product of four counts may exceed a long.
  const bool corners_only =
      static_cast<double>(from.placements()) * static_cast<double>(to.placements()) >
      kMostPlacements;
  const std::vector<HomogeneousPoint> others = corners_beside(edge);
  for (const RingVector3& a : placed_columns(from, unit, corners_only)) {
    for (const RingVector3& b : placed_columns(to, unit, corners_only)) {
      RingVector3 row = a.cross(b);
      if (ideal.orientation() < 0) row = -row;
      const Line line{row[0], row[1], row[2]};
      const Ring band = band_of(line, reach);
      const bool is_turned =
          sign_of(row.dot(columns[edge])) <= 0 ||
          std::any_of(others.begin(), others.end(),
                      [&](const HomogeneousPoint& p) { return line.at(p) <= band * p.t; });
      all->push_back({line, is_turned});
    }
  }
  return *all;
}

bool TriangleSetup::has_certain_orientation() const {
  if (ideal.orientation() == 0 || has_nonpositive_w) return false;
  if (shape == Shape::cut) return is_whole && !may_turn;
  if (shape == Shape::exact) return !has_clipped_vertex;
  // Usually the mean of the vertices' window positions, where E_i = |det M|/(3 w_i), is deeper
  // inside than vertices move.
  bool is_mean_deep = true;
  for (std::size_t i = 0; i < 3; ++i) {
    is_mean_deep = is_mean_deep && ideal.determinant() > Ring(3) * columns[i][2] * edge_bands[i];
  }
  if (is_mean_deep) return true;
  // The determinant is affine in every coordinate of a vertex, so its signs at the extreme
  // placements decide.
  for (std::size_t k = 0; k < corner_count(); ++k) {
    if (corner(k).orientation() != ideal.orientation()) return false;
  }
  return true;
}

const Placements& TriangleSetup::placements() const {
  if (placements_) return *placements_;
  placements_.emplace();
  // In double, because the product of six counts may exceed a long.
  double count = 1;
  for (const auto& vertex : snapped) {
    count *= static_cast<double>(vertex->x.count()) * static_cast<double>(vertex->y.count());
  }
  placements_->are_all =
      count <= kMostPlacements && (scene->contract().is_on_grid || corner_count() == 1);
  for (std::size_t i = 0; i < 3; ++i) {
    placements_->points[i] = placed_points(*snapped[i], scene->grid_unit(), !placements_->are_all);
  }
  const auto& [first, second, third] = placements_->points;
  for (const auto& a : first) {
    for (const auto& b : second) {
      for (const auto& c : third) {
        placements_->orientations.push_back(
            turn_of(a, b, {Ring(c[0]), Ring(c[1])}, {c[0], c[1], true}));
      }
    }
  }
  return *placements_;
}

FieldRange TriangleSetup::extent(Eigen::Index axis) const {
  std::array<Field, 3> at;
  for (std::size_t i = 0; i < 3; ++i) at[i] = quotient(columns[i][axis], columns[i][2]);
  const Field spread(reach);
  return {std::min({at[0], at[1], at[2]}) - spread, std::max({at[0], at[1], at[2]}) + spread};
}

namespace {

/// Returns the range of pixels along an axis (the first, and one past the last) that lie within
/// `spread` of some point between two of the positions `at`, with pixel numbers clamped to
/// −1…`most`. Each position is known to within 2^-48 relative. Positions and spread are in units of
/// which a pixel has `units`.
std::pair<int, int> touched(std::span<const double> at, double spread, double units, int most) {
  const auto [least, greatest] = std::ranges::minmax(at);
  // The positions may be off by 2^-48, and the spread and these sums by as much again in any
  // rounding mode.
  const double slack = (std::max(std::abs(least), std::abs(greatest)) + spread) * 0x1p-47;
  if (!(slack < kInfinity)) return {0, most};
  // The slack is far more than the rounding of this quotient.
  const auto pixel_of = [most, units](double position) {
    const double pixel = std::floor(position / units);
    return static_cast<int>(std::clamp(pixel, -1.0, static_cast<double>(most)));
  };
  return {pixel_of(least - spread - slack), pixel_of(greatest + spread + slack) + 1};
}

}  // namespace

PixelBox TriangleSetup::pixels() const {
  if (!promise.is_made) return scene->target_pixels();
  if (!is_triangle()) return pixels_of_primitive();
  const PixelBox all = has_open_sides ? scene->target_pixels() : scene->pixels();
  if (may_cover_far_pixels(*this)) return all;
  const Ring moved = (shape == Shape::exact ? Ring(0) : reach) + conservative_spread(*scene);
  if (has_nonpositive_w) return pixels_of_clipped(all, moved);
  const double spread = near_double(moved);
  const NearPositions& near = near_positions();
  const double units = near_double(scene->units_per_pixel());
  const auto [x0, x1] = touched(near.u, spread, units, all.x1);
  const auto [y0, y1] = touched(near.v, spread, units, all.y1);
  return intersection(all, {x0, y0, x1, y1});
}

/// The box of a line or point. Half its size is enough to all sides of a square or a parallelogram,
/// and of a rectangle at any angle; pixels that Bresenham's lines select are at most one more away.
PixelBox TriangleSetup::pixels_of_primitive() const {
  const PixelBox& all = scene->target_pixels();
  if (has_nonpositive_w) return all;
  const double units = near_double(scene->units_per_pixel());
  const double spread = near_double(primitive_size()) + near_double(reach) + 2 * units;
  const NearPositions& near = near_positions();
  const auto [x0, x1] = touched(near.u, spread, units, all.x1);
  const auto [y0, y1] = touched(near.v, spread, units, all.y1);
  return intersection(all, {x0, y0, x1, y1});
}

/// The box of a triangle that reaches behind the eye: the box of the part that its clip planes
/// leave in the window, widened by `moved`. decide() permits nothing farther away.
PixelBox TriangleSetup::pixels_of_clipped(const PixelBox& all, const Ring& moved) const {
  if (ideal.orientation() == 0) return all;
  const Ring& per_pixel = scene->units_per_pixel();
  const ConvexRegion region = clipped_to_triangle(
      {Point{Ring(all.x0) * per_pixel - moved, Ring(all.y0) * per_pixel - moved},
       Point{Ring(all.x1) * per_pixel + moved, Ring(all.y1) * per_pixel + moved}});
  if (region.is_empty()) return {all.x0, all.y0, all.x0, all.y0};
  std::vector<double> u;
  std::vector<double> v;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const NearPoint near = near_point(region.vertex(i));
    if (!near.has_normal_products) return all;
    u.push_back(near.u);
    v.push_back(near.v);
  }
  const double spread = near_double(moved);
  const double units = near_double(per_pixel);
  const auto [x0, x1] = touched(u, spread, units, all.x1);
  const auto [y0, y1] = touched(v, spread, units, all.y1);
  return intersection(all, {x0, y0, x1, y1});
}

ConvexRegion TriangleSetup::shown_at(const Point& p) const {
  ConvexRegion places =
      box_around(p, Ring(scene->contract().viewport_error) * scene->units_per_pixel());
  for (std::size_t i = 0; i < 3; ++i) {
    places.clip_above(ideal.edge(i), -band_of(ideal.edge(i), moved_alone));
  }
  return places;
}

ConvexRegion TriangleSetup::clipped_to_triangle(ConvexRegion region) const {
  for (std::size_t i = 0; i < 3; ++i) region.clip(ideal.edge(i));
  // A functional negative at no vertex is negative nowhere in the triangle.
  for (const ClipFunctional& functional : clip_functionals()) {
    if (functional.is_violated) region.clip(functional.outer);
  }
  return region;
}

ConvexRegion box_around(const Point& p, const Ring& reach) {
  return {Point{p.u - reach, p.v - reach}, Point{p.u + reach, p.v + reach}};
}

ConvexRegion guard_band_of(const Scene& scene) {
  return {scene.guard_band_lo(), scene.guard_band_hi()};
}

}  // namespace rastercheck::oracle
