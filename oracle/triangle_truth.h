#pragma once

// The exact truth of one triangle of a case: the verdict of every sample, the values a fragment may
// have, and the distance to the deciding boundary. Implements RULES §1–§5. It does not draw: it
// answers for one sample at a time, from the case alone.

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "cases/case.h"
#include "cases/contract.h"
#include "oracle/pixel_box.h"
#include "oracle/rational.h"
#include "records/enclosure.h"
#include "records/float_range.h"
#include "records/judgement.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

class Scene;
struct TriangleSetup;
class TriangleValues;
class ValueErrors;

/// A case with its clip positions in exact numbers, shared by its triangles. With a camera, clip
/// positions are projection · view · model · position without rounding.
class SceneTruth {
 public:
  /// Ignores the contract's promises about single triangles unless it has one for every triangle of
  /// the case.
  SceneTruth(cases::Case source, const cases::Contract& contract);
  SceneTruth(const SceneTruth&) = delete;
  SceneTruth& operator=(const SceneTruth&) = delete;
  ~SceneTruth();

  const cases::Case& source() const { return source_; }
  const cases::Contract& contract() const { return contract_; }
  const Scene& scene() const { return *scene_; }

 private:
  cases::Case source_;
  cases::Contract contract_;
  std::unique_ptr<Scene> scene_;
};

/// Partial derivatives of an attribute at its location.
struct Derivatives {
  Rational du;  ///< ∂r/∂u = (N_u − r D_u)/D, per pixel of window x
  Rational dv;  ///< ∂r/∂v, per pixel of window y
};

/// Derivatives and their scales. A derivative is a difference of terms, and its scale is the size
/// of these terms (cases::Contract): max|r_i| Σ|∂E_i/∂u| / Σ E_i for a smooth attribute, Σ|r_i w_i
/// ∂E_i/∂u| / Σ w_i E_i for a noperspective one, 0 for a flat one.
struct ScaledDerivatives {
  Derivatives exact;
  Derivatives scale;
};

/// The judgement of a computed derivative: correct, beyond the bound, infinite or NaN.
struct JudgedDerivative {
  records::FragmentClass fragment_class = records::FragmentClass::correct;
  /// Signed, in ulp(max(|exact|, scale)); empty if infinite or NaN.
  std::optional<records::Enclosure> error;
};

enum class WindowAxis { x, y };

/// The difference r(odd) − r(even) between the two neighbouring pixels of an even-aligned 2×2 quad,
/// as seen by a fragment in either pixel (cases::Contract::quad_share).
struct QuadDifference {
  Rational exact;
  Rational allowed;                 ///< quad_share (M + g M'); 0 if flat
  bool is_next_to_horizon = false;  ///< g > cases::kMostQuadHorizon: nothing is promised
};

/// How much a fragment amplifies errors (RULES §5). `kappa` is empty if its divisor is 0, `kappa_d`
/// if D <= 0. A smooth attribute has the terms n_i = r_i, a noperspective one n_i = r_i w_i.
struct Conditioning {
  std::optional<Rational> kappa;    ///< Σ|n_i e_i| / |Σ n_i e_i|: relative errors of the weights
  std::optional<Rational> kappa_d;  ///< max_i(|A_i u| + |B_i v| + |C_i|)/D: cancellation in the
                                    ///< weights
};

/// Rows (A_i, B_i, C_i) of Q.
using QMatrix = std::array<std::array<Rational, 3>, 3>;

/// All answers are for pixel (x, y) and sample `sample` of the framebuffer's pattern; `attribute`
/// is an index into the case's attributes. The scene must outlive the truth.
class TriangleTruth {
 public:
  /// `triangle` is an index into the case's triangles.
  TriangleTruth(const SceneTruth& scene, std::size_t triangle);
  ~TriangleTruth();

  /// The box of pixels outside of which every sample is forbidden.
  PixelBox pixels() const;

  /// sign(det M): +1, −1, or 0 for a triangle seen edge-on (it covers nothing).
  int orientation() const;

  /// Q = M^-1 (RULES §1) of the exact vertices; empty if det M = 0.
  std::optional<QMatrix> q_matrix() const;

  /// e = Q (u, v, 1) at a sample; the sum of e is 1/w. Empty if det M = 0.
  std::optional<std::array<Rational, 3>> edges(int x, int y, int sample) const;

