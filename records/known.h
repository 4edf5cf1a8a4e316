#pragma once

// What is known to be wrong with a backend, as plain data: backends/DRIVER/known.json of a driver,
// known.json beside a plugin, or a file of any name; and what a run found of it.
// docs/known-defects.md says how such a list is kept.
//
// An entry has conditions, as narrow as the defect is: what does not meet them is a new defect and
// stands out as before.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
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
  before_near,           ///< some vertex with w > 0 is before the near plane, depth clamp or not
  beyond_far,            ///< the same of the far plane
  perspective,           ///< w differs between vertices
  tie,                   ///< of coverage: the sample lies exactly on the boundary that decided
  degenerate,            ///< of coverage: the triangle has no area, or is seen edge-on
  clip_distances,        ///< the case has some
  depth_clamp,           ///< the case asks for it
  depth_test,            ///< the case has one
  depth_clear,           ///< the case says what the depth buffer begins with
  snapped,               ///< the case asks for positions on a grid
  scissor,               ///< the case has one
  culling,               ///< the case culls front or back faces
  reversed_depth_range,  ///< the viewport's min_depth is above its max_depth
  negative_height,       ///< the viewport's is
  fractional_viewport,   ///< some edge of the viewport is between two pixels
};
constexpr auto names_of(KnownFact /*type*/) {
  return std::to_array<std::string_view>(
      {"nonpositive_w", "clipped", "depth_clipped", "before_near", "beyond_far", "perspective",
       "tie", "degenerate", "clip_distances", "depth_clamp", "depth_test", "depth_clear", "snapped",
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

/// How a law that an expectation list names is to come out (expectations.h).
enum class Expected {
  fail,   ///< it is violated
  flake,  ///< it is violated at times
  skip,   ///< it is not to be checked at all
};
constexpr auto names_of(Expected /*type*/) {
  return std::to_array<std::string_view>({"fail", "flake", "skip"});
}

struct KnownEntry {
  std::string id;            ///< "llvmpipe-3"
  std::string reason;        ///< one sentence
  std::string rule = {};     ///< the section of the specification that it breaks; may be empty
  std::string finding = {};  ///< anchor in docs/findings.md; may be empty
  /// Backends that it is of: specifications, of a plugin with the file's name in place of its path,
  /// or patterns as of the shell. None: all that the list is read for.
  std::vector<std::string> backends = {};
  /// Ids of laws, or patterns as of the shell. None: it is of what is drawn, whatever law notices.
  std::vector<std::string> laws = {};
  std::vector<FragmentClass> verdicts = {};  ///< classes that its violations have
  KnownConditions when = {};
  std::string case_file = {};  ///< that shows it, relative to the list's folder
  std::string until = {};      ///< its last day, "2027-01-31", UTC; empty: it has none
  /// Set for a line of an expectation list: all violations of its laws are of it, and it has no
  /// verdicts, conditions or case.
  std::optional<Expected> expected = std::nullopt;
  bool operator==(const KnownEntry&) const = default;
};

/// A driver that a list is of.
struct KnownDriver {
  std::string name;     ///< "llvmpipe"
  std::string version;  ///< that the list was made for
  bool operator==(const KnownDriver&) const = default;
};

struct KnownList {
  std::optional<KnownDriver> driver;  ///< nothing: it is of whatever backend it is read for
  std::vector<KnownEntry> entries;
  bool operator==(const KnownList&) const = default;
};

/// A list that a run held a backend's violations against.
struct KnownOfBackend {
  std::string backend;  ///< specification
  std::string file;     ///< of the list
  std::string version;  ///< of the backend's driver, which need not be the list's; empty: of none
  KnownList list;       ///< with those entries that are of the backend
  std::vector<std::string> run_out = {};  ///< ids of entries whose last day was over
  bool operator==(const KnownOfBackend&) const = default;
};

/// Tells what it means that an entry no longer shows.
enum class Staleness {
  wrong_list,     ///< the driver is of the list's version: counts as a violation
  other_version,  ///< the driver may have been mended
  waiver,         ///< of no driver: whoever wrote it may drop it
};
constexpr auto names_of(Staleness /*type*/) {
  return std::to_array<std::string_view>({"wrong list", "other version", "waiver"});
}

/// An entry whose own case did not violate its law, or whose laws all held.
struct UnexpectedPass {
  std::string backend;
  std::string id;
  std::string law;  ///< a pattern, of an expectation list that has one
  Staleness staleness = Staleness::wrong_list;
  auto operator<=>(const UnexpectedPass&) const = default;
};

/// Whether an entry of a list has its laws skipped.
bool is_skipped_by(const KnownOfBackend& known, const KnownEntry& entry);
/// Whether an entry is of a law: one of its patterns is the law's id, or it has none.
bool is_of_law(const KnownEntry& entry, std::string_view law);
/// Whether it is of a backend that is called by one of these names.
bool is_of_backend(const KnownEntry& entry, const std::vector<std::string>& names);

}  // namespace rastercheck::records
