#include "rasterizer/internal/conservative_coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rasterizer/internal/determinant.h"
#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/exact_sum.h"

namespace rastercheck::rasterizer {
namespace {

/// One of the window's axes, as positions along it are computed.
struct WindowAxis {
  const AxisFrame& frame;
  double turn = 1;  ///< −1 if NDC points the other way
};

/// The sign of a vertex's window position minus a whole number. w must be positive. Every product
/// is exact.
int compare(const WindowAxis& axis, float coordinate, float w, double at) {
  ExactSum sum;
  sum.add(axis.turn * double{coordinate} * double{axis.frame.size});
  sum.add(double{w} * (2 * double{axis.frame.origin}));
  sum.add(double{w} * double{axis.frame.size});
  sum.add(double{w} * (-2 * at));
  return sum.sign();
}

/// ⌊position⌋ and ⌈position⌉ of a vertex, exact for positions between −2^16 and 2^16.
struct Whole {
  double floor = 0;
  double ceil = 0;
  double position = 0;  ///< within `error` of the exact one
  double error = 0;
};

Whole whole_of(const WindowAxis& axis, float coordinate, float w) {
  const double middle = axis.frame.shift / 2;
  const double away = axis.turn * double{coordinate} / double{w} * (double{axis.frame.size} / 2);
  const double position = middle + away;
  // Beyond every framebuffer, by more than all errors: those are below 2^-50 of the terms.
  constexpr double kFar = 0x1p16;
  const double error = 0x1p-50 * (std::abs(middle) + std::abs(away));
  if (!(std::abs(position) + error < kFar)) return {position, position, position, error};
  double floor = std::floor(position - error);
  if (floor == std::floor(position + error)) {
    const bool may_be_whole = floor >= position - error;
    if (!may_be_whole) return {floor, floor + 1, position, error};
  }
  while (compare(axis, coordinate, w, floor + 1) >= 0) ++floor;
  return {floor, compare(axis, coordinate, w, floor) == 0 ? floor : floor + 1, position, error};
}

/// Pixels from `begin` on, and before `end`; both whole or infinite.
PixelRange held(const PixelRange& range, double begin, double end) {
  const auto pixel = [&range](double at) {
    return static_cast<int>(
        std::clamp(at, static_cast<double>(range.begin), static_cast<double>(range.end)));
  };
  return {pixel(begin), pixel(end)};
}

int sign(double value) { return (value > 0) - (value < 0); }

}  // namespace

Fate ConservativeCoverage::locate(const InputTriangle& triangle) {
  y_ = -1;
  if (setting_.is_empty()) return Fate::degenerate;
  const auto& p = triangle.positions;
  turn_ = determinant_sign(p[0], p[1], p[2]);
  is_flat_ = turn_ == 0;
  if (is_flat_ && !is_outer_) return Fate::degenerate;
  const State& state = setting_.state;
  const bool is_culled_flat = is_flat_ && state.cull == Cull::back;
  if (is_culled_flat) return Fate::hidden;
  if (!is_flat_ && is_culled(state, setting_.frame.displayed(turn_))) return Fate::hidden;
  if (std::all_of(p.begin(), p.end(), [](const glm::vec4& q) { return q.w <= 0; })) {
    return Fate::hidden;
  }
  clip_functionals(state, p, triangle.distances, clips_);
  if (clips_.hides_all) return Fate::hidden;
  std::erase_if(clips_.all, [](const ClipFunctional& clip) {
    return std::none_of(clip.g.begin(), clip.g.end(),
                        [](const Coefficient& g) { return g.value < 0; });
  });
  find_box(triangle);
  return box_.columns.empty() || box_.rows.empty() ? Fate::hidden : Fate::drawn;
}

/// Finds the pixels from ⌊least⌋ to ⌈greatest⌉ of the triangle's window positions.
void ConservativeCoverage::find_box(const InputTriangle& triangle) {
  const auto& p = triangle.positions;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double turn = setting_.state.convention == Convention::d3d ? -1 : 1;
  const std::array<WindowAxis, 2> axes{WindowAxis{setting_.frame.u, 1},
                                       WindowAxis{setting_.frame.v, turn}};
  std::array<Whole, 2> ends{Whole{kInfinity, -kInfinity}, Whole{kInfinity, -kInfinity}};
  vertex_count_ = 0;
  for (const glm::vec4& a : p) {
    if (a.w <= 0) continue;
    std::array<NearPosition, 2>& near = vertices_[vertex_count_++];
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto index = static_cast<glm::length_t>(axis);
      const Whole at = whole_of(axes[axis], a[index], a.w);
      ends[axis].floor = std::min(ends[axis].floor, at.floor);
      ends[axis].ceil = std::max(ends[axis].ceil, at.ceil);
      near[axis] = {at.position, at.error};
      for (const glm::vec4& b : p) {
        if (b.w > 0) continue;
        // The sign of a difference of two exact products is certain.
        const int along = sign(double{b[index]} * double{a.w} - double{a[index]} * double{b.w});
        const double direction = along * axes[axis].turn * double{axes[axis].frame.size};
        if (direction > 0) ends[axis].ceil = kInfinity;
        if (direction < 0) ends[axis].floor = -kInfinity;
      }
    }
  }
  box_ = {held(setting_.bounds.sample_columns[0], ends[0].floor, ends[0].ceil),
          held(setting_.bounds.sample_rows[0], ends[1].floor, ends[1].ceil)};
}

