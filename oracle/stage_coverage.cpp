// Finds the stage that lost a sample or added one (oracle/stage_split.h).

#include <algorithm>
#include <cmath>
#include <string_view>

#include "oracle/internal/coverage.h"
#include "oracle/internal/floating_point.h"
#include "oracle/internal/snapping.h"
#include "oracle/internal/stage_forms.h"
#include "oracle/internal/stage_triangles.h"
#include "oracle/stage_split.h"

namespace rastercheck::oracle {
namespace {

using records::Reason;
using records::SampleTrace;
using records::Stage;
using records::Verdict;

/// True if a stage's output puts the sample inside the triangle; empty if the output does not
/// decide.
using Inside = std::optional<bool>;

/// Decides by the signs of three functionals at a point. Where a functional is 0, its normal
/// decides by the tie rule.
Inside inside(const std::array<Line, 3>& lines, const Point& p, const Scene& scene) {
  bool is_open = false;
  for (const Line& line : lines) {
    const int sign = sign_of(line.at(p));
    if (sign > 0) continue;
    if (sign < 0) return false;
    if (scene.contract().tie_rule == cases::TieRule::unspecified) {
      is_open = true;
    } else if (!scene.owns_tie(sign_of(line.a), sign_of(line.b))) {
      return false;
    }
  }
  if (is_open) return std::nullopt;
  return true;
}

Inside inside(const std::array<RingVector3, 3>& columns, const Point& p, const Scene& scene) {
  const ProjectiveMap map(columns);
  if (map.orientation() == 0) return false;
  return inside({map.edge(0), map.edge(1), map.edge(2)}, p, scene);
}

/// Returns the corners as an exact snap stage would place them; empty if the contract does not name
/// a single placement.
std::optional<std::array<RingVector3, 3>> placed(const Corners& corners, const Scene& scene) {
  const cases::Coverage& coverage = scene.contract().coverage;
  if (!coverage) return corners.columns;
  std::array<RingVector3, 3> columns;
  for (std::size_t c = 0; c < 3; ++c) {
    if (sign_of(corners.columns[c][2]) <= 0) return std::nullopt;
    const SnappedVertex vertex = snap(corners.columns[c], *coverage, scene.units_per_pixel());
    if (vertex.placements() != 1) return std::nullopt;
    columns[c] = placed_columns(vertex, scene.grid_unit(), true).front();
  }
  return columns;
}

/// True if the backend decided by the lines. Otherwise it decided by exact sums, by integers on the
/// subpixel grid, or by something unrelated to the lines.
bool decides_by_lines(std::string_view decision) { return decision == "in_double"; }

std::optional<std::array<Line, 3>> window_lines(const SampleTrace& trace) {
  if (!trace.lines || !trace.frame) return std::nullopt;
  std::array<Line, 3> lines;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<Line> line = window_line((*trace.lines)[i], *trace.frame);
    if (!line) return std::nullopt;
    lines[i] = *line;
  }
  return lines;
}

/// Decides by the computed E_i.
Inside inside(const std::array<double, 3>& edges) {
  if (std::any_of(edges.begin(), edges.end(), [](double e) { return e < 0; })) return false;
  if (std::all_of(edges.begin(), edges.end(), [](double e) { return e > 0; })) return true;
  return std::nullopt;
}

/// The stages from the corners to the weights.
class Geometry {
 public:
  Geometry(const SampleTrace& trace, const Scene& scene, const Point& p)
      : trace_(&trace), scene_(&scene), place_(p) {
    if (trace.corners) corners_ = traced_corners(*trace.corners, scene);
    if (trace.snapped) snapped_ = traced_corners(*trace.snapped, scene);
  }

  bool is_cut() const {
    return (corners_ && !corners_->are_vertices()) || (snapped_ && !snapped_->are_vertices());
  }

  /// The first stage whose output puts the sample inside (if `other`) or outside (if not `other`).
  std::optional<Stage> first(bool other) const {
    if (corners_) {
      const auto columns = placed(*corners_, *scene_);
      if (columns && inside(*columns, place_, *scene_) == other) return Stage::clip_space;
    }
    if (snapped_ && inside(snapped_->columns, place_, *scene_) == other) return Stage::snap;
    const auto lines = window_lines(*trace_);
    if (!lines || !decides_by_lines(trace_->decision)) return std::nullopt;
    if (inside(*lines, place_, *scene_) == other) return Stage::set_up;
    const std::optional<Point> taken = exact_point(trace_->u, trace_->v);
    if (!taken || inside(*lines, *taken, *scene_) == other) return Stage::coverage;
    if (trace_->edges && inside(*trace_->edges) == other) return Stage::weights;
    return std::nullopt;
  }

 private:
  const SampleTrace* trace_;
  const Scene* scene_;
  Point place_;
  std::optional<Corners> corners_;
  std::optional<Corners> snapped_;
};

}  // namespace

std::optional<Stage> StageSplit::coverage_stage(std::uint32_t x, std::uint32_t y,
                                                std::uint32_t sample, bool is_drawn,
                                                const SampleTrace* trace) const {
  const DefaultFloatingPoint modes;
  const auto px = static_cast<int>(x);
  const auto py = static_cast<int>(y);
  const auto ps = static_cast<int>(sample);
  const records::SampleVerdict wanted = triangles_->open.truth.judge(px, py, ps);
  if (wanted.verdict == (is_drawn ? Verdict::required : Verdict::forbidden) ||
      wanted.verdict == Verdict::permitted) {
    return std::nullopt;
  }
  if (trace == nullptr) return is_drawn ? std::nullopt : std::optional(Stage::coverage);
  if (trace->is_drawn != is_drawn) return std::nullopt;

  const std::optional<cases::Case> source = received_case(*trace, triangles_->drawn.scene.source());
  if (!source) return Stage::transform;
  const TriangleUnder handed(*source, triangles_->open.scene.contract());
  const Verdict other = is_drawn ? Verdict::required : Verdict::forbidden;
  if (handed.truth.judge(px, py, ps).verdict == other) return Stage::transform;

  const Scene& scene = handed.scene.scene();
  const Geometry geometry(*trace, scene, scene.sample_point(px, py, ps));
  if (!is_drawn && geometry.is_cut()) return std::nullopt;
  // The corners of an uncut triangle say nothing about clip planes, viewport borders or culling.
  const bool is_told = !is_drawn || geometry.is_cut() || wanted.reason == Reason::outside ||
                       wanted.reason == Reason::degenerate;
  const std::optional<Stage> stage = is_told ? geometry.first(is_drawn) : std::nullopt;
  return stage.value_or(Stage::coverage);
}

}  // namespace rastercheck::oracle
