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
            fmt::format("{} samples are more than 2^26; --all takes them all the same", samples)});
}

}  // namespace rastercheck::cli
