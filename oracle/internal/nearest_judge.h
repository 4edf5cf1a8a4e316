#pragma once

// Judges the result of a depth test: the triangle drawn at a sample must be among those that may be
// the nearest there. Each thread judges one band of rows after the other.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "oracle/internal/nearest.h"
#include "oracle/internal/sample_judge.h"
#include "oracle/internal/triangle_boxes.h"
#include "oracle/internal/turns.h"
#include "oracle/judge.h"

namespace rastercheck::oracle {

class NearestJudge {
 public:
  NearestJudge(const JudgeContext& context, const JudgeSink& sink);

  JudgedDrawing run();

 private:
  class Band;

  void judge_band(int y0, int y1, std::size_t index, Turns& turns);
  void take_the_rest();
  std::span<const std::size_t> sorted_rows(std::size_t y0, std::size_t y1);

  const JudgeContext* context_;
  const JudgeSink* sink_;
  std::vector<std::size_t> order_;       ///< fragments by row; sorted within bands asked for so far
  std::vector<std::size_t> row_begins_;  ///< [y]: begin of row y in order_; one more at the end
  std::vector<PixelBox> boxes_;          ///< [triangle]
  std::uint64_t unpromised_ = 0;         ///< triangles the contract promises nothing about
  SampleJudge::Findings findings_;       ///< written by the band whose turn it is
};

}  // namespace rastercheck::oracle
