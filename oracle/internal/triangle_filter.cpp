#include "oracle/internal/triangle_filter.h"

#include <algorithm>
#include <cmath>

#include "oracle/internal/conservative.h"

namespace rastercheck::oracle {
namespace {

using records::Reason;
using records::SampleVerdict;
using records::Verdict;

/// Nonzero coefficients must be within these limits, to keep the products of a value's error
/// (filter_kernels.h) in the normal doubles. The least product has three factors: a float32
/// difference and a w, each at least 2^-149, and an edge function, which is a multiple of 2^(-600 -
/// 4 - 52) at any sample. The greatest is 2^129 times 2^128 times 2^(600 + 15 + 2).
constexpr double kLeastCoefficient = 0x1p-600;
constexpr double kMostCoefficient = 0x1p600;

/// True if a coefficient, the near_double() of `exact`, is within these limits. With a camera
/// `exact` may be so small that 0 is the nearest double.
bool fits_filter(double coefficient, const Ring& exact) {
  const double size = std::abs(coefficient);
  return size == 0 ? sign_of(exact) == 0 : size >= kLeastCoefficient && size <= kMostCoefficient;
}

/// Keeps only the bits first … last − 1 of the words.
void keep_bits(int first, int last, std::vector<std::uint64_t>& words) {
  for (std::size_t w = 0; w < words.size(); ++w) {
    const int from = first - static_cast<int>(w) * 64;
    const int to = last - static_cast<int>(w) * 64;
    std::uint64_t kept = from >= 64 || to <= 0 ? 0 : ~std::uint64_t{0};
    if (kept != 0 && from > 0) kept &= ~std::uint64_t{0} << from;
    if (kept != 0 && to < 64) kept &= ~(~std::uint64_t{0} << to);
    words[w] &= kept;
  }
}

}  // namespace

Point corner_of(const PixelBox& box) { return {Ring(box.x0), Ring(box.y0)}; }

std::optional<FilterLine> filter_line(const Line& line, const PixelBox& box) {
  const Ring at_corner = line.at(corner_of(box));
  const double a = near_double(line.a);
  const double b = near_double(line.b);
  const double c = near_double(at_corner);
  if (!fits_filter(a, line.a) || !fits_filter(b, line.b) || !fits_filter(c, at_corner)) {
    return std::nullopt;
  }
  const double width = box.x1 - box.x0;
  const double height = box.y1 - box.y0;
  const double size = std::abs(a) * width + std::abs(b) * height + std::abs(c);
  // 4u for the coefficients and 4u for three roundings; the rest covers the rounding of this sum
  // (proofs/edge.g).
  return FilterLine{a, b, c, (kNearDoubleError + 0x1p-51) * size};
}

IntervalLine interval_line(const Line& line, const PixelBox& box) {
  return {interval_of(line.a), interval_of(line.b), interval_of(line.at(corner_of(box)))};
}

TriangleFilter::TriangleFilter(const TriangleSetup& triangle, const PixelBox& box, Level first)
    : triangle_(&triangle),
      box_(box),
      first_level_(triangle.scene->is_in_pixels() ? first : Level::exact),
      boundary_(coverage_boundary(triangle)) {
  is_empty_ = box.x1 <= box.x0 || box.y1 <= box.y0 || (boundary_ && !boundary_->is_drawn) ||
              is_cut_and_culled();
  set_inner_pixels();
  const bool has_lines =
      first_level_ == Level::filter && triangle.promise.is_made && !triangle.may_be_left_out;
  if (is_empty_ || !has_lines) return;
  if (!triangle.is_triangle()) {
    add_primitive_lines();
    return;
  }
  if (triangle.scene->contract().conservative) {
    add_conservative_lines();
    return;
  }
  if (triangle.shape != Shape::exact && triangle.ideal.orientation() == 0) add_line_of_degenerate();
  if (triangle.shape == Shape::cut) add_cut_lines();
  if (!boundary_) return;
  bool is_filtered = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Ring margin = boundary_->has_bands ? triangle.edge_bands[i] : Ring(0);
    is_filtered = is_filtered && add(boundary_->map->edge(i), margin);
  }
  if (triangle.shape == Shape::exact && triangle.is_cut_by_planes) {
    for (const ClipFunctional& functional : triangle.clip_functionals()) {
      // A functional that is 0 everywhere counts as inside, which no band can express.
      const bool is_zero = functional.line.is_constant() && sign_of(functional.line.c) == 0;
      is_filtered = is_filtered && (is_zero || add(functional.line, Ring(0)));
    }
  }
  if (!is_filtered) lines_.clear();
}

