#include "oracle/internal/membership.h"

namespace rastercheck::oracle {

Membership side(const ClipFunctional& functional, const Point& p, const Scene& scene) {
  const Line& line = functional.line;
  if (line.is_constant() && sign_of(line.c) == 0) return {};
  if (functional.zero_is_tie) return side(line, p, scene);
  const int sign = line.sign_at(p);
  if (sign < 0) return kOutside;
  return {.tie = sign == 0 && functional.is_user_distance};
}

int side_within(const Line& line, const Ring& tolerance, const Point& p) {
  const double near_tolerance = near_double(tolerance);
  if (has_normal_products(near_tolerance, tolerance)) {
    const int side = line.certain_side(near_point(p), near_tolerance);
    if (side != 0) return side;
  }
  const Ring value = line.at(p);
  if (line.is_constant()) return sign_of(value) < 0 ? -1 : 1;
  const Ring band = band_of(line, tolerance);
  if (value > band) return 1;
  return value < -band ? -1 : 0;
}

records::Reason reason_of_cut(const TriangleSetup& triangle) {
  if (triangle.has_nonpositive_w) return records::Reason::nonpositive_w;
  const bool is_open = triangle.scene->contract().has_open_viewport();
  return is_open ? records::Reason::viewport : records::Reason::clip_edge;
}

}  // namespace rastercheck::oracle
