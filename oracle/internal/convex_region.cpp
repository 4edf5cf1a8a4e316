#include "oracle/internal/convex_region.h"

namespace rastercheck::oracle {

ConvexRegion::ConvexRegion(const FieldPoint& lo, const FieldPoint& hi)
    : vertices_{lo, {hi.u, lo.v}, hi, {lo.u, hi.v}} {}

void ConvexRegion::clip_above(const Line& line, const Field& least) {
  std::vector<FieldPoint> kept;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const FieldPoint& from = vertices_[i];
    const FieldPoint& to = vertices_[(i + 1) % vertices_.size()];
    const Field at_from = line.at(from) - least;
    const Field at_to = line.at(to) - least;
    if (sign_of(at_from) >= 0) kept.push_back(from);
    if (sign_of(at_from) * sign_of(at_to) < 0) {
      const Field t = at_from / (at_from - at_to);
      kept.push_back({from.u + t * (to.u - from.u), from.v + t * (to.v - from.v)});
    }
  }
  vertices_ = std::move(kept);
}

}  // namespace rastercheck::oracle
