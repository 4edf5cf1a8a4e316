#pragma once

// Cases that came out otherwise than in a baseline, drawn again and looked at.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "backends/factory.h"
#include "cases/case.h"
#include "records/case_record.h"
#include "records/closer_look.h"
#include "records/plan.h"
#include "records/specimen.h"
#include "records/stage_trace.h"

namespace rastercheck::properties {

/// What is to be looked at.
struct LookRequest {
  records::CaseKey key;        ///< the backend draws it, whoever drew it before
  std::string case_name = {};  ///< empty where the case has none
  cases::SamplePlace at{};     ///< its triangle is an index into the case's triangles
  std::optional<std::uint32_t> attribute = std::nullopt;  ///< nothing for depth
  /// Of the error that grew, if that is why.
  std::optional<records::AttributeKind> kind = std::nullopt;
  std::optional<records::Stratum> stratum = std::nullopt;
  /// What has to be drawn there, to the bit: else it is not what was asked for, as of a drawing
  /// that a law made of the case. Nothing: whatever is.
  std::optional<float> actual = std::nullopt;
  /// What the baseline kept of the case; the same part is shown if it has the sample.
  std::optional<records::Specimen> before = std::nullopt;
};

/// Draws each again, in order. `plan` is that of the run that the cases are from, whose corpus it
/// has to be. Left out is what cannot be drawn, or is not drawn so any more.
std::vector<records::CloserLook> closer_looks(std::span<const LookRequest> requests,
                                              const records::Plan& plan,
                                              std::span<const cases::Case> corpus,
                                              const backends::BackendFactory& backends);

/// Parts of which `again` (draw_again) has other bits than what was kept, those that changed most
/// first (records::change_of), each at its sample that did: `most` at most.
std::vector<LookRequest> changed_parts(std::span<const records::Specimen> kept,
                                       std::span<const records::Specimen> again, std::size_t most);

}  // namespace rastercheck::properties
