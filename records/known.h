#pragma once

// What is known to be wrong with a driver, as plain data: backends/DRIVER/known.json, and what a
// run found of it. docs/known-defects.md says how such a list is kept.
//
// An entry has conditions, as narrow as the defect is: what does not meet them is a new defect and
// stands out as before.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "records/judgement.h"

namespace rastercheck::records {

/// What may be asked of a violation's triangle, or of its case: whether it is so. Of a violation
/// without a place, as a crash, some triangle of the case has to be so.
enum class KnownFact {
  nonpositive_w,         ///< some vertex has w <= 0
  clipped,               ///< some vertex is outside the clip volume or the clip distances
  depth_clipped,         ///< some vertex is beyond the near or far plane; none with depth clamp
  clip_distances,        ///< the case has some
  depth_clamp,           ///< the case asks for it
  depth_test,            ///< the case has one
  scissor,               ///< the case has one
  culling,               ///< the case culls front or back faces
  reversed_depth_range,  ///< the viewport's min_depth is above its max_depth
  negative_height,       ///< the viewport's is
  fractional_viewport,   ///< some edge of the viewport is between two pixels
};
constexpr auto names_of(KnownFact /*type*/) {
  return std::to_array<std::string_view>(
      {"nonpositive_w", "clipped", "depth_clipped", "clip_distances", "depth_clamp", "depth_test",
       "scissor", "culling", "reversed_depth_range", "negative_height", "fractional_viewport"});
}

/// What may be measured, and on which side of a number it has to be; both inclusive. What has no
/// such measure, as an attribute of a violation that is of none, is on neither.
enum class KnownLimit {
  error_at_most,                ///< of the violation, in scale ULP; numbers only
  distance_at_most,             ///< of coverage: to the boundary that decided, in pixels
  largest_coordinate_at_least,  ///< of the vertices' window positions, in pixels; infinite for w =
                                ///< 0
  w_ratio_at_least,             ///< largest |w| of the vertices to their least
  height_at_most,          ///< least height of the triangle in the window, in pixels; all w > 0
  largest_value_at_least,  ///< largest magnitude of the attribute at the vertices
  least_value_at_most,     ///< least magnitude above 0 of it
};
constexpr auto names_of(KnownLimit /*type*/) {
  return std::to_array<std::string_view>(
      {"error_at_most", "distance_at_most", "largest_coordinate_at_least", "w_ratio_at_least",
       "height_at_most", "largest_value_at_least", "least_value_at_most"});
}
/// Of a limit: whether it is a least.
constexpr bool is_least(KnownLimit limit) { return cases::name_of(limit).ends_with("_at_least"); }

/// All have to be met; of a list, one of its members. What is empty asks for nothing.
struct KnownConditions {
  std::vector<cases::Rules> rules;
  std::vector<int> samples;
  std::vector<AttributeKind> attribute_kinds;        ///< of the violation
  std::vector<cases::Interpolation> interpolations;  ///< of the violation's attribute
  std::vector<cases::Location> locations;            ///< of the violation's attribute
  std::map<KnownFact, bool> facts;                   ///< fact → whether it has to be so
  std::map<KnownLimit, double> limits;
  std::string note;  ///< a part of the violation's note
  bool operator==(const KnownConditions&) const = default;
};

struct KnownEntry {
  std::string id;                       ///< "llvmpipe-3"
  std::string reason;                   ///< one sentence
  std::string rule;                     ///< the section of the specification that it breaks
  std::string finding;                  ///< anchor in docs/findings.md
  std::vector<std::string> laws;        ///< ids, or patterns as of the shell
  std::vector<FragmentClass> verdicts;  ///< classes that its violations have
  KnownConditions when;
  std::string case_file;  ///< that shows it, relative to the list's folder
  bool operator==(const KnownEntry&) const = default;
};

struct KnownList {
  std::string driver;   ///< its name
  std::string version;  ///< of the driver, that the list was made for
  std::vector<KnownEntry> entries;
  bool operator==(const KnownList&) const = default;
};

/// The list that a run held a backend's violations against.
struct KnownOfBackend {
  std::string backend;  ///< specification
  std::string version;  ///< of its driver, which need not be the list's
  KnownList list;
  bool operator==(const KnownOfBackend&) const = default;
};

/// An entry whose own case did not violate its law.
struct UnexpectedPass {
  std::string backend;
  std::string id;
  std::string law;
  /// Whether the driver is of the list's version: the list is stale then. Else it is a warning.
  bool is_same_version = true;
  auto operator<=>(const UnexpectedPass&) const = default;
};

}  // namespace rastercheck::records
