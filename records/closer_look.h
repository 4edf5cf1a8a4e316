#pragma once

// A case whose result differs from the baseline, drawn again and inspected: plain data for
// comparison reports.

#include <cstdint>
#include <optional>
#include <string>

#include "records/case_record.h"
#include "records/inspection.h"
#include "records/specimen.h"

namespace rastercheck::records {

struct CloserLook {
  CaseKey key;                 ///< `backend` is the one that drew the case again
  std::string case_name;       ///< empty if unnamed
  std::uint32_t triangle = 0;  ///< index into the case's triangles
  /// Kind of the error that grew; empty if the case is listed only because its pixels changed.
  std::optional<AttributeKind> kind;
  std::optional<Stratum> stratum;
  /// The present drawing. Its `source` may hold the triangle alone, as triangle 0.
  Inspection inspection;
  /// The baseline's drawing of that triangle, including the inspected sample; empty if not kept.
  std::optional<Specimen> before;
  bool operator==(const CloserLook&) const = default;
};

}  // namespace rastercheck::records
