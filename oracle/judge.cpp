// Judging a drawing: in chunks of triangles, each as if drawn alone, or in bands of rows, where a
// depth test leaves the nearest.

#include "oracle/judge.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <numeric>
#include <tuple>

#include "oracle/internal/floating_point.h"
#include "oracle/internal/nearest.h"
#include "oracle/internal/sample_judge.h"
#include "oracle/internal/triangle_judge.h"

namespace rastercheck::oracle {
namespace {

using records::FragmentClass;
using records::Verdict;

using TruthPointer = std::shared_ptr<const TriangleTruth>;

/// Triangles judged together by one thread.
struct Chunk {
  std::size_t index = 0;
  std::uint32_t first_triangle = 0;
  std::uint32_t last_triangle = 0;  ///< one past
  std::size_t first_fragment = 0;
  std::size_t last_fragment = 0;
};

/// Cuts a drawing into chunks of much the same work, the same ones however many threads take them,
/// and lets what came of them out in their order.
class Chunks {
 public:
  Chunks(const cases::Case& source, const FragmentOrder& order)
      : source_(&source), order_(&order) {}

  std::optional<Chunk> next() {
    const std::lock_guard lock(mutex_);
    const auto count = static_cast<std::uint32_t>(source_->triangles.size());
    if (triangle_ == count || failure_) return std::nullopt;
    Chunk chunk{taken_++, triangle_, std::min(triangle_ + kTriangles, count), fragment_, 0};
    if (fragment_ + kFragments < order_->size()) {
      const std::uint32_t there = order_->place(fragment_ + kFragments).triangle;
      chunk.last_triangle = std::clamp(there, triangle_ + 1, chunk.last_triangle);
    }
    chunk.last_fragment = order_->lower_bound({chunk.last_triangle, 0, 0, 0});
    triangle_ = chunk.last_triangle;
    fragment_ = chunk.last_fragment;
    return chunk;
  }

  /// Waits until all chunks before this one are out; throws where one of them never will be.
  void wait_for_turn(const Chunk& chunk) {
    std::unique_lock lock(mutex_);
    turn_.wait(lock, [&] { return out_ == chunk.index || failure_; });
    if (failure_) std::rethrow_exception(failure_);
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    ++out_;
    turn_.notify_all();
  }

  /// A chunk failed, so that no later one has its turn; the first failure is kept.
  void fail(const std::exception_ptr& failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = failure;
    turn_.notify_all();
  }
  void rethrow_failure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  static constexpr std::uint32_t kTriangles = 256;
  static constexpr std::size_t kFragments = 32768;

  const cases::Case* source_;
  const FragmentOrder* order_;
  std::mutex mutex_;
  std::condition_variable turn_;
  std::uint32_t triangle_ = 0;
  std::size_t fragment_ = 0;
  std::size_t taken_ = 0;
  std::size_t out_ = 0;
  std::exception_ptr failure_;
};

/// Holds the samples of a chunk back from the sink until its turn; not more than so many, as then
/// it waits for it.
class HeldSamples {
 public:
  HeldSamples(Chunks& chunks, const Chunk& chunk, const JudgeSink& sink)
      : chunks_(&chunks), chunk_(&chunk), sink_(&sink) {}

  void take(const JudgedSample& sample, const TruthPointer& truth) {
    if (is_out_) {
      (*sink_)(sample, truth.get());
      return;
    }
    held_.emplace_back(sample, truth);
    if (held_.size() == kMost) let_out();
  }

  void let_out() {
    if (!is_out_) chunks_->wait_for_turn(*chunk_);
    is_out_ = true;
    for (const auto& [sample, truth] : held_) (*sink_)(sample, truth.get());
    held_.clear();
  }

 private:
  static constexpr std::size_t kMost = 16384;

  Chunks* chunks_;
  const Chunk* chunk_;
  const JudgeSink* sink_;
  bool is_out_ = false;
  std::vector<std::pair<JudgedSample, TruthPointer>> held_;
};

/// Each triangle as if drawn alone.
class AloneJudge {
 public:
  AloneJudge(const JudgeContext& context, const JudgeSink& sink)
      : context_(&context),
        sink_(&sink),
        order_(*context.drawn),
        chunks_(context.scene->source(), order_) {}

  Judged run() {
    std::vector<std::future<void>> others;
    for (unsigned i = 1; i < context_->options->jobs; ++i) {
      others.push_back(std::async(std::launch::async, [this] { work(); }));
    }
    work();
    for (const std::future<void>& other : others) other.wait();
    chunks_.rethrow_failure();
    take_the_rest();
    return findings_.finish(*context_);
  }

 private:
  void work() {
    try {
      const DefaultFloatingPoint floating_point;
      while (const std::optional<Chunk> chunk = chunks_.next()) judge(*chunk);
    } catch (...) {
      // A sink may throw; whoever waits for this chunk has to hear of it.
      chunks_.fail(std::current_exception());
    }
  }

  void judge(const Chunk& chunk) {
    HeldSamples held(chunks_, chunk, *sink_);
    Emit emit;
    if (*sink_) {
      emit = [&held](const JudgedSample& sample, const TruthPointer& truth) {
        held.take(sample, truth);
      };
    }
    SampleJudge samples(*context_, std::move(emit));
    TriangleJudge triangles(*context_, order_, samples);
    std::size_t first = chunk.first_fragment;
    for (std::uint32_t t = chunk.first_triangle; t < chunk.last_triangle; ++t) {
      std::size_t last = first;
      while (last < chunk.last_fragment && order_.place(last).triangle == t) ++last;
      triangles.judge(t, first, last);
      first = last;
    }
    SampleJudge::Findings findings = samples.finish();
    held.let_out();
    findings_.merge(std::move(findings), *context_);
    chunks_.leave();
  }

