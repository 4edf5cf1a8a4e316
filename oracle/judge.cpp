#include "oracle/judge.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <tuple>

#include "oracle/internal/nearest.h"
#include "oracle/internal/value_judge.h"
#include "oracle/self_check.h"

namespace rastercheck::oracle {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::Verdict;

/// A sample of a triangle; compares in the order of fragments.
struct Place {
  std::uint32_t triangle = 0;
  std::uint32_t y = 0;
  std::uint32_t x = 0;
  std::uint32_t sample = 0;
  auto operator<=>(const Place&) const = default;
};

/// Spreads places evenly, the same on all machines (the finaliser of SplitMix64).
std::uint64_t scatter(const Place& place, std::uint64_t case_index) {
  std::uint64_t h = case_index * 0x9e3779b97f4a7c15U;
  for (const std::uint32_t part : {place.triangle, place.y, place.x, place.sample}) {
    h = (h ^ part) + 0x9e3779b97f4a7c15U;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9U;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebU;
    h ^= h >> 31;
  }
  return h;
}

/// The contract that the referee answers for.
cases::Contract exact_contract(const cases::Case& source) {
  cases::Contract contract;
  contract.tie_rule = source.fill_rule;
  return contract;
}

class Judging {
 public:
  Judging(const SceneTruth& scene, const cases::Framebuffer& drawn, const JudgeOptions& options,
          const JudgeSink& sink)
      : scene_(&scene), drawn_(&drawn), options_(&options), sink_(&sink) {
    order_fragments();
  }

  Judged run() {
    auto& errors = judged_.judgement.errors;
    errors[AttributeKind::coverage];
    if (scene_->source().depth_test == cases::DepthTest::none) {
      for (std::uint32_t t = 0; t < scene_->source().triangles.size(); ++t) judge_alone(t);
    } else {
      judge_nearest();
    }
    // What is left names no triangle of the case.
    while (next_ < order_.size()) take_extra(place_of(order_[next_]), nullptr);
    count_forbidden();
    return std::move(judged_);
  }

 private:
  Place place_of(std::size_t fragment) const {
    return {drawn_->triangle[fragment], drawn_->y[fragment], drawn_->x[fragment],
            drawn_->sample[fragment]};
  }

  void order_fragments() {
    order_.resize(drawn_->size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    const auto goes_before = [this](std::size_t a, std::size_t b) {
      return place_of(a) < place_of(b);
    };
    if (!std::is_sorted(order_.begin(), order_.end(), goes_before)) {
      std::stable_sort(order_.begin(), order_.end(), goes_before);
    }
  }

  /// Each triangle as if drawn alone: walks its samples and its fragments side by side.
  void judge_alone(std::uint32_t t) {
    const TriangleTruth truth(*scene_, t);
    const Pixels pixels = truth.pixels();
    const int samples = scene_->source().framebuffer.samples;
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      for (int x = pixels.x0; x < pixels.x1; ++x) {
        for (int s = 0; s < samples; ++s) {
          const Place place{t, static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x),
                            static_cast<std::uint32_t>(s)};
          take_extras_before(place, truth);
          const records::SampleVerdict decision = truth.judge(x, y, s);
          count(decision.verdict);
          const bool is_drawn = next_ < order_.size() && place_of(order_[next_]) == place;
          if (is_drawn) {
            take_drawn(place, decision, truth, FragmentClass::extra);
          } else if (decision.verdict == Verdict::required) {
            report(place, decision, FragmentClass::missing, &truth);
          }
        }
      }
    }
    take_extras_before({t + 1, 0, 0, 0}, truth);
  }

