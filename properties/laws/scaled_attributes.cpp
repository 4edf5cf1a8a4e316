// A scaled and moved attribute is scaled and moved: vertices with α r_i + β in place of r_i give
// fragments with α f + β in place of f, within the bounds of both drawings, and to the bit if β is
// 0. α is ± a power of two.
//
// Why. r = Σ r_i e_i / Σ e_i is a mean with weights that do not depend on r (RULES §1), so Σ (α r_i
// + β) e_i / Σ e_i = α r + β; a noperspective mean behaves alike, and flat values are copies.
// Coverage and depth do not depend on attributes: both stay the same to the bit.
//
// How far. Let U be the unit of scale ULP (RULES §5) and b the contract's bound, and let primes
// mark the drawing of α r_i + β. Then f is within b U of some value r in the range that the
// contract leaves open, lo <= r <= hi, and f' is within b U' of α r' + β for some r' in the same
// range. So, exactly,
//
//   |f' − (α f + β)| <= b U' + |α| b U + |α| (hi − lo)
//
// Under a contract that names one triangle, lo and hi are the same, and r of a covered sample is
// between the r_i: U = ulp(max|r_i|). Otherwise, or if b varies, the oracle finds lo, hi and b for
// some fragments. Then U = ulp(max(|r_i|, |lo|, |hi|)), and U' likewise for α r + β. All
// comparisons use exact sums.
//
// With β = 0, rounding commutes with powers of two and with the sign, whatever the weights are and
// however the mean is formed, as long as no exponent overflows or underflows. So if every r_i is 0
// or 2^-40 <= |r_i| <= 2^40, values above 2^-100 in magnitude must agree to the bit; zeros of
// either sign are the same.
//
// α and β are pseudorandom (choices.h), separately for each attribute. All α r_i + β must be
// float32 without rounding; else β becomes 0. If some α r_i would still be rounded, the attribute
// stays unchanged. Not judged: values that the rules leave free or undefined, and moved values if
// the bound has a share of the vertices' range, since moving changes the size of that share in
// ulps.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "properties/choices.h"
#include "properties/exact_sum.h"
#include "properties/float_numbers.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/drawn_values.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/random_state.h"

namespace rastercheck::properties::scaled_attributes_law {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// Limits for |r_i| and for |f| of values that must scale to the bit.
constexpr double kLeastOfBits = 0x1p-40;
constexpr double kMostOfBits = 0x1p40;
constexpr double kLeastValueOfBits = 0x1p-100;
/// Beyond this limit, a value within the bound may be infinite.
constexpr double kMostMoved = 0x1p126;
/// The oracle is asked for few fragments, since finding ranges takes far longer than sums.
constexpr std::size_t kMostAsked = 16;

/// α r + β.
struct Affine {
  double alpha = 1;
  double beta = 0;

  bool is_identity() const { return alpha == 1 && beta == 0; }
  /// Returns the mapped value if a float32 holds it exactly.
  std::optional<float> of(float r) const {
    const auto sum = exact_sum(alpha * double{r}, beta);
    if (!sum || !is_float(*sum)) return std::nullopt;
    return static_cast<float>(*sum);
  }
};

bool is_exact(const cases::Case& c, std::size_t attribute, const Affine& map) {
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    if (!map.of(c.attributes_of(v)[attribute])) return false;
  }
  return true;
}

Affine map_of(const cases::Case& c, std::size_t attribute, Choices& choices) {
  constexpr std::array kAlphas{-4.0, -2.0, -1.0, -0.5, -0.0625, 0.125, 0.5, 2.0, 4.0, 16.0};
  Affine map;
  map.alpha = choices.pick(kAlphas);
  if (choices.below(3) > 0) map.beta = (static_cast<double>(choices.below(257)) - 128) / 4;
  if (is_exact(c, attribute, map)) return map;
  map.beta = 0;
  return is_exact(c, attribute, map) ? map : Affine{};
}

