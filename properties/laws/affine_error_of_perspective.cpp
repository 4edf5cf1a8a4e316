// An affine value differs from the perspective value by no more than the w of the vertices allow:
//
//   |f − r| <= κ (max r_i − min r_i) + bound,     κ = (√ρ − 1)/(√ρ + 1),   ρ = max w_i / min w_i
//
// where f should be the affine Σ λ_i r_i, r = Σ b_i r_i is the perspective value, and all w_i > 0.
//
// b_i = (λ_i/w_i)/Σ(λ_j/w_j). r − Σ λ_i r_i = Σ (b_i − λ_i) r_i. Since Σ (b_i − λ_i) = 0, the
// difference is at most the range of the r_i times the sum of the positive b_i − λ_i. Let λ be the
// sum of the λ_i for which b_i − λ_i is positive. Replace their vertices by one point whose 1/w is
// the weighted mean of their 1/w, and replace the other vertices by a second point in the same way.
// If ρ' is the ratio of the two w, 1 <= ρ' <= ρ, then
//
//   b − λ = λ (1 − λ)(ρ' − 1)/(λ ρ' + 1 − λ).
//
// Its derivative in λ is 0 if λ² ρ' = (1 − λ)², that is for λ = 1/(√ρ' + 1). There, b − λ is κ for
// the ratio ρ', and κ grows with ρ'. An edge whose ends have the extreme w and r attains the bound
// (Appendix 5, A 6.3; Heckbert & Moreton 1991, §2.1: the rubber sheet).
//
// Computed in double, κ = (max w − min w)/(√max w + √min w)² has a relative error of a few 2^-53.
//
// Samples: required ones of triangles entirely in front of the eye. Attributes: smooth ones at
// samples and centroids, and at centres if the pixel has one sample; elsewhere λ_i may be negative.

#include <algorithm>
#include <array>
#include <cmath>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_values.h"
#include "properties/laws/internal/value_findings.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::affine_error_of_perspective_law {
namespace {

using cases::Interpolation;
using cases::Location;

// --- The law -------------------------------------------------------------------------------------

/// κ of a triangle, rounded up.
double greatest_share(const cases::Case& c, const cases::Triangle& triangle) {
  const auto w = [&](std::size_t i) { return double{c.positions[triangle[i]].w}; };
  const auto [least, greatest] = std::minmax({w(0), w(1), w(2)});
  const double roots = std::sqrt(least) + std::sqrt(greatest);
  return (greatest - least) / (roots * roots) * (1 + 0x1p-48);
}

double range_of(const cases::Case& c, const cases::Triangle& triangle, std::uint32_t attribute) {
  const auto r = [&](std::size_t i) { return double{c.attributes_of(triangle[i])[attribute]}; };
  const auto [least, greatest] = std::minmax({r(0), r(1), r(2)});
  return greatest - least;
}

cases::Contract in_perspective(cases::Contract contract) {
  contract.claims = cases::Claim::perspective;
  return contract;
}

class AffineErrorCheck {
 public:
  AffineErrorCheck(const cases::Case& c, const cases::Contract& contract,
                   const cases::Fragments& drawn)
      : case_(&c),
        drawn_(&drawn),
        findings_(c, contract),
        perspective_(c, in_perspective(contract)) {}

  Check run() {
    for (std::size_t i = 0; i < drawn_->size(); ++i) {
      const cases::SamplePlace place = drawn_->place_of(i);
      if (!is_of_case(*case_, place)) continue;
      const cases::Triangle& triangle = case_->triangles[place.triangle];
      if (!all_in_front(*case_, triangle)) continue;
      const double share = greatest_share(*case_, triangle);
      for (std::uint32_t a = 0; a < case_->attributes.size(); ++a) {
        if (!is_inside(case_->attributes[a])) continue;
        check_value(place, a, share * range_of(*case_, triangle, a), drawn_->attributes_of(i)[a]);
      }
    }
    return findings_.finish();
  }