/// Adds the edges and clip planes, each with the margin within which a sample does not decide its
/// pixel. A plane that is 0 everywhere counts as inside, which no margin can express.
void TriangleFilter::add_conservative_lines() {
  if (!boundary_) return;
  const Ring distance = decisive_distance(*triangle_).value();
  bool is_filtered = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Line& edge = boundary_->map->edge(i);
    is_filtered = is_filtered && add(edge, band_of(edge, distance));
  }
  for (const ClipFunctional& functional : triangle_->clip_functionals()) {
    if (!functional.is_violated) continue;
    is_filtered = is_filtered && add(functional.line, band_of(functional.line, distance));
  }
  if (!is_filtered) lines_.clear();
}

bool TriangleFilter::is_cut_and_culled() const {
  return triangle_->is_triangle() && triangle_->promise.is_made && triangle_->shape == Shape::cut &&
         triangle_->ideal.orientation() != 0 && facing_of_cut(*triangle_) == CutFacing::culled;
}

void TriangleFilter::set_inner_pixels() {
  inner_ = triangle_->scene->inner_pixels();
  if (!triangle_->has_open_sides) return;
  // Leaves out ⌊reach⌋ + 1 pixels on each side, because a sample exactly at the reach is open, too.
  const double units = near_double(triangle_->scene->units_per_pixel());
  const double reach = std::min(triangle_->side_reach.to_interval().second / units, 0x1p20);
  const int pixels = static_cast<int>(std::floor(reach)) + 1;
  inner_ = {inner_.x0 + pixels, inner_.y0 + pixels, inner_.x1 - pixels, inner_.y1 - pixels};
}

bool TriangleFilter::add(const Line& line, const Ring& margin) {
  std::optional<FilterLine> filter = filter_line(line, box_);
  if (!filter) return false;
  if (sign_of(margin) != 0) {
    filter->band = (filter->band + margin.to_interval().second) * (1 + 0x1p-50);
  }
  lines_.push_back(*filter);
  return true;
}

/// Adds one line for several readings of a boundary. If the line is beyond its band, all readings
/// are beyond their margins, on the same side.
///
/// The line is the first reading R. Its band is the greatest |s L − R| + s · margin of any reading
/// L, where s > 0 may be chosen freely for each L. Two affine functions differ most at corners of
/// the box.
bool TriangleFilter::add_enclosing(const std::vector<OpenLine>& readings) {
  std::optional<FilterLine> filter = filter_line(readings.front().line, box_);
  if (!filter) return false;
  const auto size_of = [](const Line& line) {
    return std::abs(near_double(line.a)) + std::abs(near_double(line.b));
  };
  const double size = size_of(readings.front().line);
  const double width = box_.x1 - box_.x0;
  const double height = box_.y1 - box_.y0;
  double most = 0;
  {
    const UpwardRounding upward;
    const IntervalLine first = interval_line(readings.front().line, box_);
    for (const OpenLine& reading : readings) {
      const double scale = size / size_of(reading.line);
      const bool is_ordinary = scale > 0x1p-500 && scale < 0x1p500;
      if (!is_ordinary) return false;
      const IntervalLine line = interval_line(reading.line, box_);
      const Interval margin = Interval(scale) * interval_of(reading.margin);
      for (const double x : {0.0, width}) {
        for (const double y : {0.0, height}) {
          const Interval off = Interval(scale) * line.at(x, y) - first.at(x, y);
          most = std::max(most, (CGAL::abs(off) + margin).sup());
        }
      }
    }
  }
  if (!(most < 0x1p600)) return false;
  filter->band = (filter->band + most) * (1 + 0x1p-50);
  lines_.push_back(*filter);
  return true;
}

/// Returns every line that the contract allows for an edge with two snapped ends. The exact edge is
/// among these lines, because decide() makes another test for samples outside the exact edge:
/// whether anything drawn reaches them at all.
std::vector<TriangleFilter::OpenLine> TriangleFilter::readings_of_edge(std::size_t edge) const {
  const Line& exact = triangle_->ideal.edge(edge);
  std::vector<OpenLine> readings{{exact, Ring(0)}};
  for (const TriangleSetup::SnappedEdge& snapped : triangle_->snapped_edge(edge)) {
    readings.push_back(snapped.is_turned ? OpenLine{exact, band_of(exact, triangle_->reach)}
                                         : OpenLine{snapped.line, Ring(0)});
  }
  return readings;
}

/// Adds a clip plane that cuts the triangle. Its error consists of the tolerance and the error of
/// clip distances.
bool TriangleFilter::add_clip_line(const ClipFunctional& functional) {
  std::vector<OpenLine> readings{
      {functional.line, Ring(0)},
      {functional.outer, band_of(functional.outer, triangle_->tolerance)}};
  if (triangle_->promise.clip_error > 0) {
    readings.push_back({functional.inner, band_of(functional.inner, triangle_->tolerance)});
  }
  const bool has_constant =
      std::any_of(readings.begin(), readings.end(),
                  [](const OpenLine& reading) { return reading.line.is_constant(); });
  return !has_constant && add_enclosing(readings);
}

