#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rastercheck::reports {

/// Two numbers, the lower one first; equal for a single number.
struct NumberRange {
  double lo = 0;
  double hi = 0;
};

/// The doubles nearest to an exact value or an observed one: a fraction ("1/3"), a range of two
/// ("[1/3, 1/2]"), or a decimal with its hex float ("0.5 (0x1p-1)"). Empty if the text is none of
/// these, or if a number is not finite or has digits left out.
std::optional<NumberRange> numbers_in(const std::string& text);

/// Formats an exact value, which is a fraction or a range between two, and adds decimals if they
/// help. Takes at most `most` characters, not counting the decimals, by eliding. If `most` is 0,
/// takes as many as a message may have.
std::string exact_text(const std::string& exact, std::size_t most = 0);

/// Returns the fewest digits, at least 3, with which the drawn number and the two ends of the
/// permitted range `right` all look different.
int distinct_digits(double drawn, const NumberRange& right);

}  // namespace rastercheck::reports