  /// The nearest fragment of each sample: what is drawn there has to be among those that may be.
  void judge_nearest() {
    const auto answers = nearest_answers(*scene_);
    std::stable_sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
      return nearest_order(a) < nearest_order(b);
    });
    for (const auto& [where, answer] : answers) {
      while (next_ < order_.size() && sample_of(order_[next_]) < where) {
        take_unasked(FragmentClass::extra);
      }
      for (const auto& candidate : answer.candidates) count(candidate.decision.verdict);
      if (next_ == order_.size() || sample_of(order_[next_]) != where) {
        if (answer.is_required) report_missing(where, answer.candidates.front());
        continue;
      }
      const auto candidate = std::find_if(
          answer.candidates.begin(), answer.candidates.end(),
          [this](const auto& c) { return c.triangle == drawn_->triangle[order_[next_]]; });
      if (candidate == answer.candidates.end()) {
        take_unasked(answer.is_required ? FragmentClass::wrong_triangle : FragmentClass::extra);
      } else {
        const TriangleTruth truth(*scene_, candidate->triangle);
        take_drawn(place_of(order_[next_]), candidate->decision, truth, FragmentClass::extra);
      }
      // More than one fragment of a sample: the depth test leaves one.
      while (next_ < order_.size() && sample_of(order_[next_]) == where) {
        take_unasked(FragmentClass::extra);
      }
    }
    while (next_ < order_.size()) take_unasked(FragmentClass::extra);
  }

  std::tuple<int, int, int> sample_of(std::size_t fragment) const {
    return {drawn_->y[fragment], drawn_->x[fragment], drawn_->sample[fragment]};
  }
  std::tuple<int, int, int, std::uint32_t> nearest_order(std::size_t fragment) const {
    return {drawn_->y[fragment], drawn_->x[fragment], drawn_->sample[fragment],
            drawn_->triangle[fragment]};
  }

  void report_missing(const std::tuple<int, int, int>& where,
                      const NearestAnswer::Candidate& candidate) {
    const auto [y, x, s] = where;
    const TriangleTruth truth(*scene_, candidate.triangle);
    report({candidate.triangle, static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x),
            static_cast<std::uint32_t>(s)},
           candidate.decision, FragmentClass::missing, &truth);
  }

  /// Takes the next fragment, which no triangle of the case answers for at its sample.
  void take_unasked(FragmentClass fragment_class) {
    const Place place = place_of(order_[next_]);
    ++next_;
    if (place.triangle < scene_->source().triangles.size()) {
      const TriangleTruth truth(*scene_, place.triangle);
      report(place, {}, fragment_class, &truth);
    } else {
      report(place, {}, fragment_class, nullptr);
    }
  }

  void take_extra(const Place& place, const TriangleTruth* truth) {
    ++next_;
    report(place, {}, FragmentClass::extra, truth);
  }

  void take_extras_before(const Place& place, const TriangleTruth& truth) {
    while (next_ < order_.size() && place_of(order_[next_]) < place) {
      take_extra(place_of(order_[next_]), &truth);
    }
  }

  /// Takes the next fragment, which is of the place.
  void take_drawn(const Place& place, const records::SampleVerdict& decision,
                  const TriangleTruth& truth, FragmentClass where_forbidden) {
    const std::size_t fragment = order_[next_];
    ++next_;
    if (decision.verdict == Verdict::forbidden) {
      report(place, decision, where_forbidden, &truth);
      return;
    }
    JudgedSample sample = make_sample(place, decision, FragmentClass::correct);
    if (options_->judges_values) judge_values(fragment, truth, sample);
    finish(sample, &truth);
  }

  void judge_values(std::size_t fragment, const TriangleTruth& truth, JudgedSample& sample) {
    ComputedValue value{sample.triangle, sample.x,     sample.y,
                        sample.sample,   std::nullopt, drawn_->depth[fragment]};
    const auto judge_one = [&] {
      if (const auto judged =
              judge_value(*scene_, truth, value, options_->case_index, judged_.judgement)) {
        sample.values.push_back(*judged);
      }
    };
    judge_one();
    const auto attributes = drawn_->attributes_of(fragment);
    for (std::uint32_t a = 0; a < scene_->source().attributes.size(); ++a) {
      value.attribute = a;
      value.actual = attributes[a];
      judge_one();
    }
  }

  static JudgedSample make_sample(const Place& place, const records::SampleVerdict& decision,
                                  FragmentClass fragment_class) {
    return {place.triangle, place.x, place.y, place.sample, decision, fragment_class, {}};
  }

  void report(const Place& place, const records::SampleVerdict& decision,
              FragmentClass fragment_class, const TriangleTruth* truth) {
    finish(make_sample(place, decision, fragment_class), truth);
  }

  void finish(const JudgedSample& sample, const TriangleTruth* truth) {
    ++judged_.judgement.errors[AttributeKind::coverage].classes[sample.fragment_class];
    check_oracle(sample);
    if (*sink_) (*sink_)(sample, truth);
  }

  /// Holds the exact triangle's answer at a share of the samples against the referee.
  void check_oracle(const JudgedSample& sample) {
    const cases::Case& source = scene_->source();
    const Place place{sample.triangle, sample.y, sample.x, sample.sample};
    const bool is_chosen =
        !judged_.fault && options_->self_check_one_in > 0 &&
        scatter(place, options_->case_index) % options_->self_check_one_in == 0 &&
        place.triangle < source.triangles.size() &&
        place.sample < static_cast<std::uint32_t>(source.framebuffer.samples);
    if (!is_chosen) return;
    if (!exact_scene_) exact_scene_ = std::make_unique<SceneTruth>(source, exact_contract(source));
    judged_.fault = self_check(*exact_scene_, place.triangle, static_cast<int>(place.x),
                               static_cast<int>(place.y), static_cast<int>(place.sample));
  }

  void count(Verdict verdict) {
    records::Counts& counts = judged_.judgement.counts;
    counts.required += verdict == Verdict::required ? 1 : 0;
    counts.permitted += verdict == Verdict::permitted ? 1 : 0;
  }

  /// All samples of all triangles that are neither required nor permitted.
  void count_forbidden() {
    const cases::Case& source = scene_->source();
    const cases::FramebufferSize& size = source.framebuffer;
    const auto samples = static_cast<std::uint64_t>(size.width) *
                         static_cast<std::uint64_t>(size.height) *
                         static_cast<std::uint64_t>(size.samples) * source.triangles.size();
    records::Counts& counts = judged_.judgement.counts;
    counts.forbidden = samples - counts.required - counts.permitted;
  }

  const SceneTruth* scene_;
  const cases::Framebuffer* drawn_;
  const JudgeOptions* options_;
  const JudgeSink* sink_;
  std::vector<std::size_t> order_;  ///< indices of fragments, by place
  std::size_t next_ = 0;            ///< the first of order_ that was not taken
  std::unique_ptr<SceneTruth> exact_scene_;
  Judged judged_;
};

}  // namespace

Judged judge(const SceneTruth& scene, const cases::Framebuffer& drawn, const JudgeOptions& options,
             const JudgeSink& sink) {
  return Judging(scene, drawn, options, sink).run();
}

}  // namespace rastercheck::oracle
