#pragma once

// A section of a baseline with one law, made by hand. It has 4 values, whose errors are 0, 1/4, 1/2
// and 5/8.

#include <string>
#include <utility>
#include <vector>

#include "records/baseline.h"

namespace rastercheck::records {

inline const std::string kSampleLaw = "values are <within> bounds";
inline const EntryKey kSampleCoverage{kSampleLaw, AttributeKind::coverage, std::nullopt};
inline const EntryKey kSampleAll{kSampleLaw, AttributeKind::smooth, std::nullopt};
inline const EntryKey kSampleSliver{kSampleLaw, AttributeKind::smooth, Stratum::sliver};
inline const CaseNumber kSampleCase{Origin::random, 12};

inline WorstError sample_error(double error, float actual = 0.25F) {
  WorstError worst;
  worst.error = {error, error};
  worst.exact = "1/3";
  worst.actual = actual;
  worst.case_index = 12;
  worst.place.x = 3;
  worst.place.y = 5;
  worst.attribute = 0;
  return worst;
}

inline SignedSum sample_sum(std::uint64_t quarters, std::uint64_t count) {
  constexpr SignedSum::Units kQuarter = SignedSum::Units{1} << 30;
  SignedSum sum;
  sum.add(kQuarter * quarters, kQuarter * quarters, count);
  return sum;
}

inline BaselineSection sample_section() {
  using namespace records;
  BaselineSection section;
  section.key = {"cpu", "x86_64", "", ""};
  section.plan.seed = 1;
  section.plan.cases_per_law = 20;
  section.plan.backends = {};
  section.plan.properties = {"*values*"};
  section.taken = {"cpu", "0.1.0", "c0ffee", "avx2", "GNU 12.2.0"};
  EntryFigures& coverage = section.entries[kSampleCoverage];
  coverage.cases = {20, 3, 0, 0};
  coverage.classes[FragmentClass::correct] = 4;
  coverage.power = {7, 6};
  EntryFigures values;
  for (const double error : {0.0, 0.25, 0.5, 0.625}) values.histogram.add(error);
  values.worst = {0.625, 0.625};
  // Set-up makes 1/4 on average, rounding 3/4.
  values.stages = {{Stage::set_up, sample_sum(4, 4)}, {Stage::rounding, sample_sum(12, 4)}};
  section.entries[kSampleSliver] = values;
  values.classes[FragmentClass::correct] = 4;
  section.entries[kSampleAll] = values;
  LawCases& law = section.laws[kSampleLaw];
  law.count = 23;
  law.digest = 0x0123456789abcdef;
  law.cases[kSampleCase] = {
      7, 0, {{AttributeKind::smooth, {{Stratum::sliver, sample_error(0.625)}}}}};
  law.cases[{Origin::corpus, 0}] = {9, 0, {}};
  section.corpus = {{0, "the \"first\" case"}};
  return section;
}

}  // namespace rastercheck::records
