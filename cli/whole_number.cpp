#include "cli/whole_number.h"

#include <fmt/format.h>

#include <charconv>
#include <string>
#include <system_error>

namespace rastercheck::cli {

CLI::Validator whole_number(std::uint64_t most) {
  return {[most](std::string& text) -> std::string {
            std::uint64_t value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, problem] = std::from_chars(text.data(), end, value);
            if (stop == end && problem == std::errc() && value <= most) return "";
            return fmt::format("Value {} is no whole number from 0 to {}", text, most);
          },
          ""};
}

}  // namespace rastercheck::cli
