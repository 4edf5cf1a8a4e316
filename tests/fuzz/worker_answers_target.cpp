// The answers of a process that draws with foreign code: its greeting, contracts, drawings, answers
// to occlusion queries. The first byte selects one of them.

#include "backends/internal/wire.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

/// Expects that writing what was read gives the same bytes again: each value has only one encoding.
template <typename T>
void check_same(const std::optional<T>& read, std::string_view bytes) {
  if (read) expect(backends::pack(*read) == bytes, "what was read is written as the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes = fuzz::text_of(data, size).substr(1);
  switch (data[0] % 4) {
    case 0:
      check_same(backends::unpack_drawing(bytes), bytes);
      break;
    case 1:
      check_same(backends::unpack_contract(bytes), bytes);
      break;
    case 2:
      check_same(backends::unpack_greeting(bytes), bytes);
      break;
    default:
      check_same(backends::unpack_occlusion(bytes), bytes);
  }
  return 0;
}