/// Adds the line that all vertices lie on. Samples farther from the line than corners may move are
/// outside; no sample is inside.
void TriangleFilter::add_line_of_degenerate() {
  const TriangleSetup& triangle = *triangle_;
  if (boundary_) return;
  const Ring& reach = triangle.shape == Shape::cut ? triangle.tolerance : triangle.reach;
  for (std::size_t i = 0; i < 3; ++i) {
    const Line& line = triangle.ideal.edge(i);
    if (line.is_constant()) continue;
    const Ring band = band_of(line, reach);
    if (!add(line, band) || !add({-line.a, -line.b, -line.c}, band)) lines_.clear();
    return;  // all rows of adj(M) are multiples of one line
  }
}

/// Adds the boundaries that decide() tests for a triangle of shape cut, each with the band that the
/// contract leaves open.
void TriangleFilter::add_cut_lines() {
  const TriangleSetup& triangle = *triangle_;
  if (triangle.ideal.orientation() == 0 || facing_of_cut(triangle) != CutFacing::drawn) return;
  bool is_filtered = true;
  for (std::size_t i = 0; i < 3 && is_filtered; ++i) {
    const Line& edge = triangle.ideal.edge(i);
    const bool is_cut = triangle.is_clipped[(i + 1) % 3] || triangle.is_clipped[(i + 2) % 3];
    is_filtered = !edge.is_constant() && (is_cut ? add(edge, band_of(edge, triangle.tolerance))
                                                 : add_enclosing(readings_of_edge(i)));
  }
  for (const ClipFunctional& functional : triangle.clip_functionals()) {
    is_filtered = is_filtered && (!functional.is_violated || add_clip_line(functional));
  }
  if (!is_filtered) lines_.clear();
}

const FilterLine* TriangleFilter::edges_of(const ProjectiveMap* map) const {
  const bool has_them =
      boundary_ && boundary_->map == map && !boundary_->has_bands && !lines_.empty();
  return has_them ? lines_.data() : nullptr;
}

void TriangleFilter::classify(int y, const cases::SamplePosition& sample, RowVerdicts& row) const {
  const int count = box_.x1 - box_.x0;
  const auto words = static_cast<std::size_t>((count + 63) / 64);
  row.required.assign(words, 0);
  row.forbidden.assign(words, 0);
  if (lines_.empty()) return;
  classify_row(lines_, sample.x / 16.0, y - box_.y0 + sample.y / 16.0, count, row.required.data(),
               row.forbidden.data());
  // Beyond the inner pixels no sample counts as required, but a sample outside an edge is forbidden
  // there, too.
  if (y < inner_.y0 || y >= inner_.y1 || inner_.x1 <= inner_.x0) {
    row.required.assign(words, 0);
  } else if (inner_.x0 > box_.x0 || inner_.x1 < box_.x1) {
    keep_bits(inner_.x0 - box_.x0, inner_.x1 - box_.x0, row.required);
  }
}

void TriangleFilter::make_interval_lines() const {
  const auto add = [this](const Line& line) {
    interval_lines_.push_back({interval_line(line, box_), sign_of(line.a), sign_of(line.b)});
  };
  for (std::size_t i = 0; i < 3; ++i) add(boundary_->map->edge(i));
}

std::optional<SampleVerdict> TriangleFilter::decide(int x, int y,
                                                    const cases::SamplePosition& sample) const {
  const PixelBox& inner = inner_;
  const bool is_inner = x >= inner.x0 && x < inner.x1 && y >= inner.y0 && y < inner.y1;
  const bool is_simple =
      boundary_ && !boundary_->has_bands && is_inner && first_level_ != Level::exact;
  if (!is_simple) return std::nullopt;
  if (interval_lines_.empty()) make_interval_lines();

  const Scene& scene = *triangle_->scene;
  const double u = x - box_.x0 + sample.x / 16.0;
  const double v = y - box_.y0 + sample.y / 16.0;
  bool is_certain = true;
  bool is_tie = false;
  for (const SignedLine& edge : interval_lines_) {
    const Interval value = edge.line.at(u, v);
    if (value.inf() > 0) continue;
    if (value.sup() < 0) return SampleVerdict{Verdict::forbidden, Reason::outside};
    if (value.inf() != 0 || value.sup() != 0) {
      is_certain = false;
      continue;
    }
    // An unspecified tie rule leaves the sample to the next level.
    if (scene.contract().tie_rule == cases::TieRule::unspecified) return std::nullopt;
    if (!scene.owns_tie(edge.sign_a, edge.sign_b)) {
      return SampleVerdict{Verdict::forbidden, Reason::outside};
    }
    is_tie = true;
  }
  // Triangles cut by clip planes are rare enough for exact numbers.
  const bool has_planes = triangle_->shape == Shape::exact && triangle_->is_cut_by_planes;
  if (!is_certain || has_planes) return std::nullopt;
  return SampleVerdict{Verdict::required, is_tie ? Reason::tie : Reason::inside};
}

}  // namespace rastercheck::oracle
