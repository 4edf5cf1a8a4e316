#pragma once

// Handles samples whose class is known: counts them, compares a share of them with the referee, and
// passes them to the sink.

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cases/sample_place.h"
#include "oracle/internal/value_cascade.h"
#include "oracle/internal/value_statistics.h"
#include "oracle/judge.h"

namespace rastercheck::oracle {

/// Everything that all threads of a judgement share.
class JudgeContext {
 public:
  JudgeContext(const SceneTruth& judged_scene, const cases::Fragments& judged_drawing,
               const JudgeOptions& judge_options)
      : scene(&judged_scene), drawn(&judged_drawing), options(&judge_options) {}

  const SceneTruth* scene;
  const cases::Fragments* drawn;
  const JudgeOptions* options;

  /// Compares the exact triangle's answer at a sample with the referee's; returns one line if they
  /// differ.
  std::optional<std::string> self_check(const cases::SamplePlace& place) const;
  void settle(EnclosedErrors& errors) const;

 private:
  mutable std::once_flag is_made_;
  mutable std::unique_ptr<SceneTruth> exact_scene_;  ///< under the contract that the referee knows
};

/// Receives a judged sample, with the truth of its triangle if it has one.
using Emit = std::function<void(const JudgedSample&, const std::shared_ptr<const TriangleTruth>&)>;

/// Judges samples for which it is known whether they were drawn.
class SampleJudge {
 public:
  /// `emit` may be empty.
  SampleJudge(const JudgeContext& context, Emit emit);

  /// Begins a triangle; `filter` must be the filter of its coverage, and must outlive its use here.
  void begin(std::shared_ptr<const TriangleTruth> truth, std::uint32_t triangle,
             const TriangleFilter& filter);

  /// Takes a fragment at a required or permitted sample of the triangle. Values are judged in
  /// batches; all are judged after flush().
  void take_drawn(std::size_t fragment, const records::SampleVerdict& decision) {
    fragments_[pending_] = fragment;
    decisions_[pending_] = decision;
    if (++pending_ == kBatchSize) flush();
  }
  /// Takes any other sample: missing, or drawn where it should not be. `truth` is nullptr if the
  /// place names no triangle of the case.
  void take(const cases::SamplePlace& place, const records::SampleVerdict& decision,
            records::FragmentClass fragment_class,
            const std::shared_ptr<const TriangleTruth>& truth);
  void flush();

  void count(records::Verdict verdict, std::uint64_t times);
  /// True if samples with this decision must be shown one by one even if they are unremarkable.
  bool shows(const records::SampleVerdict& decision) const;
  records::Levels& levels() { return findings_.statistics.levels(); }

  /// The results of everything judged. Findings can be merged.
  struct Findings {
    ValueStatistics statistics;
    std::optional<std::string> fault;
    std::vector<std::uint32_t> seen_triangles;

    void merge(Findings&& other, const JudgeContext& context);
    JudgedDrawing finish(const JudgeContext& context);
  };
  Findings finish();

 private:
  void check_oracle(const cases::SamplePlace& place);
  void show(const cases::SamplePlace& place, const records::SampleVerdict& decision,
            records::FragmentClass fragment_class, std::vector<JudgedValue> values,
            const std::shared_ptr<const TriangleTruth>& truth) const;
  void see_triangle(std::uint32_t triangle);

  const JudgeContext* context_;
  Emit emit_;
  Findings findings_;
  ValueCascade values_;
  std::uint64_t self_check_below_;
  std::uint64_t self_check_seed_;

  std::shared_ptr<const TriangleTruth> truth_;
  std::uint32_t triangle_ = 0;
  // Fragments waiting to be judged together, and the decision for each.
  std::size_t pending_ = 0;
  Batch<std::size_t> fragments_{};
  Batch<records::SampleVerdict> decisions_{};
};

}  // namespace rastercheck::oracle
