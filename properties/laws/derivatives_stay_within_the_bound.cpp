// Screen derivatives stay within the bound: ∂r/∂u and ∂r/∂v of every attribute of what was rightly
// drawn are no farther from the exact ones than the contract says (cases::Contract), and are
// numbers. It follows from RULES §4, which make them as exact as the values are.
//
// Attributes: all that have one exact derivative, so not noperspective ones with some w <= 0, nor
// centroids where their place is open, nor any where the contract leaves several placements.
// Samples: those that are required; of a case with many fragments some that are spread evenly.

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "oracle/transform.h"
#include "properties/generator.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// At most so many fragments of a case are judged.
constexpr std::size_t kMostFragments = 64;

class DerivativesCheck {
 public:
  DerivativesCheck(const oracle::SceneTruth& scene, const cases::Framebuffer& drawn)
      : scene_(&scene), drawn_(&drawn) {
    const bool has_derivatives = drawn.size() == 0 || !drawn.derivatives.empty();
    check_.is_applicable =
        scene.contract().derivative_bound && !scene.source().attributes.empty() && has_derivatives;
  }

  Check run() {
    if (!check_.is_applicable) return std::move(check_);
    check_.judgement.errors[AttributeKind::coverage];
    const std::size_t judged = std::min(drawn_->size(), kMostFragments);
    for (std::size_t k = 0; k < judged; ++k) {
      // One of each of as many stretches, not always the same sample of a pixel.
      const std::size_t begin = k * drawn_->size() / judged;
      const std::size_t end = (k + 1) * drawn_->size() / judged;
      check_fragment(begin + k % (end - begin));
    }
    add_state_labels(scene_->source(), triangles_, labels_);
    check_.labels.assign(labels_.begin(), labels_.end());
    return std::move(check_);
  }

 private:
  /// Whether a fragment is of the case at all; what is not is a matter of coverage.
  bool is_of_case(std::size_t i) const {
    const cases::Case& c = scene_->source();
    return drawn_->triangle[i] < c.triangles.size() &&
           std::cmp_less(drawn_->x[i], c.framebuffer.width) &&
           std::cmp_less(drawn_->y[i], c.framebuffer.height) &&
           std::cmp_less(drawn_->sample[i], c.framebuffer.samples);
  }

  void check_fragment(std::size_t i) {
    if (!is_of_case(i)) return;
    const std::uint32_t triangle = drawn_->triangle[i];
    if (!truth_ || triangle_ != triangle) {
      truth_ = std::make_unique<oracle::TriangleTruth>(*scene_, triangle);
      triangle_ = triangle;
    }
    const records::SampleVerdict decision =
        truth_->judge(drawn_->x[i], drawn_->y[i], drawn_->sample[i]);
    if (decision.verdict != records::Verdict::required) return;
    ++check_.judgement.counts.required;
    ++check_.judgement.errors[AttributeKind::coverage].classes[FragmentClass::correct];
    triangles_.insert(triangle);
    if (decision.reason != records::Reason::inside) {
      labels_.emplace(records::to_string(decision.reason));
    }
    for (std::uint32_t a = 0; a < scene_->source().attributes.size(); ++a) check_attribute(i, a);
  }

  void check_attribute(std::size_t i, std::uint32_t attribute) {
    if (truth_->is_value_free(attribute)) return;
    const auto computed = drawn_->derivatives_of(i).subspan(std::size_t{attribute} * 2).first<2>();
    const auto judged =
        truth_->judge_derivatives(attribute, drawn_->x[i], drawn_->y[i], drawn_->sample[i],
                                  computed, *scene_->contract().derivative_bound);
    if (!judged) {
      labels_.emplace("no one derivative");
      return;
    }
    const AttributeKind kind =
        records::kind_of(scene_->source().attributes[attribute].interpolation);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const oracle::JudgedDerivative& one = (*judged)[axis];
      ++check_.judgement.errors[kind].classes[one.fragment_class];
      if (one.fragment_class == FragmentClass::correct) continue;
      records::Violation violation;
      violation.fragment_class = one.fragment_class;
      violation.kind = kind;
      violation.triangle = drawn_->triangle[i];
      violation.x = drawn_->x[i];
      violation.y = drawn_->y[i];
      violation.sample = drawn_->sample[i];
      violation.attribute = attribute;
      const auto exact =
          truth_->scaled_derivatives(attribute, drawn_->x[i], drawn_->y[i], drawn_->sample[i]);
      violation.exact = (axis == 0 ? exact->exact.du : exact->exact.dv).to_string();
      violation.actual = value_text(computed[axis]);
      violation.error = one.error;
      const double bound{*scene_->contract().derivative_bound};
      violation.bound = records::Enclosure{bound, bound};
      violation.note =
          axis == 0 ? "the derivative along window x" : "the derivative along window y";
      note(check_, violation);
    }
  }

  const oracle::SceneTruth* scene_;
  const cases::Framebuffer* drawn_;
  Check check_;
  std::set<std::string> labels_;
  std::set<std::uint32_t> triangles_;
  std::unique_ptr<oracle::TriangleTruth> truth_;  ///< of the last fragment's triangle
  std::uint32_t triangle_ = 0;
};

Result<Check> check(const cases::Case& c, backends::Backend& backend,
                    const CheckOptions& /*options*/) {
  const Result<cases::Case> clip = oracle::to_clip_case(c, "");
  if (!clip) return tl::unexpected(clip.error());
  const Result<cases::Framebuffer> drawn = draw(*clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  const oracle::SceneTruth scene(*clip, backend.contract(*clip));
  return DerivativesCheck(scene, *drawn).run();
}

/// Any case, with an attribute at least.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  if (!c.attributes.empty()) return made;
  c.attributes.emplace_back();
  c.attributes.back().name = "a0";
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    const float value = draw.spread(-8, 8);
    c.attribute_values.push_back(value);
  }
  return made;
}

bool is_promised(const backends::Backend& backend) {
  return backend.contract({}).derivative_bound.has_value();
}

const LawRegistration kRegistration(
    {.name = "screen derivatives stay within the bound",
     .reason = "∂r/∂u = (N_u − r D_u)/D is as exact as the value is (RULES §4).",
     .exceptions = "noperspective values with some w <= 0, centroids whose place is open, values "
                   "that the contract leaves in a range; backends that promise no derivatives",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised});

}  // namespace
}  // namespace rastercheck::properties
