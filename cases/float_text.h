#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rastercheck::cases {

/// Parses a C99 hex-float text ("0x1.8p-2", "-0X3p4"). Empty if the text as a whole is not a hex
/// float, or if its value is not exactly a finite float32. A point needs digits on both sides:
/// "0x.8p0" and "0x1.p0" are refused. Significant digits are counted before parsing: a text with
/// more of them than a float32 holds is refused, not rounded.
std::optional<float> float_from_hex(std::string_view text);

/// True if the text has the form of a hex float, whatever its value.
bool is_hex_float(std::string_view text);

/// Converts a double to the equal float32; empty for NaN, infinity and values that float32 cannot
/// hold.
std::optional<float> exact_float(double value);

/// The shortest C99 hex-float text of a value; "-0x0p+0" for minus zero; "nan", "inf", "-nan" or
/// "-inf" for non-finite values.
std::string to_hex(float value);

}  // namespace rastercheck::cases