  /// True if no vertex is clipped and every placement that the contract allows has the same
  /// orientation.
  bool has_certain_orientation() const;

  records::SampleVerdict judge(int x, int y, int sample) const;

  /// The signed distance to the deciding boundary, in pixels, positive inside: a certified
  /// enclosure of an irrational number. Empty for a triangle without orientation.
  std::optional<records::Enclosure> distance(int x, int y, int sample) const;

  /// The values that a fragment at this sample may have; empty if undefined (a centre behind the
  /// horizon). The sample must not be forbidden.
  std::optional<ValueRange> depth(int x, int y, int sample) const;
  std::optional<ValueRange> attribute(std::size_t attribute, int x, int y, int sample) const;

  /// True if every value counts as right for an attribute, or for the depth if `attribute` is
  /// empty: either the APIs leave the value open (RULES §3: a noperspective attribute, or a smooth
  /// one that the contract claims to be affine, if some w_i <= 0), or the contract promises nothing
  /// about it. Even if the APIs leave the value open, attribute() returns what the formula gives
  /// there.
  bool is_value_free(std::optional<std::size_t> attribute) const;

  /// The largest excess allowed, in scale ULP, for an attribute, or for the depth if `attribute` is
  /// empty. Empty if no bound is promised, e.g. if 1/w <= 0 at the point of evaluation. If several
  /// points are possible, returns the largest of their bounds.
  std::optional<Rational> value_bound(std::optional<std::size_t> attribute, int x, int y,
                                      int sample) const;

  /// The numbers that the judge takes for right: the allowed range, widened by the bound. Empty if
  /// the value is undefined or free, or if any number is right. Says nothing about the sign of a
  /// zero. The sample must not be forbidden.
  std::optional<records::FloatRange> permitted_numbers(std::optional<std::size_t> attribute, int x,
                                                       int y, int sample) const;

  /// The magnitude that scale ULP refer to: max |r_i|.
  Rational attribute_magnitude(std::size_t attribute) const;

  /// Analytic screen derivatives of a smooth or noperspective attribute (zero if flat). Empty if
  /// the value is undefined or the contract allows several placements.
  std::optional<Derivatives> derivatives(std::size_t attribute, int x, int y, int sample) const;

  /// Like derivatives(), at the point where the attribute is evaluated, with the scales of their
  /// errors. Also empty if that point is open. With several samples, the centroid is open under
  /// OpenGL and Vulkan, and under D3D if coverage leaves any sample of the pixel open.
  std::optional<ScaledDerivatives> scaled_derivatives(std::size_t attribute, int x, int y,
                                                      int sample) const;

  /// Judges computed ∂r/∂u and ∂r/∂v against scaled_derivatives(), exactly; `bound` is in the
  /// errors' unit. An infinity counts as ±2^128, and is correct if the exact value lies beyond
  /// that.
  std::optional<std::array<JudgedDerivative, 2>> judge_derivatives(
      std::size_t attribute, int x, int y, int sample, std::span<const float, 2> computed,
      float bound) const;

  /// The exact value of an API's dFdx or dFdy for the fragment at (x, y), and its largest allowed
  /// error. The value is the attribute's difference along `axis` across the even-aligned 2×2 quad
  /// of pixels that holds (x, y); helper pixels extrapolate. Empty if either value is undefined
  /// (1/w <= 0), for centroids of several samples, and if the contract allows several placements.
  std::optional<QuadDifference> quad_difference(std::size_t attribute, WindowAxis axis, int x,
                                                int y, int sample, float quad_share) const;

  /// Empty for a flat attribute, for an undefined value, or if several placements are possible.
  std::optional<Conditioning> conditioning(std::size_t attribute, int x, int y, int sample) const;

  /// The errors of computed values, for the judge.
  const ValueErrors& errors() const;
  const TriangleSetup& setup() const { return *setup_; }

 private:
  const TriangleValues& values() const;

  std::unique_ptr<TriangleSetup> setup_;
  mutable std::unique_ptr<TriangleValues> values_;  ///< made when first asked for
  mutable std::unique_ptr<ValueErrors> errors_;     ///< made when first asked for
};

}  // namespace rastercheck::oracle
