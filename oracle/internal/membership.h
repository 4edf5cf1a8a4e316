#pragma once

// On which side of a boundary a point is, as far as a contract says.

#include "oracle/internal/line.h"
#include "oracle/internal/scene.h"
#include "oracle/internal/triangle_setup.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// Says whether a point is inside in some reading of the contract (`possible`), whether it is
/// inside in every reading (`sure`), and whether a boundary goes exactly through the point (`tie`).
struct Membership {
  bool possible = true;
  bool sure = true;
  bool tie = false;

  /// That of the points that are inside of both.
  Membership& operator&=(const Membership& other) {
    possible = possible && other.possible;
    sure = sure && other.sure;
    tie = tie || other.tie;
    return *this;
  }
};

inline constexpr Membership kOutside{.possible = false, .sure = false};

/// The answer of a boundary whose value at the point has the sign `sign` and whose inward normal
/// (A, B) has the signs `sign_a` and `sign_b`.
inline Membership side(int sign, int sign_a, int sign_b, const Scene& scene) {
  if (sign > 0) return {};
  if (sign < 0) return kOutside;
  if (scene.contract().tie_rule == cases::TieRule::unspecified) {
    return {.possible = true, .sure = false, .tie = true};
  }
  const bool inside = scene.owns_tie(sign_a, sign_b);
  return {.possible = inside, .sure = inside, .tie = true};
}

inline Membership side(const Line& boundary, const Point& p, const Scene& scene) {
  return side(boundary.sign_at(p), sign_of(boundary.a), sign_of(boundary.b), scene);
}

Membership side(const ClipFunctional& functional, const Point& p, const Scene& scene);

/// Compares |line(p)| with tolerance · (|A| + |B|), the line's largest change if p moves by the
/// tolerance along both axes. Returns 0 if |line(p)| is not larger, else 1 inside, −1 outside.
int side_within(const Line& line, const Ring& tolerance, const Point& p);

/// The reason why samples near a boundary of a triangle of shape cut are open.
records::Reason reason_of_cut(const TriangleSetup& triangle);

}  // namespace rastercheck::oracle
