#pragma once

// Shares of a whole as text that never says "none" or "all" of what is neither.

#include <cstdint>
#include <string>

#include "records/judgement.h"

namespace rastercheck::records {

/// part/whole in percent, "99.99%". The smaller of the share and its rest is rounded to nearest, to
/// two significant digits or the first decimal, whichever is finer, and the larger is 100 less
/// that: so only 0 is "0%", only the whole is "100%", and a share and its rest add up to 100. Needs
/// part <= whole; of a whole of 0 a dash.
std::string share_text(std::uint64_t part, std::uint64_t whole);

/// What each level of the oracle gave of all that was asked:
/// "99.99% by filter, 0.01% by interval, 0.00004% by exact numbers". `undecided` is what was asked
/// without an answer. Empty where nothing was asked.
std::string levels_text(const LevelCounts& levels, std::uint64_t undecided);

/// Both sorts of answers on one line: "Samples decided: 100% by filter, …; 0 undecided. Values
/// decided: 98.7% by filter, …". Empty where no level is known to have answered.
std::string decided_sentence(const Levels& levels, std::uint64_t undecided_samples);

}  // namespace rastercheck::records
