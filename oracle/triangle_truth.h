#pragma once

// The exact truth of one triangle of a case: the verdict of every sample, the values a fragment may
// have, and how far from the decision it was. What it implements is RULES §1–§5; what it does not
// do is draw: it answers for one sample at a time, from nothing but the case.

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
#include "records/judgement.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

class Scene;
struct TriangleSetup;
class TriangleValues;
class ValueErrors;

/// A case with its clip positions in exact numbers, shared by its triangles. Clip positions of a
/// case with a camera are projection · view · model · position without rounding.
class SceneTruth {
 public:
  /// Promises of single triangles count only where they are one for each of the case's.
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

/// Derivatives, and the sizes of the terms that they are differences of (cases::Contract):
/// max|r_i| Σ|∂E_i/∂u| / Σ E_i of a smooth attribute, Σ|r_i w_i ∂E_i/∂u| / Σ w_i E_i of a
/// noperspective one, 0 of a flat one.
struct ScaledDerivatives {
  Derivatives exact;
  Derivatives scale;
};

/// A computed derivative: correct, beyond the bound, infinite or NaN.
struct JudgedDerivative {
  records::FragmentClass fragment_class = records::FragmentClass::correct;
  /// Signed, in ulp(max(|exact|, scale)); nothing of an infinity and of NaN.
  std::optional<records::Enclosure> error;
};

enum class WindowAxis { x, y };

/// The difference r(odd) − r(even) between the two pixels of an even-aligned 2×2 quad that lie side
/// by side, as a fragment of either has it (cases::Contract::quad_share).
struct QuadDifference {
  Rational exact;
  Rational allowed;                 ///< quad_share (M + g M'); 0 of a flat attribute
  bool is_next_to_horizon = false;  ///< g > cases::kMostQuadHorizon: nothing is promised
};

/// How errors are amplified at a fragment (RULES §5); nothing where the divisor is 0. A smooth
/// attribute's terms are n_i = r_i, a noperspective one's n_i = r_i w_i.
struct Conditioning {
  std::optional<Rational> kappa;    ///< Σ|n_i e_i| / |Σ n_i e_i|: relative errors of the weights
  std::optional<Rational> kappa_d;  ///< max_i(|A_i u| + |B_i v| + |C_i|)/D: cancellation in them
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

  /// The pixels whose samples may be other than forbidden.
  PixelBox pixels() const;

  /// sign(det M): +1, −1, or 0 for a triangle seen edge-on (it covers nothing).
  int orientation() const;

  /// Q = M^-1 (RULES §1) of the exact vertices; nothing where det M = 0.
  std::optional<QMatrix> q_matrix() const;

  /// e = Q (u, v, 1) at a sample, whose sum is 1/w; nothing where det M = 0.
  std::optional<std::array<Rational, 3>> edges(int x, int y, int sample) const;

  /// Whether no vertex is clipped and the triangle turns the same way however the contract lets it
  /// be placed.
  bool has_certain_orientation() const;

  records::SampleVerdict judge(int x, int y, int sample) const;

  /// The signed distance to the boundary that decided, in pixels, positive inside: certified
  /// enclosure of an irrational number. Nothing for a triangle without orientation.
  std::optional<records::Enclosure> distance(int x, int y, int sample) const;

  /// The values that a fragment there may have; nothing where the rules leave them undefined (a
  /// centre behind the horizon). For samples that are not forbidden.
  std::optional<ValueRange> depth(int x, int y, int sample) const;
  std::optional<ValueRange> attribute(std::size_t attribute, int x, int y, int sample) const;

  /// Whether an implementation may give an attribute, or the depth where `attribute` is nothing,
  /// any value: the APIs leave it open (RULES §3), of noperspective where some w_i <= 0, and of
  /// smooth that is claimed to be the same; or the contract promises nothing of it. `attribute`
  /// gives the continuation then.
  bool is_value_free(std::optional<std::size_t> attribute) const;

  /// The most that a value may be beyond what the contract leaves open, in scale ULP: of an
  /// attribute, or of the depth where `attribute` is nothing. Nothing where no bound is promised,
  /// as 1/w <= 0 where the value is evaluated. Where that is one of several points, the greatest.
  std::optional<Rational> value_bound(std::optional<std::size_t> attribute, int x, int y,
                                      int sample) const;

  /// The number scale ULP are measured by: max |r_i|.
  Rational attribute_magnitude(std::size_t attribute) const;

  /// Analytic screen derivatives of a smooth or noperspective attribute (zero of a flat one).
  /// Nothing where the value is undefined or the contract leaves several placements.
  std::optional<Derivatives> derivatives(std::size_t attribute, int x, int y, int sample) const;

  /// The same where the attribute is evaluated, with what their errors are measured by. Nothing,
  /// besides, where that place is open: of a centroid under OpenGL and Vulkan with several samples,
  /// under D3D where coverage leaves several samples open.
  std::optional<ScaledDerivatives> scaled_derivatives(std::size_t attribute, int x, int y,
                                                      int sample) const;

  /// Computed ∂r/∂u and ∂r/∂v against these, decided exactly; the bound is in the errors' unit. An
  /// infinity stands for 2^128; it is correct where the exact value lies beyond that.
  std::optional<std::array<JudgedDerivative, 2>> judge_derivatives(
      std::size_t attribute, int x, int y, int sample, std::span<const float, 2> computed,
      float bound) const;

  /// What an API's dFdx or dFdy is for the fragment at (x, y), and how far it may be off: the
  /// difference along an axis across the even-aligned 2×2 quad of pixels that holds (x, y); helper
  /// pixels extrapolate. Nothing where either value is undefined (1/w <= 0 there), of centroids of
  /// several samples, and where the contract leaves several placements.
  std::optional<QuadDifference> quad_difference(std::size_t attribute, WindowAxis axis, int x,
                                                int y, int sample, float quad_share) const;

  /// Nothing of a flat attribute, of an undefined value, or where several placements are open.
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
