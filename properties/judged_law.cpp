#include "properties/judged_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "cases/float_text.h"
#include "records/record.h"

namespace rastercheck::properties {
namespace {

using oracle::JudgedSample;
using oracle::JudgedValue;
using oracle::SceneTruth;
using oracle::TriangleTruth;
using records::AttributeKind;
using records::FragmentClass;
using records::Verdict;

std::string decision_text(const records::SampleVerdict& decision) {
  return fmt::format("{}: {}", records::to_string(decision.verdict),
                     records::to_string(decision.reason));
}

void describe_coverage(const JudgedSample& sample, const TriangleTruth* truth,
                       const SceneTruth& scene, records::Violation& violation) {
  violation.kind = AttributeKind::coverage;
  violation.fragment_class = sample.fragment_class;
  violation.actual = sample.fragment_class == FragmentClass::missing ? "not drawn" : "drawn";
  if (truth == nullptr || !is_sample_of(scene.source(), sample.place)) {
    violation.exact = "forbidden: no such triangle, pixel or sample";
    return;
  }
  const auto x = static_cast<int>(sample.place.x);
  const auto y = static_cast<int>(sample.place.y);
  const auto s = static_cast<int>(sample.place.sample);
  // Decides again here: the judge gives no reason for samples that are far from the triangle or
  // drawn once too often.
  const records::SampleVerdict decision = truth->judge(x, y, s);
  violation.exact = decision_text(decision);
  violation.distance = truth->distance(x, y, s);
  if (violation.actual == "drawn" && decision.verdict != Verdict::forbidden) {
    violation.note = scene.source().depth_test == cases::DepthTest::none
                         ? "drawn more than once"
                         : "drawn more than once, or hidden by a nearer triangle";
  }
}

void describe_value(const JudgedSample& sample, const JudgedValue& value,
                    const TriangleTruth& truth, records::Violation& violation) {
  const auto x = static_cast<int>(sample.place.x);
  const auto y = static_cast<int>(sample.place.y);
  const auto s = static_cast<int>(sample.place.sample);
  violation.kind = value.kind;
  violation.fragment_class = value.fragment_class;
  violation.attribute = value.attribute;
  violation.exact = oracle::to_string(value.attribute ? truth.attribute(*value.attribute, x, y, s)
                                                      : truth.depth(x, y, s));
  violation.actual = value_text(value.actual);
  violation.error = value.excess;
  if (const auto bound = truth.value_bound(value.attribute, x, y, s)) {
    violation.bound = bound->enclosure();
  }
}

/// Tells if a drawn sample's triangle leaves the centre of the pixel uncovered, so that attributes
/// located at the centre are extrapolated. Judges the same triangle with one sample, the centre.
class CentreQuestion {
 public:
  explicit CentreQuestion(const SceneTruth& scene) {
    cases::Case source = scene.source();
    const bool has_centre = std::any_of(
        source.attributes.begin(), source.attributes.end(), [](const cases::Attribute& attribute) {
          return attribute.location == cases::Location::center &&
                 attribute.interpolation != cases::Interpolation::flat;
        });
    if (!has_centre || source.framebuffer.samples == 1) return;
    source.framebuffer.samples = 1;
    scene_ = std::make_unique<SceneTruth>(std::move(source), scene.contract());
  }

  /// False if the answer is no for every sample.
  bool is_open() const { return scene_ != nullptr; }

  bool is_extrapolated(const JudgedSample& sample) {
    if (!scene_) return false;
    if (!truth_ || triangle_ != sample.place.triangle) {
      truth_ = std::make_unique<TriangleTruth>(*scene_, sample.place.triangle);
      triangle_ = sample.place.triangle;
    }
    const records::SampleVerdict decision =
        truth_->judge(static_cast<int>(sample.place.x), static_cast<int>(sample.place.y), 0);
    return decision.verdict == Verdict::forbidden;
  }

