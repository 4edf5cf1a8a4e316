#include "tests/fuzz/target.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include "cases/case_reader.h"
#include "cases/case_writer.h"

namespace rastercheck::fuzz {

std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return size == 0 ? std::string_view()
                   : std::string_view(reinterpret_cast<const char*>(data), size);
}

void expect(bool holds, std::string_view property) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %.*s\n", static_cast<int>(property.size()), property.data());
  std::abort();
}

bool is_one_line(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 || byte == 0x7f) return false;
    // U+0080…U+009F in UTF-8: some terminals have a second escape character in this range.
    const bool is_first_of_two = byte == 0xc2 && i + 1 < text.size();
    if (is_first_of_two && static_cast<unsigned char>(text[i + 1]) < 0xa0) return false;
  }
  return true;
}

void expect_one_line(const Error& error) {
  expect(!error.reason.empty(), "an error has a reason");
  expect(is_one_line(to_string(error)), "an error is one line");
}

void expect_round_trip(const cases::Case& c) {
  const std::string text = cases::to_json(c);
  const Result<cases::Case> again = cases::parse_case(text, "again");
  expect(again.has_value(), "a case that was written can be read");
  expect(*again == c, "a case that was written is read as the same");
  // Numbers that compare equal, such as -0 and 0, have different texts.
  expect(cases::to_json(*again) == text, "a case that was read again is written as the same");
}

}  // namespace rastercheck::fuzz
