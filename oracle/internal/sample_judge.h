#pragma once

// What the judge does with a sample once its class is known, however it came to know it: counts it,
// holds a share against the referee, hands it to the sink.

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

/// What is the same for all of a judgement's threads.
class JudgeContext {
 public:
  JudgeContext(const SceneTruth& judged_scene, const cases::Fragments& judged_drawing,
               const JudgeOptions& judge_options)
      : scene(&judged_scene), drawn(&judged_drawing), options(&judge_options) {}

  const SceneTruth* scene;
  const cases::Fragments* drawn;
  const JudgeOptions* options;

  /// Holds the exact triangle's answer at a sample against the referee; one line where they differ.
  std::optional<std::string> self_check(const cases::SamplePlace& place) const;
  void settle(EnclosedErrors& errors) const;

 private:
  mutable std::once_flag is_made_;
  mutable std::unique_ptr<SceneTruth> exact_scene_;  ///< by the contract that the referee knows
};

/// Takes a judged sample, with the truth of its triangle, if it has one.
using Emit = std::function<void(const JudgedSample&, const std::shared_ptr<const TriangleTruth>&)>;

/// Judges samples that are known to be drawn or not.
class SampleJudge {
 public:
  /// `emit` may be empty.
  SampleJudge(const JudgeContext& context, Emit emit);

  /// What follows is of this triangle; the filter is of its coverage and outlives the triangle.
  void begin(std::shared_ptr<const TriangleTruth> truth, std::uint32_t triangle,
             const TriangleFilter& filter);

  /// A fragment of a required or permitted sample of the triangle. Its values are judged when
  /// enough of them are together; all are after flush().
  void take_drawn(std::size_t fragment, const records::SampleVerdict& decision) {
    fragments_[pending_] = fragment;
    decisions_[pending_] = decision;
    if (++pending_ == kBatchSize) flush();
  }
  /// Any other: missing, or drawn where it should not be. `truth` is nullptr where the place names
  /// no triangle of the case.
  void take(const cases::SamplePlace& place, const records::SampleVerdict& decision,
            records::FragmentClass fragment_class,
            const std::shared_ptr<const TriangleTruth>& truth);
  void flush();

  void count(records::Verdict verdict, std::uint64_t times);
  /// Whether samples of which there is nothing to say have to be seen one by one.
  bool shows(const records::SampleVerdict& decision) const;
  records::Levels& levels() { return findings_.statistics.levels(); }

  /// All that was judged, for Findings to be added up.
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
  // Fragments that wait to be judged together, and what was decided of each.
  std::size_t pending_ = 0;
  Batch<std::size_t> fragments_{};
  Batch<records::SampleVerdict> decisions_{};
};

}  // namespace rastercheck::oracle
