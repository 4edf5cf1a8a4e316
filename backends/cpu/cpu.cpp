// The backend `cpu`: this project's rasterizer.

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "backends/cpu/rasterizer_backend.h"
#include "backends/factory.h"
#include "rasterizer/simd.h"

namespace rastercheck::backends::cpu_registration {
namespace {

/// Parses a number of threads, 1…256.
std::optional<unsigned> thread_count(std::string_view text) {
  unsigned count = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || rest != end || count < 1 || count > 256) return std::nullopt;
  return count;
}

/// The names of the targets, such as "avx2, ssse3"; only those that can run here if
/// `only_supported`.
std::string simd_names(bool only_supported) {
  std::string names;
  for (const rasterizer::SimdTarget& target : rasterizer::simd_targets()) {
    if (only_supported && !target.is_supported) continue;
    names += (names.empty() ? "" : ", ") + target.name;
  }
  return names;
}

/// Says why a target cannot be used; empty if it can.
std::string unavailable_because(const rasterizer::SimdTarget& target) {
  if (target.is_supported) return "";
  return (target.is_compiled ? "this machine does not support "
                             : "this build has no kernels for ") +
         target.name + "; available: " + simd_names(true);
}

/// Says why the target of that name cannot be used; empty if it can or does not exist.
std::string unavailable_because(std::string_view simd) {
  for (const rasterizer::SimdTarget& target : rasterizer::simd_targets()) {
    if (target.name == simd) return unavailable_because(target);
  }
  return "";
}

bool is_simd(std::string_view name) {
  const std::vector<rasterizer::SimdTarget> all = rasterizer::simd_targets();
  return std::any_of(all.begin(), all.end(),
                     [name](const rasterizer::SimdTarget& target) { return target.name == name; });
}

/// Sets an option. Returns false if there is no such option.
bool set(std::string_view option, RasterizerOptions& options) {
  using rasterizer::Precision;
  constexpr std::string_view kThreads = "threads=";
  constexpr std::string_view kSimd = "simd=";
  if (option == "precision=float64" || option == "precision=float32") {
    const bool is_double = option.ends_with("64");
    options.precision = is_double ? Precision::float64 : Precision::float32;
  } else if (option == "conservative=outer" || option == "conservative=inner") {
    options.conservative = option.ends_with("outer") ? rasterizer::Conservative::outer
                                                     : rasterizer::Conservative::inner;
  } else if (option == "rounding=floor") {
    options.rounds_down = true;
  } else if (option == "output=fragments" || option == "output=framebuffer") {
    options.output = option.ends_with("fragments") ? Output::fragments : Output::framebuffer;
  } else if (option.starts_with(kThreads)) {
    const std::optional<unsigned> count = thread_count(option.substr(kThreads.size()));
    if (count) options.threads = *count;
    return count.has_value();
  } else if (option.starts_with(kSimd)) {
    options.simd = option.substr(kSimd.size());
    return is_simd(options.simd);
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
        "unknown option '" + option +
            "'; options: precision=float64 (the default), precision=float32, conservative=outer, "
            "conservative=inner, rounding=floor, output=fragments (the default), "
            "output=framebuffer, threads=N (1 "
            "to 256), simd=TARGET (" +
            simd_names(false) + ")"});
  }
  if (const std::string reason = unavailable_because(options.simd); !reason.empty()) {
    return tl::unexpected(Error{"cpu:simd=" + options.simd, "", reason, Failure::unavailable});
  }
  if (options.threads > 1 && options.output == Output::fragments) {
    return tl::unexpected(
        Error{"cpu:" + text, "",
              "threads=N needs output=framebuffer; fragments are drawn on one thread"});
  }
  return make_rasterizer_backend(options);
}

std::vector<Listing> list() {
  std::vector<Listing> all{
      {"cpu", "this project's rasterizer", ""},
      {"cpu:precision=float32", "the same, with attributes computed in float32", ""},
      {"cpu:rounding=floor", "the same, but grid positions are the next lesser ones", ""},
      {"cpu:conservative=outer", "the same, with all pixels that a triangle touches", ""},
      {"cpu:conservative=inner", "the same, with the pixels that lie in a triangle", ""},
      {"cpu:output=framebuffer", "the same, drawn tile by tile into a framebuffer", ""}};
  for (const rasterizer::SimdTarget& target : rasterizer::simd_targets()) {
    all.push_back({"cpu:simd=" + target.name, "the same, with vectors of " + target.name,
                   unavailable_because(target)});
  }
  return all;
}

const BackendRegistration kRegistration({"cpu", &make, &list});

}  // namespace
}  // namespace rastercheck::backends::cpu_registration
