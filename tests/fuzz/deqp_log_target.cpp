// Logs of dEQP as `rastercheck deqp` reads them, up to the cases of their drawings. The pictures in
// them have a target of their own.

#include "cases/deqp_log.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto tests = cases::parse_deqp_log(fuzz::text_of(data, size), "input");
  if (!tests) {
    fuzz::expect_one_line(tests.error());
    return 0;
  }
  for (const cases::DeqpTest& test : *tests) {
    expect(!test.drawings.empty() || !test.reason.empty(), "what has no drawing says why");
    for (const cases::DeqpDrawing& drawing : test.drawings) {
      const cases::Case c = cases::case_of(test, drawing);
      expect(!c.triangles.empty(), "a drawing has triangles");
      for (const cases::Triangle& triangle : c.triangles) {
        for (const std::uint32_t vertex : triangle) {
          expect(vertex < c.positions.size(), "a triangle's vertices exist");
        }
      }
      cases::uncertainty_of(drawing);
    }
  }
  return 0;
}
