#pragma once

// A backend's known defects, as plain data, and the results of a run for them. A list comes from
// backends/DRIVER/known.json, from known.json beside a plugin, or from any other file.
// docs/known-defects.md explains how to maintain one.
//
// An entry's conditions must be as narrow as the defect: a violation that does not meet them is a
// new defect and is reported as such.

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

/// A yes/no condition on a violation's triangle or case. If the violation has no place (a crash),
/// one triangle of the case must meet the condition.
enum class KnownFact {
  nonpositive_w,         ///< some vertex has w <= 0
  clipped,               ///< some vertex is outside the clip volume or the clip distances
  depth_clipped,         ///< some vertex is beyond the near or far plane; false with depth clamp
  before_near,           ///< some vertex with w > 0 is before the near plane, depth clamp or not
  beyond_far,            ///< some vertex with w > 0 is beyond the far plane, depth clamp or not
  perspective,           ///< w differs between vertices
  tie,                   ///< for coverage: the sample lies exactly on the deciding boundary
  degenerate,            ///< for coverage: the triangle has no area, or is seen edge-on
  clip_distances,        ///< the case has clip distances
  depth_clamp,           ///< the case asks for depth clamp
  depth_test,            ///< the case has a depth test
  depth_clear,           ///< the case sets the initial depth
  depth_bias,            ///< the case adds a bias to depths
  unorm_depth,           ///< the case stores depths in a unorm format
  snapped,               ///< the case asks for positions on a grid
  scissor,               ///< the case has a scissor
  culling,               ///< the case culls front or back faces
  reversed_depth_range,  ///< the viewport's min_depth is above its max_depth
  negative_height,       ///< the viewport's height is negative
  fractional_viewport,   ///< some edge of the viewport is between two pixels
  beyond_viewport,       ///< the violation's pixel has its centre outside the viewport
};
constexpr auto names_of(KnownFact /*type*/) {
  return std::to_array<std::string_view>({"nonpositive_w",
                                          "clipped",
                                          "depth_clipped",
                                          "before_near",
                                          "beyond_far",
                                          "perspective",
                                          "tie",
                                          "degenerate",
                                          "clip_distances",
                                          "depth_clamp",
                                          "depth_test",
                                          "depth_clear",
                                          "depth_bias",
                                          "unorm_depth",
                                          "snapped",
                                          "scissor",
                                          "culling",
                                          "reversed_depth_range",
                                          "negative_height",
                                          "fractional_viewport",
                                          "beyond_viewport"});
}

/// A measure, and the side of a number on which it must lie, inclusive. A violation that lacks the
/// measure (an attribute's, say) matches neither side.
enum class KnownLimit {
  error_at_most,                ///< error of the violation, in scale ULP; never met if the value is
                                ///< not a number
  distance_at_most,             ///< for coverage: distance to the deciding boundary, in pixels
  largest_coordinate_at_least,  ///< largest coordinate of the vertices' window positions, in
                                ///< pixels; infinite if w = 0
  w_ratio_at_least,             ///< ratio of the vertices' largest |w| to their least
  height_at_most,          ///< least height of the triangle in the window, in pixels; all w > 0
  largest_value_at_least,  ///< largest magnitude of the attribute at the vertices
  least_value_at_most,     ///< least nonzero magnitude of the attribute
  point_size_at_most,      ///< of a case of points, in pixels
};
constexpr auto names_of(KnownLimit /*type*/) {
  return std::to_array<std::string_view>(
      {"error_at_most", "distance_at_most", "largest_coordinate_at_least", "w_ratio_at_least",
       "height_at_most", "largest_value_at_least", "least_value_at_most", "point_size_at_most"});
}
/// True if the limit is a lower bound.
constexpr bool is_least(KnownLimit limit) { return cases::name_of(limit).ends_with("_at_least"); }

