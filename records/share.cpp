#include "records/share.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace rastercheck::records {
namespace {

__extension__ using Wide = unsigned __int128;

/// Formats units / 10^decimals without trailing zeros.
std::string units_in_decimals(Wide units, int decimals) {
  std::string digits = fmt::format("{}", units);
  const auto places = static_cast<std::size_t>(decimals);
  if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
  digits.insert(digits.size() - places, ".");
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

}  // namespace

std::string share_text(std::uint64_t part, std::uint64_t whole) {
  assert(part <= whole);
  if (whole == 0) return "–";
  if (part == 0) return "0%";
  if (part == whole) return "100%";

  // With one decimal, `smaller * all` is at most 500 times `whole`; with more, it is less than 100
  // times `whole`. `all` is at most `smaller * all`. So nothing comes near 2^128.
  constexpr Wide kTwoDigits = 10;
  const Wide smaller = std::min(part, whole - part);
  int decimals = 1;
  Wide all = 1000;  // 100 %, in units of the last decimal
  while (smaller * all < kTwoDigits * whole) {
    ++decimals;
    all *= 10;
  }
  const Wide rounded = (2 * smaller * all + whole) / (2 * Wide{whole});
  return units_in_decimals(smaller == part ? rounded : all - rounded, decimals) + "%";
}

std::string levels_text(const LevelCounts& levels, std::uint64_t undecided) {
  const std::uint64_t asked = levels.filter + levels.interval + levels.exact + undecided;
  if (asked == 0) return "";
  return fmt::format("{} by fast arithmetic, {} by interval arithmetic, {} by exact arithmetic",
                     share_text(levels.filter, asked), share_text(levels.interval, asked),
                     share_text(levels.exact, asked));
}

std::string decided_sentence(const Levels& levels, std::uint64_t undecided_samples) {
  if (levels == Levels()) return "";
  std::string sentence;
  if (levels.samples != LevelCounts()) {
    sentence = fmt::format("Samples decided: {}; {} undecided.",
                           levels_text(levels.samples, undecided_samples), undecided_samples);
  }
  if (levels.values != LevelCounts()) {
    sentence += fmt::format("{}Values decided: {}.", sentence.empty() ? "" : " ",
                            levels_text(levels.values, 0));
  }
  return sentence;
}

}  // namespace rastercheck::records
