// Files of other programs as `rastercheck import` reads them. An input is the name of an importer
// on a line of its own, followed by the file.

#include <algorithm>
#include <string>

#include "cases/import_process.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input = fuzz::text_of(data, size);
  const std::size_t end = std::min(input.find('\n'), input.size());
  const cases::Importer* importer = cases::find_importer(input.substr(0, end));
  if (importer == nullptr) return 0;
  const std::string_view text = input.substr(std::min(end + 1, input.size()));
  importer->recognises(text);
  const Result<cases::Imported> imported = importer->import(text, "input", {});
  if (!imported) {
    fuzz::expect_one_line(imported.error());
    return 0;
  }
  for (const std::string& note : imported->notes) {
    expect(fuzz::is_one_line(note), "a note is one line");
  }
  fuzz::expect_round_trip(imported->drawn);
  const auto reply = cases::import_from_reply(cases::import_to_reply(imported), "input");
  expect(reply && reply->drawn == imported->drawn, "an answer is the same when read");
  return 0;
}
