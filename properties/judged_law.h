#pragma once

// Shared parts of laws: judging a framebuffer by the contract, and collecting findings.

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "oracle/judge.h"
#include "properties/drawing.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Selects the kinds of errors that count as violations in a judged framebuffer. Statistics cover
/// everything that is judged.
struct JudgeRequest {
  bool judges_values = true;    ///< judges values; incorrect ones are violations
  bool counts_coverage = true;  ///< missing, extra and wrongly visible samples are violations
};

/// Judges, by the contract, a drawing of `truth_of` (a case without a camera) or of another case
/// with the same triangles.
Check judge_drawn(const cases::Case& truth_of, const cases::Contract& contract,
                  const cases::Fragments& drawn, const JudgeRequest& request, std::uint64_t index);

/// Draws the case and judges the drawing. Fails if the backend cannot draw the case.
Result<Check> check_judged(const cases::ClipCase& c, backends::Backend& backend,
                           const JudgeRequest& request, std::uint64_t index);

/// Draws the case and returns what `find` finds. Fails if the backend cannot draw the case.
Result<Check> check_drawn(
    const cases::ClipCase& c, backends::Backend& backend,
    const std::function<Check(const cases::ClipCase&, const backends::Drawn&)>& find);

/// The result for a case to which the law does not apply. `why` (Check::why_not) may be empty if
/// `exceptions` or the law's subject make the reason plain.
Check not_applicable(std::string_view why = "");

/// True if the case's framebuffer has that pixel and sample.
bool is_sample_of(const cases::Case& c, const cases::SamplePlace& place);

/// Makes a violation from a judged sample or one of its values. `value` is nullptr for coverage;
/// `truth` is nullptr if the case has no such triangle.
records::Violation to_violation(const oracle::JudgedSample& sample,
                                const oracle::JudgedValue* value,
                                const oracle::TriangleTruth* truth,
                                const oracle::SceneTruth& scene);

/// A computed value for readers: decimal and hex float, or "nan", "inf", "-inf".
std::string value_text(float value);

/// Adds a violation that the judge already counted in its class. Counts every violation, but keeps
/// only a limited number.
void add_judged_violation(Check& check, const records::Violation& violation);

/// Like add_judged_violation(), and also counts the violation in its class; for violations that a
/// law found itself.
void add_violation(Check& check, const records::Violation& violation);

/// Adds a label that the case reached; labels stay sorted and unique.
void add_label(Check& check, std::string_view label);

/// Adds the results of another drawing of the same case: statistics, violations, labels.
void merge(Check& into, const Check& from);

/// Adds the labels of a case's state and of its triangles that drew something: "several samples",
/// "depth test", "w <= 0", "clipped".
void add_state_labels(const cases::Case& c, const std::set<std::uint32_t>& drawn_triangles,
                      std::set<std::string>& labels);

}  // namespace rastercheck::properties
