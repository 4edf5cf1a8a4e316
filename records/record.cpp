#include "records/record.h"

#include <optional>
#include <tuple>

namespace rastercheck::records {
namespace {

/// Both ends of an error's magnitude, the end farther from zero first. Of two errors, the error
/// with the larger pair counts as larger. If enclosures are as narrow as doubles allow, each end is
/// rounded monotonically, so this order never contradicts the exact one.
struct Extent {
  double far;
  double near;
};

std::strong_ordering operator<=>(const Extent& a, const Extent& b) {
  // std::strong_order is IEEE 754's total order, which leaves no two doubles incomparable.
  const auto by_far = std::strong_order(a.far, b.far);
  return by_far != 0 ? by_far : std::strong_order(a.near, b.near);
}

enum class Side { negative, positive };

Extent extent_of(const Enclosure& error, Side side) {
  return side == Side::positive ? Extent{error.hi, error.lo} : Extent{-error.lo, -error.hi};
}

auto place_of(const WorstError& error) {
  return std::tie(error.case_index, error.case_name, error.place, error.attribute, error.exact);
}

/// True if `a` is kept rather than `b`. A strict total order: two errors are equivalent only if
/// they are equal bit for bit.
bool goes_before(const WorstError& a, const WorstError& b, Side side) {
  const auto by_size = extent_of(a.error, side) <=> extent_of(b.error, side);
  if (by_size != 0) return by_size > 0;
  const auto by_place = place_of(a) <=> place_of(b);
  if (by_place != 0) return by_place < 0;
  return std::strong_order(a.actual, b.actual) < 0;
}

void keep(std::optional<WorstError>& kept, const WorstError& error, Side side) {
  if (!kept || goes_before(error, *kept, side)) kept = error;
}

bool may_keep(const std::optional<WorstError>& kept, const Enclosure& error, Side side) {
  // Compares far ends only, because the near end of a rough enclosure says too little.
  return !kept || extent_of(error, side).far >= extent_of(kept->error, side).far;
}

bool is_on(Side side, const Enclosure& error) { return extent_of(error, side).far > 0; }

}  // namespace

bool is_frozen(const RecordKey& key) {
  return key.stratum != kSavedStratum && key.stratum != kKnownStratum &&
         !key.stratum.starts_with(kSceneStratum);
}

void keep(Extremes& extremes, const WorstError& error) {
  if (is_on(Side::negative, error.error)) keep(extremes.most_negative, error, Side::negative);
  if (is_on(Side::positive, error.error)) keep(extremes.most_positive, error, Side::positive);
}

bool may_keep(const Extremes& extremes, const Enclosure& error) {
  return (is_on(Side::negative, error) &&
          may_keep(extremes.most_negative, error, Side::negative)) ||
         (is_on(Side::positive, error) && may_keep(extremes.most_positive, error, Side::positive));
}

const WorstError* worst_of(const Extremes& extremes) {
  const auto& [negative, positive] = extremes;
  if (!negative || !positive) return positive ? &*positive : negative ? &*negative : nullptr;
  const bool is_positive =
      extent_of(positive->error, Side::positive) > extent_of(negative->error, Side::negative);
  return is_positive ? &*positive : &*negative;
}

void add(RecordSet& into, RecordKey key, const Judgement& judgement) {
  key.attribute_kind = AttributeKind::coverage;
  merge(into[key].counts, judgement.counts);
  merge(into[key].levels, judgement.levels);
  for (const auto& [kind, errors] : judgement.errors) {
    key.attribute_kind = kind;
    merge(into[key].errors, errors);
  }
}

void merge(Counts& into, const Counts& from) {
  into.required += from.required;
  into.forbidden += from.forbidden;
  into.permitted += from.permitted;
  into.undecided += from.undecided;
}

void merge(CaseCounts& into, const CaseCounts& from) {
  into.checked += from.checked;
  into.not_applicable += from.not_applicable;
  into.violations += from.violations;
  into.known += from.known;
}

void merge(ClassCounts& into, const ClassCounts& from) {
  for (std::size_t i = 0; i < into.counts.size(); ++i) into.counts[i] += from.counts[i];
}

void merge(Extremes& into, const Extremes& from) {
  // Merges each side by itself, because an enclosure that contains zero does not tell its side.
  if (from.most_negative) keep(into.most_negative, *from.most_negative, Side::negative);
  if (from.most_positive) keep(into.most_positive, *from.most_positive, Side::positive);
}

void merge(ErrorSizes& into, const ErrorSizes& from) {
  into.histogram.merge(from.histogram);
  merge(into.extremes, from.extremes);
  into.sum.merge(from.sum);
}

void merge(ErrorStatistics& into, const ErrorStatistics& from) {
  merge(into.excess, from.excess);
  merge(into.ideal, from.ideal);
  merge(into.classes, from.classes);
  for (const auto& [why, count] : from.not_judged) into.not_judged[why] += count;
  for (const auto& [stratum, sizes] : from.strata) merge(into.strata[stratum], sizes);
  for (const auto& [stratum, stages] : from.stages) {
    for (const auto& [stage, sum] : stages) into.stages[stratum][stage].merge(sum);
  }
}

void merge(LevelCounts& into, const LevelCounts& from) {
  into.filter += from.filter;
  into.interval += from.interval;
  into.exact += from.exact;
}

void merge(Levels& into, const Levels& from) {
  merge(into.samples, from.samples);
  merge(into.values, from.values);
}

void merge(Judgement& into, const Judgement& from) {
  merge(into.counts, from.counts);
  merge(into.levels, from.levels);
  for (const auto& [kind, errors] : from.errors) merge(into.errors[kind], errors);
}

void merge(Record& into, const Record& from) {
  merge(into.cases, from.cases);
  merge(into.counts, from.counts);
  merge(into.errors, from.errors);
  for (const auto& [label, cases] : from.labels) into.labels[label] += cases;
  for (const auto& [id, cases] : from.known) into.known[id] += cases;
  for (const auto& [why, cases] : from.not_applicable_because) {
    into.not_applicable_because[why] += cases;
  }
  merge(into.levels, from.levels);
  merge(into.power, from.power);
}

void merge(RecordSet& into, const RecordSet& from) {
  for (const auto& [key, record] : from) merge(into[key], record);
}

}  // namespace rastercheck::records