std::vector<Affine> maps_of(const cases::Case& c) {
  Choices choices(choices_of(c));
  std::vector<Affine> maps;
  // A hash has enough choices for few attributes, so each group of four attributes gets its own.
  for (std::size_t a = 0; a < c.attributes.size(); ++a) {
    if (a % 4 == 0) choices = Choices(choices_of(c) + a);
    maps.push_back(map_of(c, a, choices));
  }
  return maps;
}

cases::Case changed_case(const cases::Case& c, const std::vector<Affine>& maps) {
  cases::Case changed = c;
  const std::size_t count = c.attributes.size();
  for (std::size_t i = 0; i < changed.attribute_values.size(); ++i) {
    float& value = changed.attribute_values[i];
    value = maps[i % count].of(value).value_or(value);
  }
  return changed;
}

/// The values that the contract allows: those within `bound` units of some r with lo <= r <= hi.
struct Allowed {
  double lo = 0;
  double hi = 0;
  double bound = 0;
  bool is_open = false;  ///< else lo and hi enclose a single r
};

/// The greatest magnitudes of the value and of the moved value, at the sample or at a vertex.
struct Greatest {
  double value = 0;
  double moved = 0;
};

class AffinityCheck {
 public:
  AffinityCheck(const cases::Case& c, const cases::Contract& contract, std::vector<Affine> maps,
                const cases::Fragments& before, const cases::Fragments& drawn)
      : case_(&c),
        contract_(contract),
        maps_(std::move(maps)),
        before_(&before),
        drawn_(&drawn),
        verdicts_(c, contract),
        tally_(c) {}

  Check run() {
    std::vector<Pair> same;
    visit_places(
        *before_, *drawn_,
        [&](const cases::SamplePlace& place, std::size_t was, std::size_t now) {
          if (!is_of_case(*case_, place)) return;
          same.push_back({was, now});
          tally_.see(place.triangle);
        },
        [&](const cases::SamplePlace& place, std::size_t /*now*/, const char* exact) {
          tally_.report(violation_at(place, FragmentClass::extra, exact, kNote));
        },
        [&](const cases::SamplePlace& place) {
          tally_.report(violation_at(place, FragmentClass::missing, kDrawnBefore, kNote));
        });
    tally_.counts().required = before_->size();
    for (const Pair& pair : same) compare(pair);
    for (const Pair& pair : some_of(same, kMostAsked)) ask(pair);
    return tally_.finish();
  }

 private:
  static constexpr const char* kNote = "with other attribute values";

  /// Fragments of the two drawings at the same place.
  struct Pair {
    std::size_t before = 0;
    std::size_t now = 0;
  };

  const cases::Triangle& triangle_at(const cases::SamplePlace& place) const {
    return case_->triangles[place.triangle];
  }

  /// max |r_i| of the triangle, with r_i mapped by `map`.
  double magnitude(const cases::SamplePlace& place, std::size_t a, const Affine& map) const {
    double most = 0;
    for (const std::uint32_t v : triangle_at(place)) {
      const double r = case_->attributes_of(v)[a];
      most = std::max(most, std::abs(map.alpha * r + map.beta));
    }
    return most;
  }

  bool is_free(const cases::SamplePlace& place, std::size_t a) const {
    return contract_.is_affine(case_->attributes[a].interpolation) &&
           !all_in_front(*case_, triangle_at(place));
  }

  bool has_bits(const cases::SamplePlace& place, std::size_t a) const {
    return std::all_of(triangle_at(place).begin(), triangle_at(place).end(), [&](std::uint32_t v) {
      const double r = std::abs(double{case_->attributes_of(v)[a]});
      return r == 0 || (r >= kLeastOfBits && r <= kMostOfBits);
    });
  }

  /// True if the contract names a single triangle, a single point of it, and the same bound
  /// everywhere.
  bool is_simple(std::size_t a) const {
    const bool is_at_sample =
        case_->attributes[a].location == cases::Location::sample || case_->framebuffer.samples == 1;
    return !contract_.coverage && contract_.basis == cases::Basis::ideal && is_at_sample &&
           bound_of(a).is_constant();
  }

  const cases::ValueBound& bound_of(std::size_t a) const {
    const bool is_smooth = case_->attributes[a].interpolation == cases::Interpolation::smooth;
    const cases::ValueBounds& bounds = contract_.bounds;
    return is_smooth ? bounds.smooth : bounds.noperspective;
  }

