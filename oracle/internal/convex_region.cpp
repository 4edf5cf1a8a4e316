#include "oracle/internal/convex_region.h"

#include <cmath>
#include <utility>

namespace rastercheck::oracle {
namespace {

/// Whether a double that near_double() made of `exact` is within kNearDoubleError of it, and
/// products of two such and their sums neither overflow nor get near the subnormal numbers.
bool is_tame(double near, const Ring& exact) {
  constexpr double kLeast = 0x1p-480;
  constexpr double kMost = 0x1p480;
  const double size = std::abs(near);
  return near == 0 ? sign_of(exact) == 0 : size > kLeast && size < kMost;
}

/// Where two lines that are not parallel meet: their cross product, or its negative.
HomogeneousPoint meeting_point(const Line& first, const Line& second) {
  HomogeneousPoint p{first.b * second.c - first.c * second.b,
                     first.c * second.a - first.a * second.c,
                     first.a * second.b - first.b * second.a};
  if (sign_of(p.t) < 0) return {-p.u, -p.v, -p.t};
  return p;
}

}  // namespace

ConvexRegion::ConvexRegion(const Point& lo, const Point& hi)
    : sides_{{Ring(0), Ring(1), -lo.v},
             {Ring(-1), Ring(0), hi.u},
             {Ring(0), Ring(-1), hi.v},
             {Ring(1), Ring(0), -lo.u}},
      corners_{make_corner({lo.u, lo.v, Ring(1)}, 0), make_corner({hi.u, lo.v, Ring(1)}, 1),
               make_corner({hi.u, hi.v, Ring(1)}, 2), make_corner({lo.u, hi.v, Ring(1)}, 3)} {}

ConvexRegion::Corner ConvexRegion::make_corner(HomogeneousPoint point, std::size_t side) {
  Corner corner;
  const double u = near_double(point.u);
  const double v = near_double(point.v);
  const double t = near_double(point.t);
  corner.is_near = is_tame(u, point.u) && is_tame(v, point.v) && is_tame(t, point.t);
  // Two errors of kNearDoubleError = 2^-51 and a rounding: less than 2^-49.
  corner.near_u = u / t;
  corner.near_v = v / t;
  corner.point = std::move(point);
  corner.side = side;
  return corner;
}

/// The sign of the line at the corner. In doubles each of the three terms is off by less than
/// 2^-49 + 2^-51 + 2^-52 of itself, and their sum by two roundings more: by less than 2^-47 of the
/// sum of their sizes, however the processor rounds.
int ConvexRegion::side_of(const Line& line, const Corner& corner) {
  const double a = near_double(line.a);
  const double b = near_double(line.b);
  const double c = near_double(line.c);
  if (corner.is_near && is_tame(a, line.a) && is_tame(b, line.b) && is_tame(c, line.c)) {
    const double along_u = a * corner.near_u;
    const double along_v = b * corner.near_v;
    const double value = along_u + along_v + c;
    const double sizes = std::abs(along_u) + std::abs(along_v) + std::abs(c);
    if (std::abs(value) > sizes * 0x1p-47) return value < 0 ? -1 : 1;
  }
  return sign_of(line.at(corner.point));
}

bool ConvexRegion::meets(const Line& line) const {
  bool is_somewhere_below = false;
  bool is_somewhere_above = false;
  for (const Corner& corner : corners_) {
    const int side = side_of(line, corner);
    is_somewhere_below = is_somewhere_below || side <= 0;
    is_somewhere_above = is_somewhere_above || side >= 0;
    if (is_somewhere_below && is_somewhere_above) return true;
  }
  return false;
}

void ConvexRegion::clip(const Line& line) {
  std::vector<int> at;
  at.reserve(corners_.size());
  bool is_cut = false;
  for (const Corner& corner : corners_) {
    at.push_back(side_of(line, corner));
    is_cut = is_cut || at.back() < 0;
  }
  if (!is_cut) return;
  const std::size_t side = sides_.size();
  sides_.push_back(line);
  std::vector<Corner> kept;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const int at_next = at[(i + 1) % corners_.size()];
    const std::size_t old_side = corners_[i].side;
    const bool is_crossed = at[i] * at_next < 0;
    if (at[i] >= 0) {
      kept.push_back(std::move(corners_[i]));
      // From a corner on the line to one beyond it: what follows is the line.
      if (at[i] == 0 && at_next < 0) kept.back().side = side;
    }
    if (is_crossed) {
      kept.push_back(
          make_corner(meeting_point(sides_[old_side], line), at_next < 0 ? side : old_side));
    }
  }
  corners_ = std::move(kept);
}

}  // namespace rastercheck::oracle
