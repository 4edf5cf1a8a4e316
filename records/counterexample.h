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

/// One sample, or one value of it, that a law does not allow.
struct Violation {
  FragmentClass fragment_class = FragmentClass::correct;
  AttributeKind kind = AttributeKind::coverage;
  cases::SamplePlace place = {};
  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes
  /// What is exactly true there: of coverage the verdict and its reason, of a value a fraction, or
  /// "[fraction, fraction]" where the contract leaves a range.
  std::string exact;
  /// What the backend gave: "drawn", "not drawn", a decimal and hex float, "nan", "inf".
  std::string actual;
  std::optional<Enclosure> error;     ///< of a value, in scale ULP, beyond what is left open
  std::optional<Enclosure> bound;     ///< what the contract promises of it, in the same unit
  std::optional<Enclosure> distance;  ///< of coverage: to the boundary that decided, in pixels
  std::string note;                   ///< what more the law has to say, one line; may be empty
  bool operator==(const Violation&) const = default;

  /// Whether it is at a sample: not where there is no drawing at all. Members of places and exact
  /// answers mean nothing there.
  bool has_place() const { return fragment_class < FragmentClass::failed; }
};

/// Where the case that failed was from, in the order in which a run checks them.
enum class Origin { corpus, saved, scene, random };
constexpr auto names_of(Origin /*type*/) {
  return std::to_array<std::string_view>({"corpus", "saved", "scene", "random"});
}
constexpr std::string_view to_string(Origin origin) { return cases::name_of(origin); }

/// A random case that said nothing may have been drawn again: case i, k times, is number
/// i + k kRedrawn.
inline constexpr std::uint64_t kRedrawn = 1'000'000'000;
/// "case 7 of seed 1", "case 7 of seed 1, drawn again twice".
std::string random_case_text(const cases::Found& found);

/// Gives kind and condition of a case that failed, unless they are what most are of: coverage, and
/// an ordinary fragment.
std::vector<std::string> special_words(const cases::Found& found);

/// How the case became as small as it is.
struct Shrinking {
  std::uint64_t tries = 0;  ///< smaller cases that were checked
  bool is_least = false;    ///< nothing that was tried is smaller; else there was no more time
  bool operator==(const Shrinking&) const = default;
};

/// A part of drawings that may be wrong.
enum class DrawnPart {
  coverage,  ///< which samples are drawn, and of several triangles which one is seen
  depth,
  values,  ///< of attributes
};
constexpr auto names_of(DrawnPart /*type*/) {
  return std::to_array<std::string_view>({"coverage", "depth", "values"});
}

/// Why a case fails, as far as trying told (properties/campaign/internal/explanation.h).
struct Explanation {
  /// The fewest parts that have to be put right in what is drawn of it for the law to hold; none
  /// where it fails all the same.
  std::vector<DrawnPart> parts;
  /// Of a case without `parts`: those that are wrong in a plain drawing of it, and of what it is
  /// changed to, mostly just where the law fails.
  std::vector<DrawnPart> wrong;
  /// Of a case without `parts`: ids of other laws that it violates too, where all that is drawn of
  /// it is put right.
  std::vector<std::string> also_violates;
  /// Ids of what may not be taken away from the case, or the law holds; in their order.
  std::vector<std::string> needs;
  /// Ids of what the law is about, as it says nothing of the case without it.
  std::vector<std::string> inherent;
  /// Ids of what was taken away, and the law failed all the same.
  std::vector<std::string> indifferent;
  bool operator==(const Explanation&) const = default;
};

/// The case's `found` names law, backend, verdict, seed and index. It is saved as a case file.
struct Counterexample {
  cases::Case source;
  std::uint64_t violation_count = 0;  ///< of all in the case
  std::vector<Violation> violations;  ///< the first of them
  Origin origin = Origin::random;
  std::optional<Shrinking> shrinking = std::nullopt;      ///< nothing: left as it was found
  std::optional<Explanation> explanation = std::nullopt;  ///< nothing: nothing was tried
  /// What was drawn around the first violation, as lines of text; the last ones say what the signs
  /// mean.
  std::vector<std::string> close_up = {};
  bool operator==(const Counterexample&) const = default;

  bool is_shrunk() const { return shrinking && shrinking->tries > 0; }
};

/// At most so many violations of a case are kept.
inline constexpr std::size_t kMostViolations = 8;

}  // namespace rastercheck::records
