#include "oracle/internal/sample_judge.h"

#include <algorithm>
#include <limits>

#include "oracle/self_check.h"

namespace rastercheck::oracle {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::Verdict;

/// Spreads places evenly, in the same way on all machines (the first half of SplitMix64's
/// finaliser).
std::uint64_t scatter(const cases::SamplePlace& place, std::uint64_t seed) {
  // 31 bits of triangle, 14 of each coordinate and 4 of sample stand side by side.
  std::uint64_t h = (std::uint64_t{place.triangle} << 33) ^ (std::uint64_t{place.y} << 18) ^
                    (std::uint64_t{place.x} << 4) ^ place.sample;
  h += seed;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9U;
  return (h ^ (h >> 27)) * 0x94d049bb133111ebU;
}

/// Sorts the triangles and removes repetitions.
void keep_one_of_each(std::vector<std::uint32_t>& triangles) {
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
}

/// The contract that the referee implements.
cases::Contract exact_contract(const cases::Case& source) {
  cases::Contract contract;
  contract.tie_rule = source.fill_rule;
  return contract;
}

}  // namespace

std::optional<std::string> JudgeContext::self_check(const cases::SamplePlace& place) const {
  const cases::Case& source = scene->source();
  const bool is_of_the_case = place.triangle < source.triangles.size() &&
                              place.sample < static_cast<std::uint32_t>(source.framebuffer.samples);
  if (!is_of_the_case) return std::nullopt;
  std::call_once(is_made_, [this, &source] {
    exact_scene_ = std::make_unique<SceneTruth>(source, exact_contract(source));
  });
  return oracle::self_check(*exact_scene_, place.triangle, static_cast<int>(place.x),
                            static_cast<int>(place.y), static_cast<int>(place.sample));
}

void JudgeContext::settle(EnclosedErrors& errors) const {
  settle_extremes(*scene, *drawn, options->case_index, errors);
}

SampleJudge::SampleJudge(const JudgeContext& context, Emit emit)
    : context_(&context),
      emit_(std::move(emit)),
      values_(*context.scene, *context.drawn, *context.options, findings_.statistics) {
  const std::uint64_t one_in = context.options->self_check_one_in;
  self_check_below_ = one_in == 0 ? 0 : std::numeric_limits<std::uint64_t>::max() / one_in;
  self_check_seed_ = (context.options->case_index + 1) * 0x9e3779b97f4a7c15U;
  findings_.statistics.of(AttributeKind::coverage);
}

void SampleJudge::begin(std::shared_ptr<const TriangleTruth> truth, std::uint32_t triangle,
                        const TriangleFilter& filter) {
  truth_ = std::move(truth);
  triangle_ = triangle;
  values_.begin(*truth_, filter);
}

void SampleJudge::flush() {
  if (pending_ == 0) return;
  const std::span<const std::size_t> fragments(fragments_.data(), pending_);
  const JudgedBatch* judged =
      context_->options->judges_values ? &values_.judge(fragments) : nullptr;
  records::ErrorStatistics& coverage = findings_.statistics.of(AttributeKind::coverage);
  coverage.classes[FragmentClass::correct] += pending_;
  if (!truth_->setup().promise.is_made) {
    coverage.not_judged[records::NotJudged::not_promised] += pending_;
  }
  see_triangle(triangle_);
  for (const std::size_t fragment : fragments) {
    const cases::SamplePlace place = context_->drawn->place_of(fragment);
    if (scatter(place, self_check_seed_) < self_check_below_) check_oracle(place);
  }
  for (std::size_t k = 0; emit_ && k < pending_; ++k) {
    const bool is_right = judged == nullptr || judged->is_right(k);
    if (is_right && !shows(decisions_[k])) continue;
    show(context_->drawn->place_of(fragments_[k]), decisions_[k], FragmentClass::correct,
         judged == nullptr ? std::vector<JudgedValue>{} : judged->values_of(k), truth_);
  }
  pending_ = 0;
}

void SampleJudge::take(const cases::SamplePlace& place, const records::SampleVerdict& decision,
                       FragmentClass fragment_class,
                       const std::shared_ptr<const TriangleTruth>& truth) {
  flush();  // keeps the order, and makes the batches the same with or without a sink
  ++findings_.statistics.of(AttributeKind::coverage).classes[fragment_class];
  if (fragment_class == FragmentClass::missing) see_triangle(place.triangle);
  if (scatter(place, self_check_seed_) < self_check_below_) check_oracle(place);
  if (emit_) show(place, decision, fragment_class, {}, truth);
}

bool SampleJudge::shows(const records::SampleVerdict& decision) const {
  const bool is_ordinary =
      decision.verdict == Verdict::required && decision.reason == records::Reason::inside;
  return emit_ && (context_->options->shows_ordinary || !is_ordinary);
}

void SampleJudge::show(const cases::SamplePlace& place, const records::SampleVerdict& decision,
                       FragmentClass fragment_class, std::vector<JudgedValue> values,
                       const std::shared_ptr<const TriangleTruth>& truth) const {
  emit_({place, decision, fragment_class, std::move(values)}, truth);
}

void SampleJudge::see_triangle(std::uint32_t triangle) {
  auto& seen = findings_.seen_triangles;
  if (seen.empty() || seen.back() != triangle) seen.push_back(triangle);
}

void SampleJudge::check_oracle(const cases::SamplePlace& place) {
  if (!findings_.fault) findings_.fault = context_->self_check(place);
}

void SampleJudge::count(Verdict verdict, std::uint64_t times) {
  records::Counts& counts = findings_.statistics.judgement().counts;
  counts.required += verdict == Verdict::required ? times : 0;
  counts.permitted += verdict == Verdict::permitted ? times : 0;
}

SampleJudge::Findings SampleJudge::finish() {
  flush();
  keep_one_of_each(findings_.seen_triangles);
  return std::move(findings_);
}

void SampleJudge::Findings::merge(Findings&& other, const JudgeContext& context) {
  statistics.merge(std::move(other.statistics),
                   [&context](EnclosedErrors& errors) { context.settle(errors); });
  if (!fault) fault = std::move(other.fault);
  seen_triangles.insert(seen_triangles.end(), other.seen_triangles.begin(),
                        other.seen_triangles.end());
}

JudgedDrawing SampleJudge::Findings::finish(const JudgeContext& context) {
  JudgedDrawing judged;
  judged.judgement =
      statistics.finish([&context](EnclosedErrors& errors) { context.settle(errors); });
  judged.fault = std::move(fault);
  keep_one_of_each(seen_triangles);
  judged.seen_triangles = std::move(seen_triangles);
  return judged;
}

}  // namespace rastercheck::oracle
