// What a program of exec: says (docs/exec-protocol.md): its hello, or the answer to a draw, a line
// and arrays. The first byte selects a hello, or what an answer gives for each sample.

#include <string>

#include "backends/exec/messages.h"
#include "cases/contract.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

/// Two triangles, 4 × 3 pixels of two samples, with two attributes.
cases::Case asked_case() {
  cases::Case c;
  c.framebuffer = {4, 3, 2};
  c.viewport = {0, 0, 4, 3, 0, 1};
  c.positions = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}, {1, 1, 0, 1}};
  c.attributes = {{"u", cases::Interpolation::smooth, cases::Location::sample},
                  {"v", cases::Interpolation::flat, cases::Location::sample}};
  c.attribute_values = {8, 1, 16, 2, 24, 3, 32, 4};
  c.triangles = {{0, 1, 2}, {2, 1, 3}};
  return c;
}

void read_hello(std::string_view line) {
  const Result<backends::ProgramHello> hello = backends::parse_hello(line);
  if (!hello) return fuzz::expect_one_line(hello.error());
  expect(fuzz::is_one_line(hello->name), "a name is one line");
  expect(fuzz::is_one_line(hello->version), "a version is one line");
  backends::contract_of(*hello, asked_case());
}

void read_answer(std::string_view text, backends::Gives gives) {
  const cases::Case c = asked_case();
  const std::size_t end = text.find('\n');
  const auto header = backends::parse_answer(text.substr(0, end), gives, c);
  if (!header) return fuzz::expect_one_line(header.error());
  if (header->status != backends::AnswerHeader::Status::ok || end == std::string_view::npos) return;
  std::string arrays(text.substr(end + 1));
  arrays.resize(header->bytes);
  for (const std::optional<std::uint32_t> alone : {std::optional<std::uint32_t>(), {1}}) {
    cases::FragmentCollector fragments(c);
    if (!backends::add_answer(*header, arrays, gives, c, alone, fragments).empty()) continue;
    const auto drawn = fragments.take();
    expect(drawn.has_value(), "an answer has no sample twice");
    expect(drawn->size() <= header->pixels() * 2, "no more fragments than samples");
    for (std::size_t i = 0; i < drawn->size(); ++i) {
      const cases::SamplePlace at = drawn->place_of(i);
      expect(at.triangle < 2 && at.x >= header->min_x && at.x < header->max_x &&
                 at.y >= header->min_y && at.y < header->max_y && at.sample < 2,
             "each fragment is of the draw, and in the rectangle");
      expect(!alone || at.triangle == *alone, "a triangle drawn alone is the only one");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text = fuzz::text_of(data, size).substr(1);
  switch (data[0] % 5) {
    case 0:
      read_hello(text);
      break;
    case 1:
      read_answer(text, backends::Gives::triangle);
      break;
    case 2:
      read_answer(text, backends::Gives::depth);
      break;
    case 3:
      read_answer(text, backends::Gives::barycentrics);
      break;
    default:
      read_answer(text, backends::Gives::attributes);
  }
  return 0;
}
