#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rastercheck::cases {

/// The float32 that a C99 hex-float text ("0x1.8p-2", "-0X3p4") names. Nothing if the text is not a
/// hex float from first to last character, or if its value is not exactly a finite float32; the
/// value is taken digit by digit, so no rounding can hide a difference.
std::optional<float> float_from_hex(std::string_view text);

/// Whether the text has the form of a hex float, whatever its value.
bool is_hex_float(std::string_view text);

/// The float32 that a double is exactly; nothing for one that float32 cannot hold, NaN or infinity.
std::optional<float> exact_float(double value);

/// The shortest C99 hex-float text of a value; "-0x0p+0" for minus zero, "nan" and "inf" for what
/// is no number.
std::string to_hex(float value);

}  // namespace rastercheck::cases
