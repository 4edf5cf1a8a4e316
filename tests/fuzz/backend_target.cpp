// Specifications of backends, as --backend takes them.

#include <string>

#include "backends/backend.h"
#include "backends/factory.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rastercheck;
  const std::string specification(fuzz::text_of(data, size));
  const auto backend = backends::make_backend(specification);
  if (!backend) {
    fuzz::expect_one_line(backend.error());
    return 0;
  }
  fuzz::expect(*backend != nullptr, "a backend that was made is there");
  for (const std::string& other : (*backend)->about().same_as) {
    fuzz::expect(backends::make_backend(other).has_value(),
                 "what a backend promises to draw the same as can be made");
  }
  return 0;
}
