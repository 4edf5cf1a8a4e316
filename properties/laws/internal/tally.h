#pragma once

// What laws have in common that find what they find themselves, without a judge.

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "cases/case.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Adds to the note of each violation, the same or what there is to say of it.
void add_to_notes(Check& check, const std::string& text);
void add_to_notes(Check& check,
                  const std::function<std::string(const records::Violation&)>& text_of);

/// What a law finds of a case, sample by sample and value by value.
class Tally {
 public:
  /// The case must outlive it.
  explicit Tally(const cases::Case& c);

  records::Counts& counts() { return check_.judgement.counts; }
  void label(std::string_view text) { labels_.emplace(text); }
  /// A triangle that drew something: the labels of the case's state are those of these.
  void see(std::uint32_t triangle) { triangles_.insert(triangle); }
  /// The label of a case of which something was drawn, where something was.
  void label_drawn();
  /// Samples, or values, that are as they should be.
  void pass(records::AttributeKind kind, std::uint64_t count = 1);
  /// A required sample that the triangle drew.
  void pass_required(std::uint32_t triangle);
  void report(const records::Violation& violation);
  /// Reports a value that was counted as right before.
  void report_passed(const records::Violation& violation);
  /// A part of an error, in the unit of its kind.
  void add_part(records::AttributeKind kind, records::Stratum stratum,
                const records::StagePart& part);

  /// With the labels, those of the state too.
  Check finish();

 private:
  const cases::Case* case_;
  std::set<std::string> labels_;
  std::set<std::uint32_t> triangles_;
  Check check_;
};

}  // namespace rastercheck::properties
