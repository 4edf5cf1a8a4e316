// The backend `cpu`: this project's rasterizer.

#include <charconv>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include "backends/backend.h"
#include "backends/cpu/rasterizer_backend.h"

namespace rastercheck::backends {
namespace {

/// 1…256.
std::optional<unsigned> thread_count(std::string_view text) {
  unsigned count = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || rest != end || count < 1 || count > 256) return std::nullopt;
  return count;
}

/// Whether there is such an option.
bool set(std::string_view option, RasterizerOptions& options) {
  using rasterizer::Precision;
  constexpr std::string_view kThreads = "threads=";
  if (option == "precision=float64" || option == "precision=float32") {
    const bool is_double = option.ends_with("64");
    options.precision = is_double ? Precision::float64 : Precision::float32;
  } else if (option == "output=fragments" || option == "output=framebuffer") {
    options.output = option.ends_with("fragments") ? Output::fragments : Output::framebuffer;
  } else if (option.starts_with(kThreads)) {
    const std::optional<unsigned> count = thread_count(option.substr(kThreads.size()));
    if (count) options.threads = *count;
    return count.has_value();
  } else {
    return false;
  }
  return true;
}

Result<std::unique_ptr<Backend>> make(const std::string& text) {
  RasterizerOptions options;
  std::istringstream all(text);
  for (std::string option; std::getline(all, option, ',');) {
    if (set(option, options)) continue;
    return tl::unexpected(Error{
        "cpu:" + text, "",
        "cpu has no option '" + option +
            "'; there are: precision=float64 (the default), precision=float32, output=fragments "
            "(the default), output=framebuffer, threads=N (1 to 256)"});
  }
  if (options.threads > 1 && options.output == Output::fragments) {
    return tl::unexpected(Error{"cpu:" + text, "",
                                "fragments are drawn on one thread; threads=N is for "
                                "output=framebuffer"});
  }
  return make_rasterizer_backend(options);
}

std::vector<Listing> list() {
  return {{"cpu", "this project's rasterizer", ""},
          {"cpu:precision=float32", "the same, with attributes computed in float32", ""},
          {"cpu:output=framebuffer", "the same, drawn tile by tile into a framebuffer", ""}};
}

const BackendRegistration kRegistration({"cpu", &make, &list});

}  // namespace
}  // namespace rastercheck::backends