Fate ConservativeCoverage::set_up(const InputTriangle& triangle, std::vector<DrawnPart>& parts) {
  const Fate fate = locate(triangle);
  if (fate != Fate::drawn) return fate;
  const auto& p = triangle.positions;
  const SampleFrame& frame = setting_.frame;
  edges_ = is_flat_ ? EdgeFunctions() : edge_functions(p, turn_, frame, setting_.tie_sign);
  set_corners();
  is_cut_set_up_ = false;
  positions_ = p;
  parts.resize(1);
  parts[0].is_flat = is_flat_;
  parts[0].source = {p, triangle.attributes, {}};
  if (is_flat_) {
    parts[0].weights = Weights();
    parts[0].weights.edges = edges_;
    parts[0].weights.frame = &frame;
  } else {
    parts[0].weights.set_ideal(p, edges_, frame);
  }
  return Fate::drawn;
}

void ConservativeCoverage::set_corners() {
  const SampleFrame& frame = setting_.frame;
  for (std::size_t i = 0; i < 3; ++i) {
    const EdgeFunction& edge = edges_[i];
    const bool rises_right = sign(edge.a.value) * frame.u.direction > 0;
    const bool rises_up = sign(edge.b.value) * frame.v.direction > 0;
    DecisiveCorner& corner = decisive_[i];
    corner.x = rises_right == is_outer_ ? 1 : 0;
    corner.y = rises_up == is_outer_ ? 1 : 0;
    corner.step = corner.x == 1 ? edge.a.value * (2 * frame.u.scale) : 0;
  }
}

/// An edge's row at the pixels' decisive corners, for U of the left ones.
double ConservativeCoverage::row_of(std::size_t edge, int y) const {
  return edges_[edge].row(setting_.frame, y + decisive_[edge].y) + decisive_[edge].step;
}

/// Returns the pixels of a row that the edges may leave, and at most one more on each side, as
/// ExactCoverage::span() does.
PixelRange ConservativeCoverage::span(std::size_t /*sample*/, int y) const {
  const SampleFrame& frame = setting_.frame;
  PixelRange span = box_.columns;
  if (!frame.u.is_exact || is_flat_) return span;
  for (std::size_t i = 0; i < 3; ++i) {
    const double slope = edges_[i].a.value * frame.u.scale;
    if (slope == 0) continue;
    const double crossing = ((-row_of(i, y) - 4 * edges_[i].band) / slope + frame.u.shift) / 2;
    if (slope > 0) {
      if (crossing - 1 > span.begin) {
        span.begin = crossing - 1 >= span.end ? span.end : static_cast<int>(crossing - 1);
      }
    } else if (crossing + 2 < span.end) {
      span.end = crossing + 2 <= span.begin ? span.begin : static_cast<int>(crossing + 2);
    }
  }
  return span;
}

/// The sign of an edge at its decisive corner of a pixel, without rounding.
bool ConservativeCoverage::is_on_the_right_side(std::size_t edge, int x, int y) const {
  const DecisiveCorner& corner = decisive_[edge];
  const int side = exact_edge(edges_[edge], setting_.frame, x + corner.x, y + corner.y).sign();
  return is_outer_ ? side > 0 : side >= 0;
}

/// The pixels that all edges leave.
Mask ConservativeCoverage::pixels_of_edges(int y, int first, int count,
                                           BlockWeights& weights) const {
  EdgeRow row;
  for (std::size_t i = 0; i < 3; ++i) {
    row.a[i] = edges_[i].a.value;
    row.row[i] = row_of(i, y);
    row.band[i] = 2 * edges_[i].band;
  }
  row.scale = setting_.frame.u.scale;
  row.shift = setting_.frame.u.shift;
  const BlockCoverage coverage = evaluate_edges(row, first, count, weights);
  Mask covered = coverage.sure;
  for_each_bit(coverage.possible & ~coverage.sure, [&](int j) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double e = weights.e[i][static_cast<std::size_t>(j)];
      if (e > row.band[i]) continue;
      // Without a band, e is exact, and here it is 0.
      const bool is_right = row.band[i] == 0 ? !is_outer_ : is_on_the_right_side(i, first + j, y);
      if (!is_right) return;
    }
    covered |= Mask{1} << j;
  });
  return covered;
}

