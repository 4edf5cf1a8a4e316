#include "oracle/internal/nearest_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "oracle/internal/floating_point.h"
#include "oracle/internal/triangle_judge.h"

namespace rastercheck::oracle {
namespace {

using records::FragmentClass;

}  // namespace

NearestJudge::NearestJudge(const JudgeContext& context, const JudgeSink& sink)
    : context_(&context), sink_(&sink), order_(context.drawn->size()) {
  // Sorted by row, and within a row in drawing order; bands sort their own fragments.
  const std::vector<std::uint16_t>& rows = context.drawn->y;
  row_begins_.resize(std::size_t{std::numeric_limits<std::uint16_t>::max()} + 2);
  for (const std::uint16_t y : rows) ++row_begins_[std::size_t{y} + 1];
  std::partial_sum(row_begins_.begin(), row_begins_.end(), row_begins_.begin());
  std::vector<std::size_t> next(row_begins_.begin(), row_begins_.end() - 1);
  for (std::size_t i = 0; i < rows.size(); ++i) order_[next[rows[i]]++] = i;

  boxes_ = boxes_of_triangles(*context.scene);
  const cases::Case& source = context.scene->source();
  for (std::size_t t = 0; t < boxes_.size(); ++t) {
    if (!cases::promise_of(context.scene->contract(), source, t).is_made) ++unpromised_;
  }
}

/// Returns the fragments of the rows y0 <= y < y1, ordered by y, x, sample, triangle.
std::span<const std::size_t> NearestJudge::sorted_rows(std::size_t y0, std::size_t y1) {
  const cases::Fragments& drawn = *context_->drawn;
  const std::span<std::size_t> fragments(order_.data() + row_begins_[y0],
                                         row_begins_[y1] - row_begins_[y0]);
  const auto goes_before = [&drawn](std::size_t a, std::size_t b) {
    const auto place = [&drawn](std::size_t i) {
      return std::uint64_t{drawn.y[i]} << 24 | std::uint64_t{drawn.x[i]} << 8 | drawn.sample[i];
    };
    const std::uint64_t of_a = place(a);
    const std::uint64_t of_b = place(b);
    return of_a != of_b ? of_a < of_b : drawn.triangle[a] < drawn.triangle[b];
  };
  std::stable_sort(fragments.begin(), fragments.end(), goes_before);
  return fragments;
}

JudgedDrawing NearestJudge::run() {
  const cases::FramebufferSize& size = context_->scene->source().framebuffer;
  const int rows = rows_of_band(size);
  Turns turns(static_cast<std::size_t>((size.height + rows - 1) / rows), context_->options->jobs);
  turns.run([&](std::size_t band) {
    const int y0 = static_cast<int>(band) * rows;
    judge_band(y0, std::min(y0 + rows, size.height), band, turns);
  });
  take_the_rest();
  JudgedDrawing judged = findings_.finish(*context_);
  judged.judgement.counts.permitted += unpromised_ * samples_of_unpromised(*context_->scene);
  return judged;
}

/// Walks the fragments of a band alongside the answers.
class NearestJudge::Band {
 public:
  /// `fragments` are those of the band, sorted.
  Band(const JudgeContext& context, std::span<const std::size_t> fragments, bool is_seen)
      : context_(&context),
        samples_(context, is_seen ? Emit([this](const JudgedSample& sample,
                                                const std::shared_ptr<const TriangleTruth>& truth) {
                   seen_.emplace_back(sample, truth);
                 })
                                  : Emit{}),
        triangles_(*context.scene, context.options->first_level),
        fragments_(fragments) {}

  void judge(NearestBand& answers) {
    answers.for_each_answer([this](int y, int x, int s, auto candidates, bool is_required) {
      judge_sample({y, x, s}, candidates, is_required);
    });
    while (!fragments_.empty()) take_unanswered();
    judge_values();
  }

  PreparedTriangles& triangles() { return triangles_; }
  SampleJudge& samples() { return samples_; }

  /// Emits the judged samples ordered by y, x, sample, triangle; of several at one place, the
  /// correct one comes first.
  void let_out(const JudgeSink& sink) {
    const auto key = [](const auto& seen) {
      const JudgedSample& s = seen.first;
      return std::tuple(s.place.y, s.place.x, s.place.sample, s.place.triangle,
                        s.fragment_class != FragmentClass::correct);
    };
    std::stable_sort(seen_.begin(), seen_.end(),
                     [&key](const auto& a, const auto& b) { return key(a) < key(b); });
    for (const auto& [sample, truth] : seen_) sink(sample, truth.get());
  }

 private:
  using Candidate = NearestBand::Candidate;
  using Sample = std::tuple<int, int, int>;  ///< y, x, sample
  struct Right {
    std::uint32_t triangle = 0;
    std::size_t fragment = 0;
    records::SampleVerdict decision;
  };

  /// The sample of the next fragment.
  Sample next_sample() const {
    const cases::Fragments& drawn = *context_->drawn;
    const std::size_t next = fragments_.front();
    return {drawn.y[next], drawn.x[next], drawn.sample[next]};
  }
  bool is_next(const Sample& where) const { return !fragments_.empty() && next_sample() == where; }
  std::size_t take_next() {
    const std::size_t next = fragments_.front();
    fragments_ = fragments_.subspan(1);
    return next;
  }