  /// Compares everything that needs no oracle.
  void compare(const Pair& pair) {
    const auto [was, i] = pair;
    const cases::SamplePlace place = drawn_->place_of(i);
    bool is_right = true;
    if (!is_same(before_->depth[was], drawn_->depth[i])) {
      is_right = false;
      report_value(place, AttributeKind::depth, before_->depth[was], drawn_->depth[i], kNote);
    }
    for (std::uint32_t a = 0; a < maps_.size(); ++a) {
      const Affine& map = maps_[a];
      const float f = before_->attributes_of(was)[a];
      const float actual = drawn_->attributes_of(i)[a];
      if (case_->attributes[a].interpolation == cases::Interpolation::flat) {
        const auto expected = static_cast<float>(map.alpha * double{f} + map.beta);
        is_right = expect_same(place, a, expected, actual, "flat") && is_right;
      } else if (map.is_identity() || is_free(place, a) || !std::isfinite(f)) {
        continue;
      } else if (map.beta == 0 && has_bits(place, a)) {
        const double expected = map.alpha * double{f};
        // A zero may be a value that has underflowed.
        if (f != 0 && std::abs(expected) < kLeastValueOfBits) continue;
        if (f == 0 && std::abs(actual) < kLeastValueOfBits) continue;
        is_right =
            expect_same(place, a, static_cast<float>(expected), actual, "scaled") && is_right;
      } else if (is_simple(a)) {
        const Greatest greatest{magnitude(place, a, {}), magnitude(place, a, map)};
        is_right = expect_within(place, a, f, actual, {0, 0, double{bound_of(a).constant}, false},
                                 greatest) &&
                   is_right;
      }
    }
    if (is_right) tally_.pass(AttributeKind::coverage);
  }

  /// Compares the attributes that need the oracle's ranges.
  void ask(const Pair& pair) {
    const cases::SamplePlace place = drawn_->place_of(pair.now);
    for (std::uint32_t a = 0; a < maps_.size(); ++a) {
      const bool is_flat = case_->attributes[a].interpolation == cases::Interpolation::flat;
      const float f = before_->attributes_of(pair.before)[a];
      if (is_flat || is_simple(a) || is_free(place, a) || maps_[a].is_identity()) continue;
      if (!std::isfinite(f) || (maps_[a].beta == 0 && has_bits(place, a))) continue;
      if (maps_[a].beta != 0 && bound_of(a).range_share > 0) continue;
      const auto x = static_cast<int>(place.x);
      const auto y = static_cast<int>(place.y);
      const auto s = static_cast<int>(place.sample);
      const oracle::TriangleTruth& truth = verdicts_.truth(place.triangle);
      if (truth.judge(x, y, s).verdict == records::Verdict::forbidden) continue;
      const auto range = truth.attribute(a, x, y, s);
      const auto bound = truth.value_bound(a, x, y, s);
      if (!range || !bound) continue;
      const double lo = range->lo.enclosure().lo;
      const double hi = range->hi.enclosure().hi;
      // A value may exceed its vertices' values when the moved value does not, and vice versa.
      // Rounding α lo + β to double cannot take it below a power of two, so its ulp is never
      // smaller than that of the exact number.
      const Affine& map = maps_[a];
      const Greatest greatest{
          std::max({magnitude(place, a, {}), std::abs(lo), std::abs(hi)}),
          std::max({magnitude(place, a, map), std::abs(map.alpha * lo + map.beta),
                    std::abs(map.alpha * hi + map.beta)})};
      expect_within(place, a, f, drawn_->attributes_of(pair.now)[a],
                    {lo, hi, bound->enclosure().hi, range->is_open}, greatest);
    }
  }

  bool expect_same(const cases::SamplePlace& place, std::uint32_t a, float expected, float actual,
                   const char* label) {
    tally_.label(label);
    if (is_same(expected, actual)) return true;
    const AttributeKind kind = records::kind_of(case_->attributes[a].interpolation);
    report_value(place, kind, expected, actual, note_of(maps_[a]), a);
    return false;
  }

