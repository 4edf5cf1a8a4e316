#pragma once

// Draws again and inspects cases whose results differ from a baseline.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/case.h"
#include "properties/inspect/run_cases.h"
#include "records/case_record.h"
#include "records/closer_look.h"
#include "records/plan.h"
#include "records/specimen.h"
#include "records/stage_trace.h"

namespace rastercheck::properties {

/// A request to draw a case again and to inspect a sample.
struct LookRequest {
  records::CaseKey key;        ///< `backend` draws the case, whichever backend drew it before
  std::string case_name = {};  ///< empty if unnamed
  cases::SamplePlace at{};     ///< its triangle is an index into the case's triangles
  std::optional<std::uint32_t> attribute = std::nullopt;  ///< empty for depth
  /// Kind and stratum of the error that grew, if that is the reason to look.
  std::optional<records::AttributeKind> kind = std::nullopt;
  std::optional<records::Stratum> stratum = std::nullopt;
  /// The exact value that must be drawn there. If another value is drawn, the request is dropped,
  /// because the value may be from a law's changed case. Empty: any value.
  std::optional<float> actual = std::nullopt;
  /// The baseline's drawn part; the same part is shown if it contains the sample.
  std::optional<records::Specimen> before = std::nullopt;
};

/// Draws each case again, in order. `plan` and `corpus` must be those of the cases' run. Leaves out
/// cases that cannot be drawn or no longer give the same value.
std::vector<records::CloserLook> closer_looks(std::span<const LookRequest> requests,
                                              const records::Plan& plan,
                                              std::span<const cases::Case> corpus,
                                              CaseDrawer& drawer);

/// Returns up to `most` parts whose bits in `again` (draw_again) differ from the kept ones, largest
/// change first (records::change_of), each at its most changed sample.
std::vector<LookRequest> changed_parts(std::span<const records::Specimen> kept,
                                       std::span<const records::Specimen> again, std::size_t most);

}  // namespace rastercheck::properties
