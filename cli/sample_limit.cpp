#include "cli/sample_limit.h"

#include <fmt/format.h>

#include <cstdint>

namespace rastercheck::cli {

Result<void> check_sample_count(const cases::Case& c, const std::string& file, bool all) {
  constexpr std::int64_t kMost = std::int64_t{1} << 26;
  const cases::FramebufferSize& size = c.framebuffer;
  const std::int64_t samples = std::int64_t{size.width} * size.height * size.samples;
  if (all || samples <= kMost) return {};
  return tl::unexpected(
      Error{file, "/framebuffer",
            fmt::format("{} samples exceed the limit of 2^26; use --all to allow them", samples)});
}

}  // namespace rastercheck::cli
