#pragma once

// Random records, for laws about merging and JSON. Each statement makes only one random choice,
// because compilers differ in the order of several choices in one expression.

#include <rapidcheck.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "records/record.h"

namespace rastercheck::records {

template <typename T>
T one_of(const std::vector<T>& choices) {
  return choices[*rc::gen::inRange<std::size_t>(0, choices.size())];
}

/// Any finite double. Its bits are random, so extreme exponents are as likely as moderate ones.
inline double any_finite_double() {
  const auto bits = *rc::gen::arbitrary<std::uint64_t>();
  const auto value = std::bit_cast<double>(bits);
  return std::isfinite(value) ? value : std::bit_cast<double>(bits & 0xbfffffffffffffffU);
}

inline float any_finite_float() {
  const auto bits = *rc::gen::arbitrary<std::uint32_t>();
  const auto value = std::bit_cast<float>(bits);
  return std::isfinite(value) ? value : std::bit_cast<float>(bits & 0xbfffffffU);
}

/// An error that often has the same size as another one: few ends, either sign, exact or not. Sums
/// of the largest errors exceed 64 bits.
inline Enclosure random_error() {
  const double end = one_of<double>({0, 0.25, 0.5, 0.5, 1, 4, 0x1p39});
  const bool is_exact = *rc::gen::arbitrary<bool>();
  const bool is_negative = *rc::gen::arbitrary<bool>();
  const double other = is_exact ? end : std::nextafter(end, 0);
  return is_negative ? Enclosure{-end, -other} : Enclosure{other, end};
}

/// A WorstError in which every member often equals that of another one.
inline WorstError random_worst() {
  WorstError worst;
  worst.error = random_error();
  worst.exact = one_of<std::string>({"0", "84/5", "-1/3"});
  worst.actual = one_of<float>({0.0F, -0.0F, 1.5F});
  worst.case_index = *rc::gen::inRange<std::uint64_t>(0, 3);
  worst.case_name = one_of<std::string>({"", "sliver"});
  worst.place.triangle = *rc::gen::inRange<std::uint32_t>(0, 2);
  worst.place.x = *rc::gen::inRange<std::uint32_t>(0, 2);
  worst.place.y = *rc::gen::inRange<std::uint32_t>(0, 2);
  worst.place.sample = *rc::gen::inRange<std::uint32_t>(0, 2);
  if (*rc::gen::arbitrary<bool>()) worst.attribute = *rc::gen::inRange<std::uint32_t>(0, 2);
  return worst;
}

inline FragmentClass random_class() {
  return static_cast<FragmentClass>(
      *rc::gen::inRange<std::size_t>(0, names_of(FragmentClass{}).size()));
}

/// A class that a fragment may have.
inline FragmentClass random_fragment_class() {
  return static_cast<FragmentClass>(*rc::gen::inRange<std::size_t>(0, ClassCounts().counts.size()));
}

inline Stratum random_stratum() {
  return static_cast<Stratum>(*rc::gen::inRange<std::size_t>(0, names_of(Stratum{}).size()));
}

inline Stage random_stage() {
  return static_cast<Stage>(*rc::gen::inRange<std::size_t>(0, names_of(Stage{}).size()));
}

inline LevelCounts random_levels() {
  LevelCounts levels;
  levels.filter = *rc::gen::inRange<std::uint64_t>(0, 3);
  levels.interval = *rc::gen::inRange<std::uint64_t>(0, 3);
  levels.exact = *rc::gen::inRange<std::uint64_t>(0, 3);
  return levels;
}

/// A random sum of a random number of terms, of either sign and of any size that so many terms can
/// reach.
inline SignedSum random_sum() {
  const auto count =
      *rc::gen::inRange<std::uint64_t>(0, SignedSum::kMostTerms) >> *rc::gen::inRange(0, 55);
  const auto random_end = [count] {
    const auto high = SignedSum::Units{*rc::gen::arbitrary<std::int64_t>()} * (1LL << 62);
    const auto low = SignedSum::Units{*rc::gen::arbitrary<std::int64_t>()};
    const SignedSum::Units end = (high + low) >> *rc::gen::inRange(0, 126);
    const SignedSum::Units most = SignedSum::kMostOfTerm * count;
    return std::clamp(end, -most, most);
  };
  const SignedSum::Units a = random_end();
  const SignedSum::Units b = random_end();
  const auto beyond = *rc::gen::arbitrary<std::uint64_t>();
  return {std::min(a, b), std::max(a, b), count, beyond};
}

inline RecordKey random_key() {
  RecordKey key;
  key.law = one_of<std::string>({"coverage is exact", "errors are bounded"});
  key.backend = one_of<std::string>({"cpu", "method:float32"});
  key.attribute_kind = one_of<AttributeKind>({AttributeKind::depth, AttributeKind::smooth});
  key.stratum = one_of<std::string>({"sliver", "grid"});
  return key;
}

/// The data that one fragment of one case adds to the records.
struct Observation {
  RecordKey key;
  WorstError worst;
  FragmentClass fragment_class = FragmentClass::correct;
  double magnitude = 0;  ///< of another value; may be infinite
  Stratum stratum = Stratum::ordinary;
  Levels levels;
  std::string label;
  bool is_violation = false;
  std::string known;    ///< id of the entry; empty: none
  std::string why_not;  ///< why the law does not apply to another case
  std::optional<NotJudged> not_judged;
  std::optional<Defect> defect;  ///< made in the drawing on purpose, and noticed if `is_violation`
};

inline Observation random_observation() {
  Observation observation;
  observation.key = random_key();
  observation.worst = random_worst();
  observation.fragment_class = random_fragment_class();
  observation.magnitude =
      *rc::gen::inRange(0, 8) == 0 ? std::numeric_limits<double>::infinity() : any_finite_double();
  observation.stratum = random_stratum();
  observation.levels.samples = random_levels();
  observation.levels.values = random_levels();
  observation.not_judged = one_of<std::optional<NotJudged>>(
      {std::nullopt, NotJudged::not_promised, NotJudged::undefined});
  observation.defect =
      one_of<std::optional<Defect>>({std::nullopt, Defect::moved_half, Defect::depth_nan});
  observation.label = one_of<std::string>({"tie", "w <= 0", "clipped"});
  observation.is_violation = *rc::gen::arbitrary<bool>();
  observation.known = one_of<std::string>({"", "driver-1", "driver-2"});
  observation.why_not = one_of<std::string>({"", "it has no tie", "it draws no pictures"});
  return observation;
}

inline void add(RecordSet& records, const Observation& observation) {
  Judgement judgement;
  ++judgement.counts.required;
  judgement.levels = observation.levels;
  ErrorStatistics& errors = judgement.errors[observation.key.attribute_kind];
  errors.excess.histogram.add(magnitude_bound(observation.worst.error));
  errors.excess.histogram.add(observation.magnitude);
  keep(errors.excess.extremes, observation.worst);
  errors.excess.sum.add(observation.worst.error);
  const double size = std::abs(observation.magnitude);
  errors.excess.sum.add({-size, size});
  errors.ideal.histogram.add(observation.magnitude);
  keep(errors.ideal.extremes, observation.worst);
  errors.ideal.sum.add(observation.worst.error);
  errors.strata[observation.stratum] = errors.ideal;
  ++errors.classes[observation.fragment_class];
  if (observation.not_judged) ++errors.not_judged[*observation.not_judged];
  add(records, observation.key, judgement);

  RecordKey key = observation.key;
  key.attribute_kind = AttributeKind::coverage;
  Record& record = records[key];
  ++record.cases.checked;
  record.cases.violations += observation.is_violation ? 1 : 0;
  ++record.labels[observation.label];
  if (observation.defect) {
    merge(record.power[*observation.defect], {1, observation.is_violation ? 1U : 0U});
  }
  if (!observation.known.empty()) {
    ++record.cases.known;
    ++record.known[observation.known];
  }
  if (!observation.why_not.empty()) {
    ++record.cases.not_applicable;
    ++record.not_applicable_because[observation.why_not];
  }
}

inline std::vector<Observation> random_observations() {
  std::vector<Observation> observations;
  const auto count = *rc::gen::inRange<std::size_t>(0, 12);
  observations.reserve(count);
  for (std::size_t i = 0; i < count; ++i) observations.push_back(random_observation());
  return observations;
}

inline RecordSet records_of(const std::vector<Observation>& observations) {
  RecordSet records;
  for (const Observation& observation : observations) add(records, observation);
  return records;
}

inline RecordSet merged(RecordSet a, const RecordSet& b) {
  merge(a, b);
  return a;
}

}  // namespace rastercheck::records
