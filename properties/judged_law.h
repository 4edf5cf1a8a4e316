#pragma once

// What laws have in common: a framebuffer held against the contract, and findings put together.

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

/// What of a judged framebuffer is a violation. Statistics cover all that was judged either way.
struct JudgeRequest {
  bool judges_values = true;    ///< whether values are judged, and violations where not correct
  bool counts_coverage = true;  ///< whether missing, extra and hidden samples are violations
};

/// Judges what was drawn of `truth_of`, a case without a camera, or of another case with the same
/// triangles, by the contract.
Check judge_drawn(const cases::Case& truth_of, const cases::Contract& contract,
                  const cases::Fragments& drawn, const JudgeRequest& request, std::uint64_t index);

/// Draws the case and judges that. Fails where the backend cannot draw it.
Result<Check> check_judged(const cases::ClipCase& c, backends::Backend& backend,
                           const JudgeRequest& request, std::uint64_t index);

/// Draws the case, and says what is found of that. Fails where the backend cannot draw it.
Result<Check> check_drawn(
    const cases::ClipCase& c, backends::Backend& backend,
    const std::function<Check(const cases::ClipCase&, const backends::Drawn&)>& find);

/// What a law finds of a case that it says nothing of; why, unless it is plain from `exceptions` or
/// from what the law is about (Check::why_not).
Check not_applicable(std::string_view why = "");

/// Whether a place is of a pixel and a sample that the case's target has.
bool is_sample_of(const cases::Case& c, const cases::SamplePlace& place);

/// The violation that a judged sample, or one value of it, is. `value` is nullptr where coverage is
/// meant; `truth` is nullptr where the case has no such triangle.
records::Violation to_violation(const oracle::JudgedSample& sample,
                                const oracle::JudgedValue* value,
                                const oracle::TriangleTruth* truth,
                                const oracle::SceneTruth& scene);

/// A computed value for readers: decimal and hex float, or "nan", "inf", "-inf".
std::string value_text(float value);

/// Adds a violation that the judge has counted in its class: counted always, kept while few.
void add_judged_violation(Check& check, const records::Violation& violation);

/// Adds a violation that a law found itself, and counts it in its class, too.
void add_violation(Check& check, const records::Violation& violation);

/// Adds a label that the case reached; they stay in order, each once.
void add_label(Check& check, std::string_view label);

/// Adds what another drawing of the same case gave: statistics, violations, labels.
void merge(Check& into, const Check& from);

/// The labels of a case's state, of its triangles that drew something: "several samples", "depth
/// test", "w <= 0", "clipped".
void add_state_labels(const cases::Case& c, const std::set<std::uint32_t>& drawn_triangles,
                      std::set<std::string>& labels);

}  // namespace rastercheck::properties
