#pragma once

// A case that came out otherwise than in a baseline, drawn again and looked at: plain data of
// comparisons' reports.

#include <cstdint>
#include <optional>
#include <string>

#include "records/case_record.h"
#include "records/inspection.h"
#include "records/specimen.h"

namespace rastercheck::records {

struct CloserLook {
  CaseKey key;                 ///< the backend is that which drew it again
  std::string case_name;       ///< empty where the case has none
  std::uint32_t triangle = 0;  ///< index into the case's triangles
  /// Of the error that grew; nothing where it is looked at as its pixels are others.
  std::optional<AttributeKind> kind;
  std::optional<Stratum> stratum;
  /// As it is drawn now. Its `source` may be the triangle alone, as triangle 0.
  Inspection inspection;
  /// What the baseline kept of that triangle, with the sample looked at within; nothing where it
  /// did not.
  std::optional<Specimen> before;
  bool operator==(const CloserLook&) const = default;
};

}  // namespace rastercheck::records
