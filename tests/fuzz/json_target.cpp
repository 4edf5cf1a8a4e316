// The JSON parser below all readers, and the functions that turn arbitrary bytes into lines of
// messages.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "cases/json.h"
#include "tests/fuzz/target.h"

namespace {

using nlohmann::json;
using namespace rastercheck;
using fuzz::expect;

std::size_t depth_of(const json& value) {
  std::size_t deepest = 0;
  for (const json& member : value) {
    if (member.is_structured()) deepest = std::max(deepest, depth_of(member));
  }
  return deepest + 1;
}

void check_document(const json& document) {
  expect(!document.is_structured() || depth_of(document) <= cases::kMaxJsonDepth,
         "a document is no deeper than allowed");
  const std::string text = document.dump();
  const Result<json> again = cases::parse_json(text, "again");
  expect(again.has_value(), "JSON that was written can be read");
  expect(*again == document && again->dump() == text, "JSON that was written is read as the same");
}

void check_texts(std::string_view bytes) {
  const Result<json> quoted = cases::parse_json(cases::json_string(bytes), "quoted");
  expect(bytes.find('\0') != std::string_view::npos || quoted.has_value(), "a JSON string is JSON");
  expect(!quoted || quoted->get<std::string>() == cases::valid_utf8(bytes),
         "a JSON string is the text with its bytes made UTF-8");
  expect(fuzz::is_one_line(cases::printable(bytes)), "a printable text is one line");
  expect(fuzz::is_one_line(cases::child_pointer("", cases::valid_utf8(bytes))),
         "a JSON pointer is one line");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const Result<json> document = cases::parse_json(text, "input");
  if (document) {
    check_document(*document);
  } else {
    fuzz::expect_one_line(document.error());
  }
  check_texts(text);
  return 0;
}
