#pragma once

// Which parts of a run's drawings are kept, and the same parts drawn again.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "backends/factory.h"
#include "properties/inspect/run_cases.h"
#include "records/plan.h"
#include "records/run.h"
#include "records/specimen.h"

namespace rastercheck::properties {

/// Draws what is kept of a run that kept its cases, of each backend records::kMostSpecimens at
/// most, ordered by key and triangle. Of the laws that draw a case as it stands (kValuesLaw,
/// kCoverageLaw):
///
///   - the first case of each stratum of their records of which a part can be shown: where that is,
///     the case alone decides, so that runs of the same cases keep the same ones;
///   - the case of the largest error of each kind and stratum of fragments, around that error.
///
/// Each case is drawn without its depth test. Left out is what cannot be drawn; nothing is kept of
/// a run that kept no cases.
std::vector<records::Specimen> make_specimens(const records::Run& run, const CaseSources& sources,
                                              const backends::BackendFactory& backends);

/// Draws the same parts of the same cases by another backend, or by the same one at another time.
/// `plan` is that of the run that they are from, whose corpus it has to be. Left out is what cannot
/// be drawn.
std::vector<records::Specimen> draw_again(std::span<const records::Specimen> kept,
                                          const std::string& backend, const records::Plan& plan,
                                          std::span<const cases::Case> corpus,
                                          const backends::BackendFactory& backends);

}  // namespace rastercheck::properties
