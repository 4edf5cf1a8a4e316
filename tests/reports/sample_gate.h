#pragma once

// A comparison of two sections, made by hand, with one case that grew.

#include "gate/compare.h"
#include "reports/compare_format.h"
#include "tests/records/sample_sections.h"

namespace rastercheck::reports {

inline Gate gate_of(const records::BaselineSection& before, const records::BaselineSection& after) {
  Gate gate;
  const Result<records::Comparison> comparison = gate::compare(before, after);
  if (comparison) gate.comparisons.push_back(*comparison);
  gate.baseline_file = "b.json";
  gate.current_file = "out/run.json";
  gate.folder = "out";
  return gate;
}

/// The sliver's worst error is 3/4 instead of 5/8, and set-up makes 5/4 on average instead of 1/4.
inline records::BaselineSection sample_grown_section() {
  using namespace records;
  records::BaselineSection section = records::sample_section();
  section.entries[records::kSampleSliver].worst = {0.75, 0.75};
  section.entries[records::kSampleSliver].stages[Stage::set_up] = records::sample_sum(20, 4);
  records::CaseFigures& figures = section.laws[records::kSampleLaw].cases[records::kSampleCase];
  figures.found_digest = 8;
  figures.worst[AttributeKind::smooth][Stratum::sliver] = records::sample_error(0.75, 0.5F);
  return section;
}

inline Gate sample_gate() { return gate_of(records::sample_section(), sample_grown_section()); }

}  // namespace rastercheck::reports
