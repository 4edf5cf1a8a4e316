#pragma once

// Wording about two backends side by side that all forms of a report share.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "records/run.h"
#include "records/side_by_side.h"

namespace rastercheck::reports {

inline constexpr std::string_view kSideBySideSentence =
    "Each backend is held to its own contract, so two backends may both be right and draw "
    "different values. A known defect counts as wrong.";

/// "Compared on 5,567 cases, the same on both. cpu was judged on 6,000 cases in all, gl:llvmpipe on
/// 5,730; …"; or that there is no case to compare.
std::string compared_sentence(const records::SideBySide& pair);

/// How the cases divide, as term and number: "both right", "only cpu right", "only gl:llvmpipe
/// right", "neither right".
std::vector<std::pair<std::string, std::uint64_t>> side_counts(const records::SideBySide& pair);

/// "Of the wrong cases, 5 on gl:llvmpipe are known defects."; empty if none are.
std::string known_sentence(const records::SideBySide& pair);

/// The laws on which the backends differ, those with the most such cases first.
std::vector<records::SideBySideLaw> differing_laws(const records::SideBySide& pair);

/// One direction of a disagreement: the law holds on `right` and fails on `wrong`.
struct Disagreement {
  std::string law;
  std::string right;
  std::string wrong;
  std::uint64_t cases = 0;
  std::vector<records::CasePlace> places;  ///< the first of these cases
};
/// The disagreements of a law, none to two of them: those in which the first backend is right come
/// first.
std::vector<Disagreement> disagreements_of(const records::SideBySide& pair,
                                           const records::SideBySideLaw& law);

/// The saved first case of a disagreement; nullptr if the run has none.
const records::Difference* difference_of(const records::Run& run, const Disagreement& disagreement);

/// "random case 12", "corpus cases 3 “a sliver”, 4; random case 0, …". The first case has its name,
/// if it is saved and has one.
std::string places_text(const records::Run& run, const Disagreement& disagreement);

/// The commands that check the first case of a disagreement on the backend that is wrong, then on
/// the other; `file` is where the case is saved.
std::vector<std::string> look_commands(const records::Run& run, const std::string& file,
                                       const Disagreement& disagreement);

}  // namespace rastercheck::reports
