#include "oracle/internal/diamond_line.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "oracle/internal/primitive_coverage.h"

namespace rastercheck::oracle {
namespace {

using records::Reason;
using records::SampleVerdict;
using records::Verdict;

/// The part of a line between s = `from` and s = `to`, in shares of the clip-space line.
struct Part {
  Field from{0};
  Field to{1};
};

/// The part of a line that is inside all planes and in front of the eye; empty if there is none.
/// Values of a plane are linear in s, from the first vertex to the second.
std::optional<Part> visible_part(const TriangleSetup& line) {
  Part part;
  bool is_seen = true;
  const auto cut = [&](const Ring& at_first, const Ring& at_second) {
    const int first = sign_of(at_first);
    const int second = sign_of(at_second);
    is_seen = is_seen && (first >= 0 || second >= 0);
    if ((first < 0) == (second < 0)) return;
    const Field where = quotient(at_first, at_first - at_second);
    if (first < 0) {
      part.from = std::max(part.from, where);
    } else {
      part.to = std::min(part.to, where);
    }
  };
  for (const auto& values : line.clip_values()) cut(values[0], values[1]);
  for (const auto& values : values_at_sides(line)) cut(values[0], values[1]);
  cut(line.columns[0][2], line.columns[1][2]);
  if (!is_seen || part.to < part.from) return std::nullopt;
  return part;
}

/// The window position of a share of the line, in pixels; empty at the eye.
std::optional<ExactPosition> position_at(const Scene& scene, const std::array<RingVector3, 3>& at,
                                         const Field& s) {
  const auto mixed = [&](const Ring& a, const Ring& b) {
    return Field((Field(1) - s) * Field(a) + s * Field(b));
  };
  const Field w = mixed(at[0][2], at[1][2]);
  if (sign_of(w) <= 0) return std::nullopt;
  const Field units(scene.units_per_pixel());
  return ExactPosition{mixed(at[0][0], at[1][0]) / (w * units),
                       mixed(at[0][1], at[1][1]) / (w * units)};
}

/// The least |x| + |y| along the line from a to b: at an end, or where the line crosses an axis.
/// Off by less than 2^-33 if coordinates are within 2^16. With u = 2^-53, t is off by 2 u relative,
/// which a difference of at most 2^17 makes 2^-35; the difference, its product with t and the sum
/// are off by 2^-36 each.
double least_distance(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  double least = std::min(std::abs(a[0]) + std::abs(a[1]), std::abs(b[0]) + std::abs(b[1]));
  for (std::size_t i = 0; i < 2; ++i) {
    if ((a[i] < 0) == (b[i] < 0)) continue;
    const double t = a[i] / (a[i] - b[i]);
    const std::size_t other = 1 - i;
    least = std::min(least, std::abs(a[other] + t * (b[other] - a[other])));
  }
  return least;
}

/// More than least_distance() of ends in double is off from that of the exact ends. Doubles within
/// 2^16 are off by at most 2^-36 along each axis, which changes |x| + |y| everywhere by at most
/// 2^-35; subtracting a pixel's centre adds 2^-36, and least_distance() 2^-33. That leaves room for
/// the infinitely small move that decides ties.
constexpr double kNear = 0x1p-32;
constexpr double kFarthestEnd = 0x1p16;

/// Wider lines are decided exactly: each copy of a pixel takes time.
constexpr long kMostCopies = 16;

}  // namespace

long rounded_width(const Scene& scene) {
  return std::max(1L, floor_to_long(exact_field(scene.source().line_width) + Field(1, 2)));
}

DiamondLine::DiamondLine(const TriangleSetup& line)
    : scene_(line.scene), width_(rounded_width(*line.scene)) {
  const bool is_exact = line.shape == Shape::exact;
  const std::array<RingVector3, 3> at = is_exact ? line.columns : line.placed_columns_of_all();
  const RingVector3 row = at[0].cross(at[1]);
  middle_ = {row[0], row[1], row[2]};
  const auto direction = direction_of(at[0], at[1]);
  // A line that meets a diamond is less than 1 pixel from its centre along the minor axis, and the
  // diamonds that a pixel is replicated from are at most (width − 1)/2 from the line that was
  // moved.
  far_away_ = Ring(static_cast<double>(width_ + 1)) * scene_->units_per_pixel() *
              magnitude(direction[major_axis(direction)]);
  const std::optional<Part> part = is_exact ? visible_part(line) : Part{};
  if (!part) return;
  const std::optional<ExactPosition> from = position_at(*scene_, at, part->from);
  const std::optional<ExactPosition> to = position_at(*scene_, at, part->to);
  is_cut_ = {sign_of(part->from) > 0, part->to < Field(1)};
  if (from && to) set_ends({*from, *to});
}

void DiamondLine::set_ends(const std::array<ExactPosition, 2>& ends) {
  ends_ = ends;
  direction_ = {ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]};
  major_ = magnitude(direction_[0]) < magnitude(direction_[1]) ? 1 : 0;
  moved_ = ends;
  for (ExactPosition& end : moved_) end[1 - major_] -= Field(static_cast<int>(width_ - 1), 2);
  std::array<NearPosition, 2> near{};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      near[i][axis] = CGAL::to_double(moved_[i][axis]);
      if (!(std::abs(near[i][axis]) <= kFarthestEnd)) return;
    }
  }
  if (ends[0] != ends[1] && width_ <= kMostCopies) near_ = near;
}