 private:
  bool is_inside(const cases::Attribute& attribute) const {
    return attribute.interpolation == Interpolation::smooth &&
           (attribute.location != Location::center || case_->framebuffer.samples == 1);
  }

  void check_value(const cases::SamplePlace& place, std::uint32_t attribute, double most,
                   float actual) {
    const std::optional<ValuePromise> promise = findings_.promise_of(place, attribute);
    const auto exact = perspective_.truth(place.triangle)
                           .attribute(attribute, static_cast<int>(place.x),
                                      static_cast<int>(place.y), static_cast<int>(place.sample));
    if (!promise || !exact) return;
    findings_.see(place, attribute);
    const double lo = exact->lo.enclosure().lo;
    const double hi = exact->hi.enclosure().hi;
    const double off = std::max(double{actual} - hi, lo - double{actual});
    if (most > 0 && off >= kNear * most) findings_.label("near what w allows");
    if (off <= most + promise->bound * promise->unit) return;
    findings_.report(place, attribute, actual,
                     "[" + value_text(static_cast<float>(lo - most)) + ", " +
                         value_text(static_cast<float>(hi + most)) + "]",
                     "farther from the perspective value than the ratio of w allows");
  }

  static constexpr double kNear = 0.9;

  const cases::Case* case_;
  const cases::Fragments* drawn_;
  ValueFindings findings_;
  Verdicts perspective_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  return check_drawn(c, backend, [](const cases::Case& clip, const backends::Drawn& drawn) {
    if (drawn.contract.claims != cases::Claim::affine)
      return not_applicable("the backend claims perspective-correct values");
    return AffineErrorCheck(clip, drawn.contract, drawn.fragments).run();
  });
}

/// True if the backend claims that smooth values are affine, even if only for unclipped triangles.
bool is_promised(backends::Backend& backend) {
  return backend.contract({}).claims == cases::Claim::affine;
}

// --- Its cases -----------------------------------------------------------------------------------

/// Makes triangles in front of the eye. Two vertices of each triangle have the extreme w and the
/// extreme values of attribute 0.
Generated generate(Draw& draw) {
  Generated made{random_state(draw), ""};
  cases::Case& c = made.source;
  for (cases::Attribute& attribute : c.attributes) attribute.interpolation = Interpolation::smooth;
  ensure_attribute(draw, c);
  c.attributes[0].interpolation = Interpolation::smooth;
  const int most = draw.pick(std::array{1, 4, 16, 1024});
  made.stratum = "w up to " + std::to_string(most);
  const int triangles = draw.between(1, 2 + draw.size() / 50);
  const std::size_t others = c.attributes.size() - 1;
  c.attribute_values.clear();
  for (int i = 0; i < triangles; ++i) {
    const float nearest = draw.uniform(1, 2);
    const float farthest = nearest * static_cast<float>(most);
    const float middle = draw.one_in(2) ? nearest : farthest;
    for (const float w : {nearest, farthest, middle}) {
      const WindowPoint p = point_about(draw, c);
      const float depth = random_depth(draw, c);
      add_vertex(c, at_window(c, p, depth, w));
      c.attribute_values.push_back(w == nearest ? 0.0F : 1.0F);
      for (std::size_t a = 0; a < others; ++a) {
        const float value = draw.uniform(-1, 1);
        c.attribute_values.push_back(value);
      }
    }
  }
  add_separate_triangles(c);
  add_clip_distances(draw, c);
  return made;
}

const LawRegistration kRegistration(
    {.id = "affine-values-are-off-perspective-by-no-more-than-w-allows",
     .sentence = "affine values are off perspective by no more than w allows",
     .reason = "A mean of two values with weights λ and 1 − λ, and one with weights divided by w, "
               "differ by at most (√ρ − 1)/(√ρ + 1) of their difference, ρ the ratio of the w.",
     .exceptions =
         "backends that claim perspective; triangles with some w <= 0; centres of several "
         "samples, which may lie outside",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend does not claim affine values",
     .covers = {cover(5, "near what w allows")}});

}  // namespace
}  // namespace rastercheck::properties::affine_error_of_perspective_law
