#include "oracle/internal/convex_region.h"

#include <algorithm>
#include <utility>

namespace rastercheck::oracle {
namespace {

/// The point where two lines that are not parallel meet: their cross product, or its negative.
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
  const NearPoint near = near_point(point);
  return {std::move(point), side, near};
}

int ConvexRegion::side_of(const Line& line, const Corner& corner) {
  const int side = line.certain_side(corner.near);
  return side != 0 ? side : sign_of(line.at(corner.point));
}

bool ConvexRegion::rises_above(const Line& line) const {
  return std::any_of(corners_.begin(), corners_.end(),
                     [&line](const Corner& corner) { return side_of(line, corner) > 0; });
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
      // The polygon leaves the half-plane at this corner, which lies on the line, so the corner's
      // next side is the line.
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
