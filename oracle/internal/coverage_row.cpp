#include "oracle/internal/coverage_row.h"

#include <algorithm>
#include <bit>

namespace rastercheck::oracle {

using records::Reason;
using records::Verdict;

void CoverageRow::classify(const TriangleTruth& truth, const TriangleFilter& filter, int y,
                           records::LevelCounts& levels) {
  const auto pattern = truth.setup().scene->pattern();
  const int width = filter.box().x1 - filter.box().x0;
  x0_ = filter.box().x0;
  x1_ = filter.box().x1;
  verdicts_.resize(pattern.size());
  open_.clear();
  special_.clear();
  required_ = 0;
  permitted_ = 0;
  for (std::size_t s = 0; s < pattern.size(); ++s) {
    RowVerdicts& row = verdicts_[s];
    filter.classify(y, pattern[s], row);
    for (std::size_t w = 0; w < row.required.size(); ++w) {
      const int from = static_cast<int>(w) * 64;
      std::uint64_t open = ~(row.required[w] | row.forbidden[w]);
      if (width - from < 64) open &= (std::uint64_t{1} << (width - from)) - 1;
      for (; open != 0; open &= open - 1) {
        open_.push_back({x0_ + from + std::countr_zero(open), static_cast<int>(s), {}});
      }
      required_ += static_cast<std::uint64_t>(std::popcount(row.required[w]));
    }
  }
  levels.filter += static_cast<std::uint64_t>(width) * pattern.size() - open_.size();
  if (!open_.empty()) decide_open(truth, filter, y, levels);
}

void CoverageRow::decide_open(const TriangleTruth& truth, const TriangleFilter& filter, int y,
                              records::LevelCounts& levels) {
  const auto pattern = truth.setup().scene->pattern();
  {
    const UpwardRounding upward;
    for (OpenSample& open : open_) {
      open.decision = filter.decide(open.x, y, pattern[static_cast<std::size_t>(open.sample)]);
    }
  }
  for (OpenSample& open : open_) {
    ++(open.decision ? levels.interval : levels.exact);
    if (!open.decision) open.decision = truth.judge(open.x, y, open.sample);
    const records::SampleVerdict& decision = *open.decision;
    if (decision.verdict == Verdict::forbidden) continue;
    if (decision.verdict == Verdict::permitted) {
      ++permitted_;
    } else {
      ++required_;
      const auto bit = static_cast<std::size_t>(open.x - x0_);
      verdicts_[static_cast<std::size_t>(open.sample)].required[bit / 64] |= std::uint64_t{1}
                                                                             << (bit % 64);
    }
    const bool is_ordinary =
        decision.verdict == Verdict::required && decision.reason == Reason::inside;
    if (!is_ordinary) special_.push_back(open);
  }
  std::sort(special_.begin(), special_.end(), [](const OpenSample& a, const OpenSample& b) {
    return a.x != b.x ? a.x < b.x : a.sample < b.sample;
  });
}

}  // namespace rastercheck::oracle
