// Judges a drawing in parallel. Without a depth test, a thread takes a chunk of triangles and
// judges each as if drawn alone. With a depth test, which keeps only the nearest fragment, a thread
// takes a band of rows.

#include "oracle/judge.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "oracle/internal/floating_point.h"
#include "oracle/internal/nearest_judge.h"
#include "oracle/internal/sample_judge.h"
#include "oracle/internal/triangle_judge.h"
#include "oracle/internal/turns.h"

namespace rastercheck::oracle {
namespace {

using records::FragmentClass;

using TruthPointer = std::shared_ptr<const TriangleTruth>;

/// Triangles judged together by one thread.
struct Chunk {
  std::uint32_t first_triangle = 0;
  std::uint32_t last_triangle = 0;  ///< one past the last
  std::size_t first_fragment = 0;
  std::size_t last_fragment = 0;
};

/// Cuts a drawing into chunks of about equal work.
std::vector<Chunk> chunks_of(const cases::Case& source, const FragmentOrder& order) {
  constexpr std::uint32_t kTriangles = 256;
  constexpr std::size_t kFragments = 32768;
  const auto count = static_cast<std::uint32_t>(source.triangles.size());
  std::vector<Chunk> chunks;
  std::uint32_t triangle = 0;
  std::size_t fragment = 0;
  while (triangle < count) {
    Chunk chunk{triangle, std::min(triangle + kTriangles, count), fragment, 0};
    if (fragment + kFragments < order.size()) {
      const std::uint32_t there = order.place(fragment + kFragments).triangle;
      chunk.last_triangle = std::clamp(there, triangle + 1, chunk.last_triangle);
    }
    chunk.last_fragment = order.lower_bound({chunk.last_triangle, 0, 0, 0});
    triangle = chunk.last_triangle;
    fragment = chunk.last_fragment;
    chunks.push_back(chunk);
  }
  return chunks;
}

/// Holds back a chunk's samples until it is the chunk's turn at the sink. Once kMost samples are
/// held, waits for that turn and from then on passes samples straight to the sink.
class HeldSamples {
 public:
  HeldSamples(Turns& turns, std::size_t chunk, const JudgeSink& sink)
      : turns_(&turns), chunk_(chunk), sink_(&sink) {}

  void take(const JudgedSample& sample, const TruthPointer& truth) {
    if (is_out_) {
      (*sink_)(sample, truth.get());
      return;
    }
    held_.emplace_back(sample, truth);
    if (held_.size() == kMost) let_out();
  }

  void let_out() {
    turns_->wait_for(chunk_);
    is_out_ = true;
    for (const auto& [sample, truth] : held_) (*sink_)(sample, truth.get());
    held_.clear();
  }

 private:
  static constexpr std::size_t kMost = 16384;

  Turns* turns_;
  std::size_t chunk_;
  const JudgeSink* sink_;
  bool is_out_ = false;
  std::vector<std::pair<JudgedSample, TruthPointer>> held_;
};

/// Judges each triangle as if drawn alone.
class AloneJudge {
 public:
  AloneJudge(const JudgeContext& context, const JudgeSink& sink)
      : context_(&context), sink_(&sink), order_(*context.drawn) {}

  JudgedDrawing run() {
    const std::vector<Chunk> chunks = chunks_of(context_->scene->source(), order_);
    Turns turns(chunks.size(), context_->options->jobs);
    turns.run([&](std::size_t i) { judge(chunks[i], i, turns); });
    take_the_rest();
    return findings_.finish(*context_);
  }

 private:
  void judge(const Chunk& chunk, std::size_t index, Turns& turns) {
    const DefaultFloatingPoint floating_point;
    HeldSamples held(turns, index, *sink_);
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
  }

  /// Counts as extra the fragments that name no triangle of the case.
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
  SampleJudge::Findings findings_;  ///< written by the chunk whose turn it is
};

/// The number of samples, over all triangles, that are neither required nor permitted.
std::uint64_t forbidden_samples(const cases::Case& source, const records::Counts& counts) {
  const cases::FramebufferSize& size = source.framebuffer;
  const auto samples = static_cast<std::uint64_t>(size.width) *
                       static_cast<std::uint64_t>(size.height) *
                       static_cast<std::uint64_t>(size.samples) * source.triangles.size();
  return samples - counts.required - counts.permitted;
}

}  // namespace

JudgedDrawing judge(const SceneTruth& scene, const cases::Fragments& drawn,
                    const JudgeOptions& options, const JudgeSink& sink) {
  const JudgeContext context(scene, drawn, options);
  JudgedDrawing judged = scene.source().depth_test == cases::DepthTest::none
                             ? AloneJudge(context, sink).run()
                             : NearestJudge(context, sink).run();
  records::Counts& counts = judged.judgement.counts;
  counts.forbidden = forbidden_samples(scene.source(), counts);
  return judged;
}

}  // namespace rastercheck::oracle
