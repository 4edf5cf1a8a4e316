#pragma once

// A second oracle, slow and written from Appendix 5 alone; every run compares the first oracle with
// it. It uses division freely. It answers for `exact` coverage and for values at samples and
// centres.
//
//   M_cam = [V1−C  V2−C  V3−C]      Q = M_cam^-1 [a b c]          (Appendix 5, p. 7)
//   w = 1/((q11+q21+q31) u + (q12+q22+q32) v + q13+q23+q33)
//   k = (q21 u + q22 v + q23) w     l = (q31 u + q32 v + q33) w
//   r = r1 + (r2 − r1) k + (r3 − r1) l                            (p. 6)
//   P = C + (c + u a + v b) w                                     (p. 7; its third line lacks w)
//
// Depths are biased, clamped and stored as docs/rules.md says, by the choices of contract_of(c).
//
// A clip position (x, y, w) plays the role of V − C, and the viewport is the image plane: a, b, c
// are the columns of the inverse viewport transform. The referee shares only the number type and
// the table of sample positions (cases/sample_pattern.h) with the fast path: no adjugate, no folded
// viewport, no edge function.

#include <cstdint>
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
  /// Biased and clamped as cases::contract_of(c) says, before it is stored.
  Rational depth;
  /// The integers that a unorm format may store the depth as: the nearest of the format, or two
  /// if the depth is half-way between them. Empty if the case asks for float32.
  std::vector<std::uint32_t> stored;
  /// [attribute]; empty if undefined, or if the location is centroid and the rules name no point.
  std::vector<std::optional<Rational>> attributes;
};

/// The referee for one triangle of `c`, which must outlive it.
class Referee {
 public:
  /// The quantities that the formulas above name; defined inside the oracle only.
  struct Plane;

  /// `claims`: how smooth values interpolate.
  Referee(const cases::Case& c, std::size_t triangle,
          cases::Claim claims = cases::Claim::perspective);
  ~Referee();

  /// The fragment at a sample; empty if the triangle does not cover the sample.
  std::optional<RefereeFragment> at(int x, int y, int sample) const;

 private:
  const cases::Case* case_;
  std::size_t triangle_;
  cases::Claim claims_;
  std::unique_ptr<Plane> plane_;  ///< null if the triangle covers nothing
};

/// Returns the fragment at one sample of one triangle; empty if not covered.
std::optional<RefereeFragment> referee(const cases::Case& c, std::size_t triangle, int x, int y,
                                       int sample, cases::Claim claims = cases::Claim::perspective);

}  // namespace rastercheck::oracle
