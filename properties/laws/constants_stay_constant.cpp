// Constants stay constant: an attribute that has the same value at all three vertices has it
// everywhere, to the bit.
//
// How far that follows from the contract. A bound of b scale ULP, one half of it for the rounding
// to float32, promises a result before rounding that is off by less than e = b − 1/2. Where e < 1/4
// rounding to nearest gives the constant back: neighbouring floats are an ulp away, or half an ulp
// below a power of two, so that the nearest middle between floats is 1/4 ulp from the constant.
// Where the promise is weaker, as towards the horizon, nothing is judged, unless the contract
// promises to keep constants, whatever the bound.
//
// Attributes: smooth and noperspective ones, at every location; flat ones are copies anyhow.
// Samples: those that are required, so that no snapped or clipped outline has a say.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <utility>

#include "oracle/transform.h"
#include "oracle/ulp.h"
#include "properties/generator.h"
#include "properties/internal/drawn_fragments.h"
#include "properties/internal/random_state.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

using oracle::Rational;
using records::AttributeKind;
using records::FragmentClass;

/// b with b − 1/2 < 1/4, exclusive.
constexpr double kMostBound = 0.75;

bool is_same_float(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

bool is_constant(const cases::Case& c, const cases::Triangle& triangle, std::size_t attribute) {
  const float first = c.attributes_of(triangle[0])[attribute];
  return is_same_float(first, c.attributes_of(triangle[1])[attribute]) &&
         is_same_float(first, c.attributes_of(triangle[2])[attribute]);
}

/// Whether the promise is strong enough anywhere: g >= 1 but for extrapolated centres.
bool may_be_exact(const cases::ValueBound& bound) {
  return double{bound.constant} + double{bound.per_horizon} < kMostBound;
}

/// Indices of what of one triangle the law speaks about.
std::vector<std::uint32_t> constants_of(const cases::Case& c, const cases::Contract& contract,
                                        std::size_t index) {
  const cases::Triangle& triangle = c.triangles[index];
  std::vector<std::uint32_t> constants;
  for (std::uint32_t a = 0; a < c.attributes.size(); ++a) {
    const cases::Interpolation interpolation = c.attributes[a].interpolation;
    if (interpolation == cases::Interpolation::flat) continue;
    const bool is_smooth = interpolation == cases::Interpolation::smooth;
    const cases::ValueBound& bound =
        is_smooth ? contract.bounds.smooth : contract.bounds.noperspective;
    const bool is_kept = contract.keeps_constants || may_be_exact(bound);
    if (is_kept && is_constant(c, triangle, a)) constants.push_back(a);
  }
  return constants;
}

FragmentClass class_of_constant(float actual, float expected) {
  if (is_same_float(actual, expected)) return FragmentClass::correct;
  return class_of_wrong(
      actual, actual == expected ? FragmentClass::wrong_sign_of_zero : FragmentClass::beyond_bound);
}

/// One triangle with its constants.
struct Subject {
  Subject(const oracle::SceneTruth& scene, std::uint32_t triangle)
      : constants(constants_of(scene.source(), scene.contract(), triangle)),
        truth(scene, triangle) {}
  std::vector<std::uint32_t> constants;
  oracle::TriangleTruth truth;
};

/// Where a fragment is.
struct Place {
  std::uint32_t triangle = 0;
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t sample = 0;
};

class ConstantsCheck {
 public:
  ConstantsCheck(const oracle::SceneTruth& scene, const cases::Framebuffer& drawn)
      : scene_(&scene), drawn_(&drawn) {
    const std::size_t triangles = scene.source().triangles.size();
    check_.is_applicable = false;
    for (std::uint32_t t = 0; t < triangles; ++t) {
      if (!constants_of(scene.source(), scene.contract(), t).empty()) {
        check_.is_applicable = true;
      }
    }
  }

  Check run() {
    if (!check_.is_applicable) return std::move(check_);
    check_.judgement.errors[AttributeKind::coverage];
    for (std::size_t i = 0; i < drawn_->size(); ++i) check_fragment(i);
    add_state_labels(scene_->source(), triangles_, labels_);
    check_.labels.assign(labels_.begin(), labels_.end());
    return std::move(check_);
  }

 private:
  /// Whether a fragment is of the case at all; what is not is a matter of coverage.
  bool is_of_case(const Place& place) const {
    const cases::Case& c = scene_->source();
    return place.triangle < c.triangles.size() && std::cmp_less(place.x, c.framebuffer.width) &&
           std::cmp_less(place.y, c.framebuffer.height) &&
           std::cmp_less(place.sample, c.framebuffer.samples);
  }

  Subject& subject_of(std::uint32_t triangle) {
    // Fragments come by triangle: one is enough, and meshes have many.
    if (!subject_ || subject_triangle_ != triangle) {
      subject_ = std::make_unique<Subject>(*scene_, triangle);
      subject_triangle_ = triangle;
    }
    return *subject_;
  }

  void check_fragment(std::size_t i) {
    const Place place{drawn_->triangle[i], drawn_->x[i], drawn_->y[i], drawn_->sample[i]};
    if (!is_of_case(place)) return;
    Subject& subject = subject_of(place.triangle);
    if (subject.constants.empty()) return;
    const records::SampleVerdict decision = subject.truth.judge(
        static_cast<int>(place.x), static_cast<int>(place.y), static_cast<int>(place.sample));
    if (decision.verdict != records::Verdict::required) return;
    ++check_.judgement.counts.required;
    ++check_.judgement.errors[AttributeKind::coverage].classes[FragmentClass::correct];
    triangles_.insert(place.triangle);
    if (decision.reason != records::Reason::inside) {
      labels_.emplace(records::to_string(decision.reason));
    }
    for (const std::uint32_t a : subject.constants) {
      check_attribute(subject, place, a, drawn_->attributes_of(i)[a]);
    }
  }

  void check_attribute(const Subject& subject, const Place& place, std::uint32_t attribute,
                       float actual) {
    const auto x = static_cast<int>(place.x);
    const auto y = static_cast<int>(place.y);
    const auto s = static_cast<int>(place.sample);
    if (subject.truth.is_value_free(attribute)) return;
    const cases::Case& c = scene_->source();
    const cases::Attribute& declared = c.attributes[attribute];
    const bool may_be_undefined = declared.location == cases::Location::center;
    if (may_be_undefined && !subject.truth.attribute(attribute, x, y, s)) return;
    const auto promised = subject.truth.value_bound(attribute, x, y, s);
    const auto bound = promised ? std::optional(promised->enclosure()) : std::nullopt;
    const bool is_within_reach = bound && bound->hi < kMostBound;
    if (!is_within_reach && !scene_->contract().keeps_constants) {
      labels_.emplace("bound too wide");
      return;
    }

    labels_.emplace("constant attribute");
    const float expected = c.attributes_of(c.triangles[place.triangle][0])[attribute];
    if (expected == 0) labels_.emplace("constant zero");
    const AttributeKind kind = declared.interpolation == cases::Interpolation::smooth
                                   ? AttributeKind::smooth
                                   : AttributeKind::noperspective;
    const FragmentClass found = class_of_constant(actual, expected);
    ++check_.judgement.errors[kind].classes[found];
    if (found == FragmentClass::correct) return;
    const Rational exact{double{expected}};
    records::Violation violation = violation_at(place, kind, found, actual);
    violation.attribute = attribute;
    violation.exact = exact.to_string();
    violation.bound = bound;
    if (std::isfinite(actual)) {
      violation.error =
          oracle::scale_ulp_error(actual, exact, subject.truth.attribute_magnitude(attribute));
    }
    violation.note = "all three vertices have " + value_text(expected);
    note(check_, violation);
  }

  static records::Violation violation_at(const Place& place, AttributeKind kind,
                                         FragmentClass found, float actual) {
    records::Violation violation;
    violation.fragment_class = found;
    violation.kind = kind;
    violation.triangle = place.triangle;
    violation.x = place.x;
    violation.y = place.y;
    violation.sample = place.sample;
    violation.actual = value_text(actual);
    return violation;
  }

  const oracle::SceneTruth* scene_;
  const cases::Framebuffer* drawn_;
  Check check_;
  std::set<std::string> labels_;
  std::set<std::uint32_t> triangles_;
  std::unique_ptr<Subject> subject_;
  std::uint32_t subject_triangle_ = 0;
};

Result<Check> check(const cases::Case& c, backends::Backend& backend,
                    const CheckOptions& /*options*/) {
  const Result<cases::Case> clip = oracle::to_clip_case(c, "");
  if (!clip) return tl::unexpected(clip.error());
  const Result<cases::Framebuffer> drawn = draw(*clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  const oracle::SceneTruth scene(*clip, backend.contract(*clip));
  return ConstantsCheck(scene, *drawn).run();
}

float random_constant(Draw& draw) {
  switch (draw.between(0, 7)) {
    case 0:
      return 0.0F;
    case 1:
      return -0.0F;
    case 2:
      return -1.0F;
    case 3:
      return draw.spread(-149, -120);
    case 4:
      return draw.spread(100, 127);
    case 5:  // a power of two, below which floats are twice as close, or a float beside one
      return draw.pick(std::array{1.0F, 0x1.fffffep-1F, 0x1.000002p+0F, -0x1p20F, 0x1p-20F});
    default:
      return draw.spread(-8, 8);
  }
}

/// Gives most attributes one value at all vertices; in a third of the cases snapped vertices, which
/// clipping makes more of.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  ensure_attribute(c);
  const std::size_t count = c.attributes.size();
  for (std::size_t a = 0; a < count; ++a) {
    if (a > 0 && draw.one_in(4)) continue;
    const float constant = random_constant(draw);
    for (std::size_t v = 0; v < c.positions.size(); ++v) {
      c.attribute_values[v * count + a] = constant;
    }
  }
  if (draw.one_in(3)) {
    c.coverage = cases::Snapping{draw.between(4, cases::kMaxSubpixelBits)};
    c.basis = draw.pick(std::array{cases::Basis::ideal, cases::Basis::snapped});
  }
  return made;
}

const LawRegistration kRegistration(
    {.name = "constants stay constant",
     .reason = "Σ c e_i / Σ e_i is c, and a bound below 3/4 scale ULP leaves no other float.",
     .exceptions = "values whose bound is wider than that, unless the contract promises to keep "
                   "constants; flat attributes, which are copies",
     .generate = &generate,
     .check = &check});

}  // namespace
}  // namespace rastercheck::properties