  void judge_sample(const Sample& where, std::span<const Candidate> candidates, bool is_required) {
    while (!fragments_.empty() && next_sample() < where) take_unanswered();
    for (const Candidate& candidate : candidates) samples_.count(candidate.decision.verdict, 1);
    if (!is_next(where)) {
      if (is_required) take_missing(where, candidates.front());
      return;
    }
    const std::uint32_t drawn = context_->drawn->triangle[fragments_.front()];
    const auto candidate =
        std::find_if(candidates.begin(), candidates.end(),
                     [drawn](const Candidate& c) { return c.triangle == drawn; });
    if (candidate != candidates.end()) {
      right_.push_back({drawn, take_next(), candidate->decision});
    } else if (!take_if_unpromised()) {
      take_unasked(is_required ? FragmentClass::wrong_triangle : FragmentClass::extra);
    }
    // Further fragments of the sample are extra, because the depth test leaves only one.
    while (is_next(where)) take_unasked(FragmentClass::extra);
  }

  /// The verdict of the next fragment if the contract promises nothing about its triangle;
  /// otherwise forbidden.
  records::SampleVerdict unpromised_verdict() {
    const cases::SamplePlace place = context_->drawn->place_of(fragments_.front());
    const cases::Case& source = context_->scene->source();
    if (place.triangle >= source.triangles.size() ||
        std::cmp_greater_equal(place.sample, source.framebuffer.samples)) {
      return {};
    }
    const PreparedTriangles::Prepared triangle = triangles_.of(place.triangle);
    if (triangle.truth->setup().promise.is_made) return {};
    return triangle.truth->judge(static_cast<int>(place.x), static_cast<int>(place.y),
                                 static_cast<int>(place.sample));
  }

  /// Takes all fragments of the next fragment's sample, where every triangle with a promise is
  /// forbidden.
  void take_unanswered() {
    const Sample where = next_sample();
    take_if_unpromised();
    while (is_next(where)) take_unasked(FragmentClass::extra);
  }

  /// Takes the next fragment if the contract leaves open whether its triangle is drawn there.
  bool take_if_unpromised() {
    const records::SampleVerdict verdict = unpromised_verdict();
    if (verdict.verdict == records::Verdict::forbidden) return false;
    const std::uint32_t triangle = context_->drawn->triangle[fragments_.front()];
    right_.push_back({triangle, take_next(), verdict});
    return true;
  }

  /// Judges values triangle by triangle, which is fast.
  void judge_values() {
    std::stable_sort(right_.begin(), right_.end(),
                     [](const Right& a, const Right& b) { return a.triangle < b.triangle; });
    for (std::size_t i = 0; i < right_.size();) {
      const PreparedTriangles::Prepared triangle = triangles_.of(right_[i].triangle);
      const std::uint32_t index = right_[i].triangle;
      samples_.begin(triangle.truth, index, *triangle.filter);
      for (; i < right_.size() && right_[i].triangle == index; ++i) {
        samples_.take_drawn(right_[i].fragment, right_[i].decision);
      }
      samples_.flush();
    }
  }

  void take_missing(const Sample& where, const Candidate& candidate) {
    const auto [y, x, s] = where;
    samples_.take({candidate.triangle, static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x),
                   static_cast<std::uint32_t>(s)},
                  candidate.decision, FragmentClass::missing,
                  triangles_.of(candidate.triangle).truth);
  }

  /// Takes the next fragment, which matches no candidate at its sample.
  void take_unasked(FragmentClass fragment_class) {
    const cases::SamplePlace place = context_->drawn->place_of(take_next());
    const bool is_of_the_case = place.triangle < context_->scene->source().triangles.size();
    samples_.take(place, {}, fragment_class,
                  is_of_the_case ? triangles_.of(place.triangle).truth : nullptr);
  }

  const JudgeContext* context_;
  std::vector<std::pair<JudgedSample, std::shared_ptr<const TriangleTruth>>> seen_;
  SampleJudge samples_;
  PreparedTriangles triangles_;
  std::span<const std::size_t> fragments_;  ///< the fragments not yet taken
  std::vector<Right> right_;                ///< fragments whose values are still to be judged
};

void NearestJudge::judge_band(int y0, int y1, std::size_t index, Turns& turns) {
  const DefaultFloatingPoint floating_point;
  Band band(*context_, sorted_rows(static_cast<std::size_t>(y0), static_cast<std::size_t>(y1)),
            bool{*sink_});
  NearestBand answers(*context_->scene, y0, y1, band.triangles());
  for (std::uint32_t t = 0; t < boxes_.size(); ++t) {
    if (boxes_[t].y0 < y1 && boxes_[t].y1 > y0) {
      answers.add(t, band.samples().levels().samples);
    }
  }
  band.judge(answers);
  SampleJudge::Findings findings = band.samples().finish();
  turns.wait_for(index);
  band.let_out(*sink_);
  findings_.merge(std::move(findings), *context_);
}

/// Takes the fragments below the framebuffer.
void NearestJudge::take_the_rest() {
  const DefaultFloatingPoint floating_point;
  const int height = context_->scene->source().framebuffer.height;
  const std::span<const std::size_t> rest =
      sorted_rows(static_cast<std::size_t>(height), row_begins_.size() - 1);
  Band band(*context_, rest, bool{*sink_});
  NearestBand nothing(*context_->scene, height, height, band.triangles());
  band.judge(nothing);
  band.let_out(*sink_);
  findings_.merge(band.samples().finish(), *context_);
}

}  // namespace rastercheck::oracle
