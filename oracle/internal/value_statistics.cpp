#include "oracle/internal/value_statistics.h"

#include <algorithm>

#include "records/record.h"

namespace rastercheck::oracle {

using records::AttributeKind;
using records::Stratum;

void ExtremeLimit::take(double error_size, const cases::SamplePlace& error_place) {
  if (!lets(error_size, error_place)) return;
  size = error_size;
  place = error_place;
}

void SingleErrors::note(const ExtremeCandidate& candidate) {
  candidates_.push_back(candidate);
  most_.take(candidate.error.lo, candidate.place);
  least_.take(-candidate.error.hi, candidate.place);
  prune();
}

/// Keeps those that may be the largest on their side.
void SingleErrors::prune() {
  std::erase_if(candidates_, [this](const ExtremeCandidate& candidate) {
    const bool may_be_most = candidate.error.hi > 0 && candidate.error.hi >= most();
    const bool may_be_least = candidate.error.lo < 0 && candidate.error.lo <= least();
    return !may_be_most && !may_be_least;
  });
}

void SingleErrors::settled() {
  candidates_.clear();
  const records::Extremes& seen = sizes.extremes;
  if (seen.most_positive) most_.take(seen.most_positive->error.lo, seen.most_positive->place);
  if (seen.most_negative) least_.take(-seen.most_negative->error.hi, seen.most_negative->place);
}

void SingleErrors::merge(SingleErrors&& other) {
  records::merge(sizes, other.sizes);
  for (const ExtremeCandidate& candidate : other.candidates_) {
    if (may_be_extreme(candidate.error, candidate.place)) note(candidate);
  }
}

SingleErrors& ValueStatistics::single(AttributeKind kind, Stratum stratum, Excess excess) {
  auto& errors = single_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(stratum)]
                        [static_cast<std::size_t>(excess)];
  if (!errors) errors = std::make_unique<SingleErrors>();
  return *errors;
}

void ValueStatistics::merge(ValueStatistics&& other, const Settle& settle) {
  records::merge(judgement_, other.judgement_);
  const auto take_over = [&](AttributeKind kind, Stratum stratum, Excess excess,
                             SingleErrors& errors) {
    SingleErrors& into = single(kind, stratum, excess);
    into.merge(std::move(errors));
    if (into.has_many_candidates()) settle(into);
  };
  other.for_each_single(take_over);
}

records::Judgement ValueStatistics::finish(const Settle& settle) {
  const auto put = [&](AttributeKind kind, Stratum stratum, Excess excess, SingleErrors& errors) {
    settle(errors);
    put_in_place(kind, stratum, excess, errors.sizes);
  };
  for_each_single(put);
  for (auto& [kind, errors] : judgement_.errors) {
    std::erase_if(errors.strata,
                  [](const auto& stratum) { return stratum.second == records::ErrorSizes{}; });
  }
  return std::move(judgement_);
}

void ValueStatistics::put_in_place(AttributeKind kind, Stratum stratum, Excess excess,
                                   const records::ErrorSizes& sizes) {
  if (sizes == records::ErrorSizes{}) return;
  records::ErrorStatistics& errors = of(kind);
  if (excess == Excess::ideal) {
    records::merge(errors.excess, sizes);
  } else {
    const std::uint64_t count = sizes.sum.count();
    errors.excess.histogram.add_to_bucket(0, count);
    errors.excess.sum.add(0, 0, count);
  }
  records::merge(errors.ideal, sizes);
  records::merge(errors.strata[stratum], sizes);
}

}  // namespace rastercheck::oracle
