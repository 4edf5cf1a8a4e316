#pragma once

// Checks that the judge's levels agree (oracle/judge.h) in everything except which level answered
// and how narrow its enclosures are.

#include <array>
#include <string>
#include <vector>

#include "oracle/judge.h"

namespace rastercheck::oracle {

inline constexpr std::array<Level, 3> kLevels{Level::filter, Level::interval, Level::exact};

/// Options of a judgement that starts at this level, without the referee.
inline JudgeOptions from(Level level, unsigned jobs = 1) {
  return {.self_check_one_in = 0, .first_level = level, .jobs = jobs};
}

/// The result of a judgement, and the samples that it handed out, in their order.
struct Outcome {
  JudgedDrawing judged;
  std::vector<JudgedSample> samples;
};
Outcome outcome_of(const SceneTruth& scene, const cases::Fragments& drawn,
                   const JudgeOptions& options);

/// Returns the first thing in which the outcomes of two levels differ but must not; empty if there
/// is none.
std::string difference(const Outcome& a, const Outcome& b);

/// Like difference(), for outcomes that must be equal to the last bit.
std::string difference_in_bits(const Outcome& a, const Outcome& b);

/// Checks all that must hold for a drawing, and describes the first failure: the levels agree and
/// answer each question once; threads and observers change nothing; only ordinary samples can be
/// hidden.
std::string disagreement(const SceneTruth& scene, const cases::Fragments& drawn);

/// Compares the verdicts of all samples, at each level, with TriangleTruth::judge, and those of the
/// exact level with the referee. Returns the first difference, or an empty string. For cases
/// without a depth test.
std::string wrong_verdict(const SceneTruth& scene);

}  // namespace rastercheck::oracle