/// A violation must meet every member; of a list, one element is enough. An empty member imposes
/// nothing.
struct KnownConditions {
  std::vector<cases::Rules> rules;
  std::vector<cases::Primitive> primitives;
  std::vector<int> samples;
  std::vector<AttributeKind> attribute_kinds;        ///< the violation's kind
  std::vector<cases::Interpolation> interpolations;  ///< interpolation of the violation's attribute
  std::vector<cases::Location> locations;            ///< location of the violation's attribute
  std::map<KnownFact, bool> facts;                   ///< fact → required value
  std::map<KnownLimit, double> limits;
  std::string note;  ///< must be part of the violation's note
  bool operator==(const KnownConditions&) const = default;
};

/// The expected result of a law named in an expectation list (expectations.h).
enum class Expected {
  fail,   ///< the law is violated
  flake,  ///< the law is sometimes violated
  skip,   ///< the law is not checked at all
};
constexpr auto names_of(Expected /*type*/) {
  return std::to_array<std::string_view>({"fail", "flake", "skip"});
}

struct KnownEntry {
  std::string id;         ///< "llvmpipe-3"
  std::string reason;     ///< one sentence
  std::string rule = {};  ///< the section of the specification that the defect breaks; may be empty
  std::string finding = {};  ///< anchor in docs/findings.md; may be empty
  /// Backends that the entry applies to: specifications (for a plugin, the file's name without its
  /// path) or shell patterns. Empty: every backend that the list is read for.
  std::vector<std::string> backends = {};
  /// Law ids or shell patterns. Empty: the entry describes the drawing, and applies to every law.
  std::vector<std::string> laws = {};
  std::vector<FragmentClass> verdicts = {};  ///< classes of its violations
  KnownConditions when = {};
  std::string case_file = {};  ///< a case that shows the defect, relative to the list's folder
  std::string until = {};      ///< last day, "2027-01-31", UTC; empty: no end
  /// Set for a line of an expectation list: the entry matches every violation of its laws and has
  /// no verdicts, conditions or case.
  std::optional<Expected> expected = std::nullopt;
  bool operator==(const KnownEntry&) const = default;
};

/// The driver that a list describes.
struct KnownDriver {
  std::string name;     ///< "llvmpipe"
  std::string version;  ///< the version that the list describes
  bool operator==(const KnownDriver&) const = default;
};

struct KnownList {
  std::optional<KnownDriver> driver;  ///< empty: applies to any backend that the list is read for
  std::vector<KnownEntry> entries;
  bool operator==(const KnownList&) const = default;
};

/// A list that a run compared a backend's violations with.
struct KnownOfBackend {
  std::string backend;  ///< specification
  std::string file;     ///< the list's file
  /// The driver's version, which may differ from the list's; empty: no driver.
  std::string version;
  KnownList list;                         ///< only entries that apply to the backend
  std::vector<std::string> run_out = {};  ///< ids of entries past their last day
  bool operator==(const KnownOfBackend&) const = default;
};

/// How to treat an entry whose defect no longer shows.
enum class Staleness {
  wrong_list,     ///< the driver has the list's version: counts as a violation
  other_version,  ///< the driver may have been fixed
  waiver,         ///< the list is not a driver's: the author may drop the entry
};
constexpr auto names_of(Staleness /*type*/) {
  return std::to_array<std::string_view>({"wrong list", "other version", "waiver"});
}

/// An entry whose defect no longer shows: its own case did not violate its law, or all its laws
/// held.
struct UnexpectedPass {
  std::string backend;
  std::string id;
  std::string law;  ///< a pattern if the expectation list has one
  Staleness staleness = Staleness::wrong_list;
  auto operator<=>(const UnexpectedPass&) const = default;
};

/// True if the entry makes the run skip its laws.
bool is_skipped_by(const KnownOfBackend& known, const KnownEntry& entry);
/// True if the entry applies to the law: one of its patterns matches the law's id, or it has no
/// patterns.
bool is_of_law(const KnownEntry& entry, std::string_view law);
/// True if the entry applies to a backend known by one of these names.
bool is_of_backend(const KnownEntry& entry, const std::vector<std::string>& names);

}  // namespace rastercheck::records
