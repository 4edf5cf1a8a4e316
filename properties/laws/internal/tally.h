#pragma once

// For laws that judge drawings themselves, without the oracle's judge.

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "cases/case.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Adds a text to the note of each violation: the same text for all, or one made for each
/// violation.
void add_to_notes(Check& check, const std::string& text);
void add_to_notes(Check& check,
                  const std::function<std::string(const records::Violation&)>& text_of);

/// Collects what a law finds in a case, sample by sample and value by value.
class Tally {
 public:
  /// The case must outlive this object.
  explicit Tally(const cases::Case& c);

  records::Counts& counts() { return check_.judgement.counts; }
  void label(std::string_view text) { labels_.emplace(text); }
  /// Notes a triangle that drew something; only such triangles give state labels.
  void see(std::uint32_t triangle) { triangles_.insert(triangle); }
  /// Adds the label "drawn" if any triangle has drawn something.
  void label_drawn();
  /// Counts correct samples or values.
  void pass(records::AttributeKind kind, std::uint64_t count = 1);
  /// Counts a required sample that the triangle drew.
  void pass_required(std::uint32_t triangle);
  void report(const records::Violation& violation);
  /// Reports a value that was already counted as correct.
  void report_passed(const records::Violation& violation);
  /// Adds one stage's part of an error, in the unit of the error's kind.
  void add_part(records::AttributeKind kind, records::Stratum stratum,
                const records::StagePart& part);

  /// Adds the levels of the oracle's cascade that decided samples.
  void add_levels(const records::LevelCounts& samples);

  /// Returns the check with all labels, including those of the state.
  Check finish();

 private:
  const cases::Case* case_;
  std::set<std::string> labels_;
  std::set<std::uint32_t> triangles_;
  Check check_;
};

}  // namespace rastercheck::properties
