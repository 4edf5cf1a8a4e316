#pragma once

// How what a comparison found is put, in all its forms.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/comparison.h"
#include "records/stage_split.h"
#include "reports/compare_format.h"

namespace rastercheck::reports {

/// "Regression: 3 of 512 entries are worse than the baseline of cpu on x86_64."; what else there is
/// of others: allowed, better, new, gone.
std::string verdict_sentence(const records::Comparison& comparison);

/// What is the same, to the bit: of how many cases, and what that means for those that are not.
std::string bits_sentence(const records::Comparison& comparison);

/// Two sizes in so many digits that they differ, where doubles tell them apart.
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

/// What became of the case, and how much of it came out wrong: how these lines begin.
inline constexpr std::string_view kOutcomeLine = "outcome: ";
inline constexpr std::string_view kMismatchesLine = "came out wrong: ";

/// One line each: sizes of both errors, exact and actual values, outcomes, counts of what came out
/// wrong.
std::vector<std::string> growth_lines(const records::CaseGrowth& growth);

/// "smooth, all strata: set-up made 0.01 → 0.2 ULP on average, 5.3% → 52% of all parts", by the
/// most first; empty where no law splits errors, or no part grew.
std::vector<std::string> stage_lines(const records::Comparison& comparison, std::size_t most);

/// What was looked at of a grown case; nullptr where nothing was.
const records::CloserLook* find_look(const Gate& gate, const records::Comparison& comparison,
                                     const records::CaseGrowth& growth);

/// The stage that made most of a grown error, the rounding at the end aside, and its part; nothing
/// where the case was not drawn again, or all of the error is that rounding, or the backend tells
/// of no stages: what its contract leaves open and what is beyond that is nothing to look at.
std::optional<records::StagePart> part_to_look_at(const Gate& gate,
                                                  const records::Comparison& comparison,
                                                  const records::CaseGrowth& growth);

/// What checks and what explains a grown case again; empty where they are not saved.
std::vector<std::string> growth_commands(const Gate& gate, const records::Comparison& comparison,
                                         const records::CaseGrowth& growth);

/// `rastercheck baseline approve …` for the two files.
std::string approve_command(const Gate& gate);

}  // namespace rastercheck::reports
