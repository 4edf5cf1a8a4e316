#pragma once

// Judges what a depth test left: what is drawn at a sample has to be among the fragments that may
// be the nearest there. Band of rows by band of rows.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "oracle/internal/nearest.h"
#include "oracle/internal/sample_judge.h"
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
  std::vector<std::size_t> order_;  ///< fragments, by row; of a band that was asked for, sorted
  std::vector<std::size_t> row_begins_;  ///< [y]: where in order_ a row begins; one more at the end
  std::vector<std::pair<std::uint16_t, std::uint16_t>> rows_;  ///< of a triangle: first and past
  std::uint64_t unpromised_ = 0;    ///< triangles of which the contract promises nothing
  SampleJudge::Findings findings_;  ///< written by the band whose turn it is
};

}  // namespace rastercheck::oracle
