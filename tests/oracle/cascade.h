#pragma once

// What the judge's levels have to agree in (oracle/judge.h): everything but what answered, and how
// narrow the enclosures are that it gave.

#include <array>
#include <string>
#include <vector>

#include "oracle/judge.h"

namespace rastercheck::oracle {

inline constexpr std::array<Level, 3> kLevels{Level::filter, Level::interval, Level::exact};

/// A judgement from that level on, without the referee.
inline JudgeOptions from(Level level, unsigned jobs = 1) {
  return {.self_check_one_in = 0, .first_level = level, .jobs = jobs};
}

/// What a judgement gives, and the samples that it handed out, in their order.
struct Outcome {
  JudgedDrawing judged;
  std::vector<JudgedSample> samples;
};
Outcome outcome_of(const SceneTruth& scene, const cases::Fragments& drawn,
                   const JudgeOptions& options);

/// The first thing in which two levels' outcomes differ and should not; empty where there is none.
std::string difference(const Outcome& a, const Outcome& b);

/// The same of outcomes that are to be equal to the last bit.
std::string difference_in_bits(const Outcome& a, const Outcome& b);

/// All that is to hold of a drawing, in words where it does not: the levels agree, and answered as
/// often as was asked; neither threads nor who watches change anything; what is ordinary can be
/// hidden, and nothing else.
std::string disagreement(const SceneTruth& scene, const cases::Fragments& drawn);

/// Holds the verdicts of all samples, by each level, against TriangleTruth::judge, and the exact
/// triangle's against the referee: the first difference, empty where there is none. Without a depth
/// test.
std::string wrong_verdict(const SceneTruth& scene);

}  // namespace rastercheck::oracle
