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

void EnclosedErrors::note(const ExtremeCandidate& candidate) {
  candidates_.push_back(candidate);
  most_.take(candidate.error.lo, candidate.place);
  least_.take(-candidate.error.hi, candidate.place);
  prune();
}

/// Keeps the candidates that may be the largest error on their side of 0.
void EnclosedErrors::prune() {
  std::erase_if(candidates_, [this](const ExtremeCandidate& candidate) {
    const bool may_be_most = candidate.error.hi > 0 && candidate.error.hi >= most();
    const bool may_be_least = candidate.error.lo < 0 && candidate.error.lo <= least();
    return !may_be_most && !may_be_least;
  });
}

void EnclosedErrors::settled() {
  candidates_.clear();
  const records::Extremes& seen = sizes.extremes;
  if (seen.most_positive) most_.take(seen.most_positive->error.lo, seen.most_positive->place);
  if (seen.most_negative) least_.take(-seen.most_negative->error.hi, seen.most_negative->place);
}

void EnclosedErrors::merge(EnclosedErrors&& other) {
  records::merge(sizes, other.sizes);
  for (const ExtremeCandidate& candidate : other.candidates_) {
    if (may_be_extreme(candidate.error, candidate.place)) note(candidate);
  }
}

EnclosedErrors& ValueStatistics::enclosed(AttributeKind kind, Stratum stratum, Meaning meaning) {
  auto& errors = enclosed_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(stratum)]
                          [static_cast<std::size_t>(meaning)];
  if (!errors) errors = std::make_unique<EnclosedErrors>(meaning);
  return *errors;
}

void ValueStatistics::merge(ValueStatistics&& other, const Settle& settle) {
  records::merge(judgement_, other.judgement_);
  const auto take_over = [&](AttributeKind kind, Stratum stratum, EnclosedErrors& errors) {
    EnclosedErrors& into = enclosed(kind, stratum, errors.meaning);
    into.merge(std::move(errors));
    if (into.has_many_candidates()) settle(into);
  };
  other.for_each_enclosed(take_over);
}

records::Judgement ValueStatistics::finish(const Settle& settle) {
  const auto put = [&](AttributeKind kind, Stratum stratum, EnclosedErrors& errors) {
    settle(errors);
    put_in_place(kind, stratum, errors);
  };
  for_each_enclosed(put);
  for (auto& [kind, errors] : judgement_.errors) {
    std::erase_if(errors.strata,
                  [](const auto& stratum) { return stratum.second == records::ErrorSizes{}; });
  }
  return std::move(judgement_);
}

void ValueStatistics::put_in_place(AttributeKind kind, Stratum stratum,
                                   const EnclosedErrors& enclosed) {
  const records::ErrorSizes& sizes = enclosed.sizes;
  if (sizes == records::ErrorSizes{}) return;
  records::ErrorStatistics& errors = of(kind);
  if (enclosed.meaning != Meaning::ideal) records::merge(errors.excess, sizes);
  if (enclosed.meaning == Meaning::excess) return;
  records::merge(errors.ideal, sizes);
  records::merge(errors.strata[stratum], sizes);
  if (enclosed.meaning == Meaning::both) return;
  const auto& excesses =
      enclosed_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(stratum)]
               [static_cast<std::size_t>(Meaning::excess)];
  const std::uint64_t beyond = excesses ? excesses->sizes.sum.count() : 0;
  const std::uint64_t within = sizes.sum.count() - beyond;
  errors.excess.histogram.add_to_bucket(0, within);
  errors.excess.sum.add(0, 0, within);
}

}  // namespace rastercheck::oracle
