#pragma once

// Shared wording of comparisons, for all formats.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/comparison.h"
#include "records/stage_split.h"
#include "reports/compare_format.h"

namespace rastercheck::reports {

/// "Regression: 3 of 512 entries are worse than the baseline of cpu on x86_64.", then the numbers
/// of allowed, better, new and gone entries, if there are any.
std::string verdict_sentence(const records::Comparison& comparison);

/// Says how many cases are the same to the bit, and what that means for the other cases.
std::string bits_sentence(const records::Comparison& comparison);

/// The texts of two sizes, with enough digits to differ if their doubles differ.
struct OldAndNew {
  std::string before;
  std::string after;
};
OldAndNew figure_texts(const records::FigureChange& change);

/// "worst 0.5 → 0.731 ULP", "missing 0 → 3".
std::string figure_sentence(const records::FigureChange& change);

/// "random case 12"; "case 3 of the corpus, “name”".
std::string case_text(const records::CaseGrowth& growth);

/// "smooth, sliver, triangle 0, pixel (3, 5), sample 0, attribute 1".
std::string place_text(const records::CaseGrowth& growth, const records::WorstError& at);

/// Labels of the lines about a case's outcome and about the number of wrong samples and values.
inline constexpr std::string_view kOutcomeLine = "outcome: ";
inline constexpr std::string_view kMismatchesLine = "wrong samples and values: ";

/// Lines with the sizes of both errors, exact and actual values, outcomes, and counts of wrong
/// samples and values.
std::vector<std::string> growth_lines(const records::CaseGrowth& growth);

/// "smooth, all strata: set-up made 0.01 → 0.2 ULP on average, 5.3% → 52% of all parts". The
/// largest come first, at most `most` lines. Empty if no law splits errors or no part grew.
std::vector<std::string> stage_lines(const records::Comparison& comparison, std::size_t most);

/// The inspection of a grown case; nullptr if it was not inspected.
const records::CloserLook* find_look(const Gate& gate, const records::Comparison& comparison,
                                     const records::CaseGrowth& growth);

/// The stage, other than the final rounding, that made most of a grown error, and its part of the
/// error. Empty if the case was not drawn again, or if the whole error comes from that rounding.
/// Also empty if the backend reports no stages: then the error is only split at the contract's
/// limit, which does not show what to fix.
std::optional<records::StagePart> part_to_look_at(const Gate& gate,
                                                  const records::Comparison& comparison,
                                                  const records::CaseGrowth& growth);

/// The commands that check and explain a grown case; empty if the case is not saved.
std::vector<std::string> growth_commands(const Gate& gate, const records::Comparison& comparison,
                                         const records::CaseGrowth& growth);

/// The command `rastercheck baseline approve …` for the two files.
std::string approve_command(const Gate& gate);

}  // namespace rastercheck::reports