 private:
  std::unique_ptr<SceneTruth> scene_;
  std::unique_ptr<TriangleTruth> truth_;
  std::uint32_t triangle_ = 0;
};

/// The labels that a case's judged samples reached. If asks_of_ordinary() is false, see() need not
/// be called for samples strictly inside: it suffices to pass their triangles to labels().
class LabelCollector {
 public:
  explicit LabelCollector(const SceneTruth& scene) : scene_(&scene), centre_(scene) {}

  void see(const JudgedSample& sample) {
    if (sample.fragment_class != FragmentClass::correct &&
        sample.fragment_class != FragmentClass::missing) {
      return;
    }
    is_permitted_ = is_permitted_ || sample.decision.verdict == Verdict::permitted;
    reasons_.insert(sample.decision.reason);
    if (!is_extrapolated_ && sample.fragment_class == FragmentClass::correct) {
      is_extrapolated_ = centre_.is_extrapolated(sample);
    }
  }

  bool asks_of_ordinary() const { return centre_.is_open(); }

  /// `triangles` are those with a correctly drawn or missing sample.
  std::vector<std::string> labels(const std::set<std::uint32_t>& triangles) const {
    std::set<std::string> all;
    for (const records::Reason reason : reasons_) {
      if (reason != records::Reason::inside) all.emplace(records::to_string(reason));
    }
    if (!triangles.empty()) all.emplace("drawn");
    if (is_permitted_) all.emplace("permitted");
    if (is_extrapolated_) all.emplace("extrapolated centre");
    add_state_labels(scene_->source(), triangles, all);
    return {all.begin(), all.end()};
  }

