// Hex floats, compared with strtod.

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdlib>
#include <string>

#include "cases/float_text.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

/// A text of at most this many characters cannot name more bits than a double has.
constexpr std::size_t kCertainlyExact = 13;

void check_hex_float(const std::string& text, const std::optional<float>& value) {
  char* end = nullptr;
  const double expected = std::strtod(text.c_str(), &end);
  expect(end == text.c_str() + text.size(), "strtod takes it for a number too");
  if (value) {
    expect(std::bit_cast<std::uint64_t>(double{*value}) == std::bit_cast<std::uint64_t>(expected),
           "the value is strtod's");
  } else if (text.size() <= kCertainlyExact && std::abs(expected) >= DBL_MIN) {
    expect(!cases::exact_float(expected), "what is refused is no float32");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::text_of(data, size));
  const std::optional<float> value = cases::float_from_hex(text);
  if (cases::is_hex_float(text)) {
    check_hex_float(text, value);
  } else {
    expect(!value, "only a hex float has a value");
  }
  if (value) {
    const std::optional<float> again = cases::float_from_hex(cases::to_hex(*value));
    expect(again && std::bit_cast<std::uint32_t>(*again) == std::bit_cast<std::uint32_t>(*value),
           "a value that was written is read as the same");
  }
  return 0;
}