/// 1 if doubles prove that a functional is positive all over a pixel, −1 if they prove it negative;
/// 0 if it may cut the pixel.
int ConservativeCoverage::side_of_plane(const ClipFunctional& functional, int x, int y) const {
  const SampleFrame& frame = setting_.frame;
  double value = 0;
  double error = 0;
  double along_u = 0;
  double along_v = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double g = functional.g[i].value;
    value += g * edges_[i].at(frame, x + 0.5, edges_[i].row(frame, y + 0.5));
    along_u += g * edges_[i].a.value;
    along_v += g * edges_[i].b.value;
    // The value and the changes have some ten roundings of terms no larger than S.
    error += std::abs(g) * (edges_[i].band + 64 * 0x1p-53 * edges_[i].greatest);
  }
  // Half a pixel changes U by `scale`.
  const double change = std::abs(along_u * frame.u.scale) + std::abs(along_v * frame.v.scale);
  if (std::abs(value) <= change + 2 * error) return 0;
  return value > 0 ? 1 : -1;
}

/// Decides whether clip planes and the viewport leave some of the triangle in a pixel that all
/// edges leave.
bool ConservativeCoverage::is_visible(int x, int y) {
  const DrawBounds& bounds = setting_.bounds;
  bool is_cut = is_flat_ || !bounds.whole_columns.contains(x) || !bounds.whole_rows.contains(y);
  for (const ClipFunctional& functional : clips_.all) {
    const int side = is_flat_ ? 0 : side_of_plane(functional, x, y);
    if (side < 0) return false;
    is_cut = is_cut || side == 0;
  }
  if (!is_cut) return true;
  // Few triangles get here, and preparing the cuts takes as long as drawing a small triangle.
  if (!is_cut_set_up_) can_meet_ = cut_.set_up(positions_, clips_);
  is_cut_set_up_ = true;
  return can_meet_ && cut_.meets(x, y);
}

/// True if a pixel lies inside all clip planes: where all four corners are inside, boundary
/// included, so is the pixel.
bool ConservativeCoverage::is_inside_planes(int x, int y) const {
  const SampleFrame& frame = setting_.frame;
  return std::all_of(clips_.all.begin(), clips_.all.end(), [&](const ClipFunctional& functional) {
    if (const int side = side_of_plane(functional, x, y); side != 0) return side > 0;
    const ClipFunctional closed{functional.g, true};
    for (const int u : {x, x + 1}) {
      for (const int v : {y, y + 1}) {
        std::array<double, 3> e{};
        for (std::size_t i = 0; i < 3; ++i) e[i] = edges_[i].at(frame, u, edges_[i].row(frame, v));
        if (!is_kept(closed, edges_, e, frame, u, v, setting_.tie_sign)) return false;
      }
    }
    return true;
  });
}

/// The pixels whose sample may lie exactly at a vertex.
Mask ConservativeCoverage::pixels_at_vertices(std::size_t sample, int y, int first) const {
  const SampleOffset& offset = setting_.pattern[sample];
  Mask near = 0;
  for (std::size_t i = 0; i < vertex_count_; ++i) {
    const auto& [u, v] = vertices_[i];
    if (std::abs(v.at - (y + offset.y)) > v.error) continue;
    const double column = std::round(u.at - offset.x);
    if (std::abs(u.at - (column + offset.x)) > u.error) continue;
    if (column >= first && column < first + kBlockSize) {
      near |= Mask{1} << static_cast<int>(column - first);
    }
  }
  return near;
}

CoveredBlock ConservativeCoverage::cover(std::size_t sample, int y, int first, int count,
                                         BlockWeights& weights) {
  if (y_ != y || first_ != first || count_ != count) {
    y_ = y;
    first_ = first;
    count_ = count;
    const PixelRange columns = intersection(box_.columns, {first, first + count});
    covered_ = columns_mask(columns, first);
    if (!box_.rows.contains(y)) covered_ = 0;
    if (!is_flat_ && covered_ != 0) covered_ &= pixels_of_edges(y, first, count, weights);
    const DrawBounds& bounds = setting_.bounds;
    Mask open = covered_;
    if (!is_flat_ && clips_.all.empty()) {
      open = bounds.whole_rows.contains(y) ? covered_ & ~columns_mask(bounds.whole_columns, first)
                                           : covered_;
      if (!is_outer_) open = 0;
    }
    for_each_bit(open, [&](int j) {
      const bool stays = is_outer_ ? is_visible(first + j, y) : is_inside_planes(first + j, y);
      if (!stays) covered_ &= ~(Mask{1} << j);
    });
  }
  CoveredBlock block;
  block.covered = covered_;
  block.at_vertex = is_flat_ ? 0 : covered_ & pixels_at_vertices(sample, y, first);
  return block;
}

}  // namespace rastercheck::rasterizer