/// True if a pixel's centre is too far from the line, along the minor axis, to be selected.
bool DiamondLine::is_far_beside(int x, int y) const {
  return Ring(2) * magnitude(middle_.at(scene_->pixel_middle(x, y))) >= far_away_;
}

/// True if a pixel is so near to a new end that clipping made that it depends on how clipping is
/// done whether the pixel is selected.
bool DiamondLine::is_near_cut(const ExactPosition& cut, int x, int y) const {
  const Field most = Field(static_cast<int>(width_), 2) + Field(2);
  return magnitude(Field(Field(2 * x + 1, 2) - cut[0])) <= most &&
         magnitude(Field(Field(2 * y + 1, 2) - cut[1])) <= most;
}

/// Decides by doubles whether the diamond-exit rule selects the pixel; empty if they do not tell.
std::optional<bool> DiamondLine::nearly_selects(int x, int y) const {
  if (!near_) return std::nullopt;
  const std::size_t minor = 1 - major_;
  bool is_certain = true;
  for (long copy = 0; copy < width_; ++copy) {
    NearPosition center{x + 0.5, y + 0.5};
    center[minor] -= static_cast<double>(copy);
    const auto from_center = [&center](const NearPosition& p) {
      return NearPosition{p[0] - center[0], p[1] - center[1]};
    };
    const NearPosition from = from_center((*near_)[0]);
    const NearPosition to = from_center((*near_)[1]);
    const double off_line = least_distance(from, to);
    const double off_end = std::abs(to[0]) + std::abs(to[1]);
    if (off_line > 0.5 + kNear || off_end < 0.5 - kNear) continue;
    if (off_line < 0.5 - kNear && off_end > 0.5 + kNear) return true;
    is_certain = false;
  }
  return is_certain ? std::optional(false) : std::nullopt;
}

/// True if the diamond-exit rule selects the pixel.
bool DiamondLine::selects(int x, int y) const {
  const auto& [from, to] = moved_;
  if (from == to) return false;
  const std::size_t minor = 1 - major_;
  // The pixel is copy k of one that is k before it. The moved line is less than 1 pixel from that
  // one's centre.
  const std::array<Field, 2> center{Field(2 * x + 1, 2), Field(2 * y + 1, 2)};
  const Field there =
      from[minor] + (center[major_] - from[major_]) * direction_[minor] / direction_[major_];
  const long first = std::max(0L, floor_to_long(center[minor] - there - Field(1)));
  const long last = std::min(width_ - 1, ceil_to_long(center[minor] - there + Field(1)));
  const bool is_d3d = scene_->source().rules == cases::Rules::d3d;
  for (long k = first; k <= last; ++k) {
    const int back = static_cast<int>(k);
    const bool is_selected = minor == 0 ? exits_diamond(from, to, x - back, y, is_d3d)
                                        : exits_diamond(from, to, x, y - back, is_d3d);
    if (is_selected) return true;
  }
  return false;
}

SampleVerdict DiamondLine::decide(int x, int y) const {
  if (!ends_) {
    const bool is_outside = is_far_beside(x, y);
    return {Verdict::forbidden, is_outside ? Reason::outside : Reason::clipped};
  }
  const std::optional<bool> near = nearly_selects(x, y);
  if (near == false && !is_cut_[0] && !is_cut_[1]) return {Verdict::forbidden, Reason::outside};
  if (is_far_beside(x, y)) return {Verdict::forbidden, Reason::outside};
  for (std::size_t i = 0; i < 2; ++i) {
    if (is_cut_[i] && is_near_cut((*ends_)[i], x, y)) {
      return {Verdict::permitted, Reason::clip_edge};
    }
  }
  return near.value_or(false) || (!near && selects(x, y))
             ? SampleVerdict{Verdict::required, Reason::inside}
             : SampleVerdict{Verdict::forbidden, Reason::outside};
}

}  // namespace rastercheck::oracle
