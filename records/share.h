#pragma once

// Shares of a whole as text that says "0%" only for nothing and "100%" only for everything.

#include <cstdint>
#include <string>

#include "records/judgement.h"

namespace rastercheck::records {

/// part/whole in percent, "99.99%". The smaller of the share and the remainder is rounded to
/// nearest, to two significant digits or the first decimal, whichever is finer; the larger is 100
/// minus that. So only 0 is "0%", only the whole is "100%", and the two add up to 100. Needs part
/// <= whole; returns a dash if whole is 0.
std::string share_text(std::uint64_t part, std::uint64_t whole);

/// The share of answers that each level of the oracle gave: "99.99% by fast arithmetic, 0.01% by
/// interval arithmetic, 0.00004% by exact arithmetic". `undecided` counts questions without an
/// answer. Empty if nothing was asked.
std::string levels_text(const LevelCounts& levels, std::uint64_t undecided);

/// Answers on samples and on values in one line: "Samples decided: 100% by fast arithmetic, …; 0
/// undecided. Values decided: 98.7% by fast arithmetic, …". Empty if no level gave an answer.
std::string decided_sentence(const Levels& levels, std::uint64_t undecided_samples);

}  // namespace rastercheck::records
