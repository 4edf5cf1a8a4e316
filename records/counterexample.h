#pragma once

// A case that breaks a law, and how.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "cases/names.h"
#include "cases/sample_place.h"
#include "records/enclosure.h"
#include "records/judgement.h"

namespace rastercheck::records {

/// One sample, or one of its values, that a law does not allow.
struct Violation {
  FragmentClass fragment_class = FragmentClass::correct;
  AttributeKind kind = AttributeKind::coverage;
  cases::SamplePlace place = {};
  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes
  /// The exact answer: for coverage the verdict and its reason; for a value a fraction, or
  /// "[fraction, fraction]" if the contract leaves a range.
  std::string exact;
  /// The backend's result: "drawn", "not drawn", a decimal and hex float, "nan", "inf".
  std::string actual;
  /// For a value: the error beyond what the contract leaves open, in scale ULP.
  std::optional<Enclosure> error;
  std::optional<Enclosure> bound;  ///< the promised bound, in the same unit
  /// For coverage: the distance to the deciding boundary, in pixels.
  std::optional<Enclosure> distance;
  std::string note;  ///< the law's remark, one line; may be empty
  bool operator==(const Violation&) const = default;

  /// True if the violation is at a sample. If false, nothing was drawn, and place and exact answer
  /// mean nothing.
  bool has_place() const { return fragment_class < FragmentClass::failed; }
};

/// The source of the failing case, in the order in which a run checks the sources.
enum class Origin { corpus, saved, scene, random };
constexpr auto names_of(Origin /*type*/) {
  return std::to_array<std::string_view>({"corpus", "saved", "scene", "random"});
}
constexpr std::string_view to_string(Origin origin) { return cases::name_of(origin); }

/// Offset of redrawn random cases: case i, generated again k times because no law applied, has
/// number i + k kRedrawn.
inline constexpr std::uint64_t kRedrawn = 1'000'000'000;
/// "case 7 of seed 1", "case 7 of seed 1, drawn again twice".
std::string random_case_text(const cases::Found& found);

/// Returns the kind and the condition of a failing case, omitting the usual kind (coverage) and the
/// usual condition (an ordinary fragment).
std::vector<std::string> special_words(const cases::Found& found);

/// How a case was shrunk.
struct Shrinking {
  std::uint64_t tries = 0;  ///< smaller cases that were checked
  bool is_least = false;    ///< true if no smaller case that was tried fails; false if the budget
                            ///< ran out
  bool operator==(const Shrinking&) const = default;
};

/// A part of a drawing that may be wrong.
enum class DrawnPart {
  coverage,  ///< which samples are drawn, and which triangle is visible
  depth,
  values,  ///< the attributes' values
};
constexpr auto names_of(DrawnPart /*type*/) {
  return std::to_array<std::string_view>({"coverage", "depth", "values"});
}

/// Why a case fails, as far as experiments show (properties/campaign/internal/explanation.h).
struct Explanation {
  /// The smallest set of drawn parts that must be corrected for the law to hold; empty if the law
  /// fails even with all parts corrected.
  std::vector<DrawnPart> parts;
  /// Only without `parts`: the parts that are wrong in the case's own drawing and that, in most
  /// variations of the case, are wrong if and only if the law fails.
  std::vector<DrawnPart> wrong;
  /// Only without `parts`: ids of other laws that the case violates even if every drawn part is
  /// corrected.
  std::vector<std::string> also_violates;
  /// Ids of features that the failure needs, in the features' order: if any of them is removed, the
  /// law holds.
  std::vector<std::string> needs;
  /// Ids of features without which the law does not apply to the case.
  std::vector<std::string> inherent;
  /// Ids of features that were removed without making the law hold.
  std::vector<std::string> indifferent;
  /// Simple changes of the original (not shrunk) case, as clauses ("y points in the other
  /// direction"). Each explains the drawing: what was drawn for the original case in `parts` (or
  /// `wrong`) would be right for the changed case. Empty optional if those parts are right already
  /// or cannot be drawn.
  std::optional<std::vector<std::string>> hints = std::nullopt;
  /// True if the case failed when tried again. If false, all else is empty: the drawing varies from
  /// run to run, or depends on earlier drawings.
  bool fails_again = true;
  bool operator==(const Explanation&) const = default;
};

/// A failing case, saved as a case file. Its `found` names law, backend, verdict, seed and index.
struct Counterexample {
  cases::Case source;
  std::uint64_t violation_count = 0;  ///< number of all violations in the case
  std::vector<Violation> violations;  ///< at most kMostViolations, of as many sorts as possible
  Origin origin = Origin::random;
  std::optional<Shrinking> shrinking = std::nullopt;      ///< empty: not shrunk
  std::optional<Explanation> explanation = std::nullopt;  ///< empty: not tried
  /// The drawing around the first violation, as lines of text; the last lines explain the signs.
  std::vector<std::string> close_up = {};
  bool operator==(const Counterexample&) const = default;

  bool is_shrunk() const { return shrinking && shrinking->tries > 0; }
};

/// Number of violations kept per case.
inline constexpr std::size_t kMostViolations = 8;

}  // namespace rastercheck::records
