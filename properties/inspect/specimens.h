#pragma once

// Chooses the parts of a run's drawings to keep, and draws the same parts again.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "properties/inspect/run_cases.h"
#include "records/plan.h"
#include "records/run.h"
#include "records/specimen.h"

namespace rastercheck::properties {

/// Draws the parts to keep of a run that kept its cases: at most records::kMostSpecimens per
/// backend, ordered by key and triangle. For the laws that judge a plain drawing (kValuesLaw,
/// kCoverageLaw):
///
///   - in each stratum of these laws' records, the first case of which a part can be shown. The
///     case alone decides which part, so that runs of the same cases keep the same parts;
///   - the case of the largest error of each kind and stratum of fragments, around that error.
///
/// Each case is drawn without its depth test. Leaves out what cannot be drawn; returns nothing for
/// a run that kept no cases.
std::vector<records::Specimen> make_specimens(const records::Run& run, const CaseSources& sources,
                                              CaseDrawer& drawer);

/// Draws the same parts of the same cases with another backend, or with the same backend at another
/// time. `plan` and `corpus` must be those of the parts' run. Leaves out what cannot be drawn.
std::vector<records::Specimen> draw_again(std::span<const records::Specimen> kept,
                                          const std::string& backend, const records::Plan& plan,
                                          std::span<const cases::Case> corpus, CaseDrawer& drawer);

}  // namespace rastercheck::properties
