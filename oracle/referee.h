#pragma once

// A second oracle, for the first to be held against in every run: slow, dividing, and written from
// seed 001 alone. It answers for `exact` coverage and for values at samples and centres.
//
//   M_cam = [V1−C  V2−C  V3−C]      Q = M_cam^-1 [a b c]          (seed 001, p. 7)
//   w = 1/((q11+q21+q31) u + (q12+q22+q32) v + q13+q23+q33)
//   k = (q21 u + q22 v + q23) w     l = (q31 u + q32 v + q33) w
//   r = r1 + (r2 − r1) k + (r3 − r1) l                            (p. 6)
//   P = C + (c + u a + v b) w                                     (its third line lacks this w)
//
// A clip position (x, y, w) is taken for V − C, and the image plane is the viewport's: a, b, c are
// the columns of the inverse of the viewport transform. Nothing here is shared with the fast path
// but the number type and cases' table of sample positions: no adjugate, no folded viewport, no
// edge function.

#include <memory>
#include <optional>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/sample_place.h"
#include "oracle/rational.h"

namespace rastercheck::oracle {

struct RefereeFragment {
  cases::SamplePlace place = {};
  Rational depth;
  /// [attribute]; nothing where undefined, or where the location is centroid and the rules name no
  /// point.
  std::vector<std::optional<Rational>> attributes;
};

/// The referee for one triangle of a case, which outlives it.
class Referee {
 public:
  /// What its formulas name of a triangle; defined inside the oracle only.
  struct Plane;

  /// `claims`: what smooth values are taken to be.
  Referee(const cases::Case& c, std::size_t triangle,
          cases::Claim claims = cases::Claim::perspective);
  ~Referee();

  /// Its answer for a sample; nothing where it is not covered.
  std::optional<RefereeFragment> at(int x, int y, int sample) const;

 private:
  const cases::Case* case_;
  std::size_t triangle_;
  cases::Claim claims_;
  std::unique_ptr<Plane> plane_;  ///< nothing where the triangle covers nothing
};

/// The referee's answer for one sample of one triangle; nothing where it is not covered.
std::optional<RefereeFragment> referee(const cases::Case& c, std::size_t triangle, int x, int y,
                                       int sample, cases::Claim claims = cases::Claim::perspective);

}  // namespace rastercheck::oracle
