#pragma once

// Judges triangles one by one, each as if drawn alone: walks the rows of its samples and its
// fragments side by side. A row in which exactly the required samples are drawn, the usual case, is
// settled by comparing bits.

#include <cstdint>
#include <vector>

#include "oracle/internal/coverage_row.h"
#include "oracle/internal/sample_judge.h"
#include "oracle/internal/triangle_filter.h"

namespace rastercheck::oracle {

/// The fragments of a drawing, sorted by place whatever the order of drawing.
class FragmentOrder {
 public:
  explicit FragmentOrder(const cases::Fragments& drawn);
  std::size_t size() const { return drawn_->size(); }
  std::size_t operator[](std::size_t i) const { return order_.empty() ? i : order_[i]; }
  cases::SamplePlace place(std::size_t i) const { return drawn_->place_of((*this)[i]); }
  /// The first position whose place is not before `place`.
  std::size_t lower_bound(const cases::SamplePlace& place) const;

 private:
  const cases::Fragments* drawn_;
  std::vector<std::size_t> order_;  ///< empty if the fragments are already sorted by place, as they
                                    ///< should be
};

/// The number of samples that a triangle may cover if the contract promises nothing about it.
std::uint64_t samples_of_unpromised(const SceneTruth& scene);

class TriangleJudge {
 public:
  TriangleJudge(const JudgeContext& context, const FragmentOrder& order, SampleJudge& samples)
      : context_(&context), order_(&order), samples_(&samples) {}

  /// `first` … `last` − 1 are the positions of the triangle's fragments.
  void judge(std::uint32_t triangle, std::size_t first, std::size_t last);

 private:
  void judge_unpromised(std::size_t first, std::size_t last);
  void judge_row(int y, std::size_t first, std::size_t last);
  bool is_just_what_is_required(std::size_t first, std::size_t last) const;
  void walk_row(int y, std::size_t first, std::size_t last);
  void take_extra(std::size_t position, const records::SampleVerdict& decision);

  const JudgeContext* context_;
  const FragmentOrder* order_;
  SampleJudge* samples_;

  std::shared_ptr<const TriangleTruth> truth_;
  std::uint32_t triangle_ = 0;
  std::optional<TriangleFilter> filter_;
  CoverageRow row_;
};

}  // namespace rastercheck::oracle