 private:
  const SceneTruth* scene_;
  CentreQuestion centre_;
  std::set<records::Reason> reasons_;
  bool is_permitted_ = false;
  bool is_extrapolated_ = false;
};

/// True if a vertex lies beyond a clip plane, so that part of its triangle is cut away.
bool is_beyond_a_plane(const cases::Case& c, std::uint32_t vertex) {
  const cases::ClipVertex& p = c.positions[vertex];
  const auto distances = c.clip_distances_of(vertex);
  if (std::any_of(distances.begin(), distances.end(), [](float d) { return d < 0; })) return true;
  const float near = c.rules == cases::Rules::opengl ? -p.w : 0.0F;
  return !c.depth_clamp && (p.z < near || p.z > p.w);
}

}  // namespace

void add_state_labels(const cases::Case& c, const std::set<std::uint32_t>& drawn_triangles,
                      std::set<std::string>& labels) {
  if (drawn_triangles.empty()) return;
  if (c.framebuffer.samples > 1) labels.emplace("several samples");
  if (c.depth_test == cases::DepthTest::less) labels.emplace("depth test");
  for (const std::uint32_t triangle : drawn_triangles) {
    for (const std::uint32_t vertex : c.triangles[triangle]) {
      if (c.positions[vertex].w <= 0) labels.emplace("w <= 0");
      if (is_beyond_a_plane(c, vertex)) labels.emplace("clipped");
    }
  }
}

std::string value_text(float value) {
  if (!std::isfinite(value)) return fmt::format("{}", std::isnan(value) ? std::abs(value) : value);
  return fmt::format("{:.9g} ({})", value, cases::to_hex(value));
}

bool is_sample_of(const cases::Case& c, const cases::SamplePlace& place) {
  const cases::FramebufferSize& size = c.framebuffer;
  return std::cmp_less(place.x, size.width) && std::cmp_less(place.y, size.height) &&
         std::cmp_less(place.sample, size.samples);
}

records::Violation to_violation(const JudgedSample& sample, const JudgedValue* value,
                                const TriangleTruth* truth, const SceneTruth& scene) {
  records::Violation violation;
  violation.place = sample.place;
  if (value == nullptr || truth == nullptr) {
    describe_coverage(sample, truth, scene, violation);
  } else {
    describe_value(sample, *value, *truth, violation);
  }
  return violation;
}

Check not_applicable(std::string_view why) {
  Check none;
  none.is_applicable = false;
  none.why_not = why;
  return none;
}

namespace {

bool is_alike(const records::Violation& a, const records::Violation& b) {
  return a.fragment_class == b.fragment_class && a.kind == b.kind && a.attribute == b.attribute;
}

/// Keeps the first eight. After that, a violation of a new sort replaces the last one whose sort
/// occurs earlier, so that a driver's known defects cannot hide new ones.
void keep(std::vector<records::Violation>& kept, const records::Violation& violation) {
  const auto is_like = [](const records::Violation& one) {
    return [&one](const records::Violation& other) { return is_alike(one, other); };
  };
  if (kept.size() == records::kMostViolations) {
    if (std::any_of(kept.begin(), kept.end(), is_like(violation))) return;
    auto last = kept.end() - 1;
    while (last != kept.begin() && !std::any_of(kept.begin(), last, is_like(*last))) --last;
    if (last == kept.begin()) return;  // eight different sorts
    kept.erase(last);
  }
  kept.push_back(violation);
}

}  // namespace

void add_judged_violation(Check& check, const records::Violation& violation) {
  ++check.violation_count;
  keep(check.violations, violation);
}

void add_violation(Check& check, const records::Violation& violation) {
  ++check.judgement.errors[violation.kind].classes[violation.fragment_class];
  add_judged_violation(check, violation);
}

void add_label(Check& check, std::string_view label) {
  const auto at = std::lower_bound(check.labels.begin(), check.labels.end(), label);
  if (at == check.labels.end() || *at != label) check.labels.emplace(at, label);
}

void merge(Check& into, const Check& from) {
  into.violation_count += from.violation_count;
  for (const records::Violation& violation : from.violations) keep(into.violations, violation);
  records::merge(into.judgement, from.judgement);
  std::set<std::string> labels(into.labels.begin(), into.labels.end());
  labels.insert(from.labels.begin(), from.labels.end());
  into.labels.assign(labels.begin(), labels.end());
  if (!into.fault) into.fault = from.fault;
}

Check judge_drawn(const cases::Case& truth_of, const cases::Contract& contract,
                  const cases::Fragments& drawn, const JudgeRequest& request, std::uint64_t index) {
  const SceneTruth scene(truth_of, contract);
  Check check;
  LabelCollector labels(scene);
  const auto see = [&](const JudgedSample& sample, const TriangleTruth* truth) {
    labels.see(sample);
    if (request.counts_coverage && sample.fragment_class != FragmentClass::correct) {
      add_judged_violation(check, to_violation(sample, nullptr, truth, scene));
    }
    for (const JudgedValue& value : sample.values) {
      if (value.fragment_class != FragmentClass::correct) {
        add_judged_violation(check, to_violation(sample, &value, truth, scene));
      }
    }
  };
  oracle::JudgeOptions judge_options;
  judge_options.judges_values = request.judges_values;
  judge_options.case_index = index;
  // Checks itself more often than by default: for small cases, other costs dominate.
  judge_options.self_check_one_in = 1024;
  judge_options.shows_ordinary = labels.asks_of_ordinary();
  oracle::JudgedDrawing judged = oracle::judge(scene, drawn, judge_options, see);
  check.judgement = std::move(judged.judgement);
  check.labels = labels.labels({judged.seen_triangles.begin(), judged.seen_triangles.end()});
  check.fault = std::move(judged.fault);
  return check;
}

Result<Check> check_drawn(
    const cases::ClipCase& c, backends::Backend& backend,
    const std::function<Check(const cases::ClipCase&, const backends::Drawn&)>& find) {
  const Result<backends::Drawn> drawn = draw_promised(c, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  return find(c, *drawn);
}

Result<Check> check_judged(const cases::ClipCase& c, backends::Backend& backend,
                           const JudgeRequest& request, std::uint64_t index) {
  const Result<backends::Drawn> drawn = draw(c, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  return judge_drawn(c, drawn->contract, drawn->fragments, request, index);
}

}  // namespace rastercheck::properties