  /// What names no triangle of the case.
  void take_the_rest() {
    const auto count = static_cast<std::uint32_t>(context_->scene->source().triangles.size());
    SampleJudge samples(*context_, [this](const JudgedSample& sample, const TruthPointer&) {
      if (*sink_) (*sink_)(sample, nullptr);
    });
    for (std::size_t i = order_.lower_bound({count, 0, 0, 0}); i < order_.size(); ++i) {
      samples.take(order_.place(i), {}, FragmentClass::extra, nullptr);
    }
    findings_.merge(samples.finish(), *context_);
  }

  const JudgeContext* context_;
  const JudgeSink* sink_;
  FragmentOrder order_;
  Chunks chunks_;
  SampleJudge::Findings findings_;  ///< written by the chunk whose turn it is
};

/// The nearest fragment of each sample: what is drawn there has to be among those that may be.
class NearestJudge {
 public:
  NearestJudge(const JudgeContext& context, const JudgeSink& sink)
      : context_(&context),
        samples_(context,
                 [&sink](const JudgedSample& sample, const TruthPointer& truth) {
                   if (sink) sink(sample, truth.get());
                 }),
        triangles_(*context.scene, context.options->first_level),
        order_(context.drawn->size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
      return std::tuple(sample_of(a), context_->drawn->triangle[a]) <
             std::tuple(sample_of(b), context_->drawn->triangle[b]);
    });
  }

  Judged run() {
    const DefaultFloatingPoint floating_point;
    const NearestAnswers answers(*context_->scene);
    const int height = context_->scene->source().framebuffer.height;
    for (int y = 0; y < height; y += NearestAnswers::kRows) {
      judge_band(
          answers.in_rows(y, y + NearestAnswers::kRows, triangles_, samples_.levels().samples));
      triangles_.clear();
    }
    while (next_ < order_.size()) take_unasked(FragmentClass::extra);
    return samples_.finish().finish(*context_);
  }

 private:
  using Sample = std::tuple<int, int, int>;  ///< y, x, sample

  Sample sample_of(std::size_t fragment) const {
    const cases::Framebuffer& drawn = *context_->drawn;
    return {drawn.y[fragment], drawn.x[fragment], drawn.sample[fragment]};
  }
  bool is_next(const Sample& where) const {
    return next_ < order_.size() && sample_of(order_[next_]) == where;
  }

  void judge_band(const NearestAnswers::Answers& answers) {
    for (const auto& [where, answer] : answers) {
      while (next_ < order_.size() && sample_of(order_[next_]) < where) {
        take_unasked(FragmentClass::extra);
      }
      for (const auto& candidate : answer.candidates) {
        samples_.count(candidate.decision.verdict, 1);
      }
      if (!is_next(where)) {
        if (answer.is_required) take_missing(where, answer.candidates.front());
        continue;
      }
      const auto candidate = std::find_if(
          answer.candidates.begin(), answer.candidates.end(),
          [this](const auto& c) { return c.triangle == context_->drawn->triangle[order_[next_]]; });
      if (candidate == answer.candidates.end()) {
        take_unasked(answer.is_required ? FragmentClass::wrong_triangle : FragmentClass::extra);
      } else {
        const auto& triangle = triangles_.of(candidate->triangle);
        samples_.begin(triangle.truth, candidate->triangle, *triangle.filter);
        samples_.take_drawn(order_[next_++], candidate->decision);
        samples_.flush();
      }
      // More than one fragment of a sample: the depth test leaves one.
      while (is_next(where)) take_unasked(FragmentClass::extra);
    }
  }

  void take_missing(const Sample& where, const NearestAnswer::Candidate& candidate) {
    const auto [y, x, s] = where;
    samples_.take({candidate.triangle, static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x),
                   static_cast<std::uint32_t>(s)},
                  candidate.decision, FragmentClass::missing,
                  triangles_.of(candidate.triangle).truth);
  }

  /// Takes the next fragment, which no triangle of the case answers for at its sample.
  void take_unasked(FragmentClass fragment_class) {
    const SamplePlace place = place_of(*context_->drawn, order_[next_++]);
    const bool is_of_the_case = place.triangle < context_->scene->source().triangles.size();
    samples_.take(place, {}, fragment_class,
                  is_of_the_case ? triangles_.of(place.triangle).truth : nullptr);
  }

  const JudgeContext* context_;
  SampleJudge samples_;
  PreparedTriangles triangles_;
  std::vector<std::size_t> order_;  ///< fragments, by y, x, sample, triangle
  std::size_t next_ = 0;            ///< the first of order_ that was not taken
};

/// All samples of all triangles that are neither required nor permitted.
std::uint64_t forbidden_samples(const cases::Case& source, const records::Counts& counts) {
  const cases::FramebufferSize& size = source.framebuffer;
  const auto samples = static_cast<std::uint64_t>(size.width) *
                       static_cast<std::uint64_t>(size.height) *
                       static_cast<std::uint64_t>(size.samples) * source.triangles.size();
  return samples - counts.required - counts.permitted;
}

}  // namespace

Judged judge(const SceneTruth& scene, const cases::Framebuffer& drawn, const JudgeOptions& options,
             const JudgeSink& sink) {
  const JudgeContext context(scene, drawn, options);
  Judged judged = scene.source().depth_test == cases::DepthTest::none
                      ? AloneJudge(context, sink).run()
                      : NearestJudge(context, sink).run();
  records::Counts& counts = judged.judgement.counts;
  counts.forbidden = forbidden_samples(scene.source(), counts);
  return judged;
}

}  // namespace rastercheck::oracle