  /// |f' − (α f + β)| <= b U' + |α| (b U + hi − lo).
  bool expect_within(const cases::SamplePlace& place, std::uint32_t a, float f, float actual,
                     const Allowed& allowed, const Greatest& greatest) {
    const Affine& map = maps_[a];
    const double alpha = std::abs(map.alpha);
    if (greatest.moved >= kMostMoved) return true;
    tally_.label(map.beta == 0 ? "scaled" : "scaled and moved");
    if (allowed.is_open) tally_.label("open value");
    const double unit_moved = ulp_of(greatest.moved);
    const auto is_beyond = [&](double sign) {
      const std::array terms{sign * double{actual},
                             -sign * map.alpha * double{f},
                             -sign * map.beta,
                             -allowed.bound * unit_moved,
                             -allowed.bound * alpha * ulp_of(greatest.value),
                             -alpha * allowed.hi,
                             alpha * allowed.lo};
      return sign_of_sum(terms) > 0;
    };
    if (std::isfinite(actual) && !is_beyond(1) && !is_beyond(-1)) return true;
    const AttributeKind kind = records::kind_of(case_->attributes[a].interpolation);
    const auto expected = static_cast<float>(map.alpha * double{f} + map.beta);
    report_value(place, kind, expected, actual,
                 note_of(map) + ", within the bounds of both drawings", a);
    return false;
  }

  static std::string note_of(const Affine& map) {
    return fmt::format("{} r + {}, for the original value r", map.alpha, map.beta);
  }

  void report_value(const cases::SamplePlace& place, AttributeKind kind, float expected,
                    float actual, const std::string& note,
                    std::optional<std::uint32_t> attribute = {}) {
    tally_.report(violation_at(place, class_of(actual, expected), value_text(expected), note,
                               {kind, attribute, actual}));
  }

  const cases::Case* case_;
  cases::Contract contract_;
  std::vector<Affine> maps_;  ///< [attribute]
  const cases::Fragments* before_;
  const cases::Fragments* drawn_;
  Verdicts verdicts_;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  std::vector<Affine> maps = maps_of(clip);
  const bool is_changed =
      std::any_of(maps.begin(), maps.end(), [](const Affine& map) { return !map.is_identity(); });
  if (!is_changed) return not_applicable("no attribute can be scaled or moved exactly");
  const cases::Case changed = changed_case(clip, maps);
  // Both drawings are judged by the same contract.
  const cases::Contract contract = backend.contract(clip);
  if (backend.contract(changed) != contract) {
    return not_applicable("the contract differs for the changed case");
  }
  const Result<backends::Drawn> before = draw_promised(clip, backend);
  if (!before) return tl::unexpected(before.error());
  const Result<backends::Drawn> drawn = draw_promised(changed, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  return AffinityCheck(clip, contract, std::move(maps), before->fragments, drawn->fragments).run();
}

/// Makes cases with at least one attribute. Most attributes have values of few bits, which can be
/// moved exactly.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  ensure_attribute(c);
  const std::size_t count = c.attributes.size();
  for (std::size_t a = 0; a < count; ++a) {
    if (a > 0 && draw.one_in(4)) continue;
    const int most = draw.pick(std::array{1, 16, 1024});
    for (std::size_t v = 0; v < c.positions.size(); ++v) {
      const int sixteenths = draw.between(-most, most);
      c.attribute_values[v * count + a] = static_cast<float>(sixteenths) / 16;
    }
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "a-scaled-and-moved-attribute-is-scaled-and-moved",
     .sentence = "a scaled and moved attribute is scaled and moved",
     .reason = "The weights of a mean know nothing of the attribute.",
     .exceptions = "attributes whose values cannot be scaled without rounding, values that the "
                   "rules leave free or undefined; backends that promise no invariance",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_invariantly,
     .unpromised = "the backend does not promise that irrelevant changes leave all bits unchanged",
     .excludes_outer = true,
     .covers = {cover(15, "scaled"), cover(25, "scaled and moved"), cover(5, "flat")}});

}  // namespace
}  // namespace rastercheck::properties::scaled_attributes_law
