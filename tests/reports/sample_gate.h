#pragma once

// A comparison of two sections by hand, with one growth.

#include "reports/compare_format.h"
#include "tests/reports/sample_sections.h"

namespace rastercheck::reports {

inline Gate gate_of(const BaselineSection& before, const BaselineSection& after) {
  Gate gate;
  const Result<Comparison> comparison = compare(before, after);
  if (comparison) gate.comparisons.push_back(*comparison);
  gate.baseline_file = "b.json";
  gate.current_file = "out/run.json";
  gate.folder = "out";
  return gate;
}

/// The sliver's worst is 3/4 instead of 5/8, and set-up makes 5/4 on average instead of 1/4.
inline BaselineSection sample_grown_section() {
  using namespace records;
  BaselineSection section = sample_section();
  section.entries[kSampleSliver].worst = {0.75, 0.75};
  section.entries[kSampleSliver].stages[Stage::set_up] = sample_sum(20, 4);
  CaseFigures& figures = section.laws[kSampleLaw].cases[kSampleCase];
  figures.found_digest = 8;
  figures.worst[AttributeKind::smooth][Stratum::sliver] = sample_error(0.75, 0.5F);
  return section;
}

inline Gate sample_gate() { return gate_of(sample_section(), sample_grown_section()); }

}  // namespace rastercheck::reports
