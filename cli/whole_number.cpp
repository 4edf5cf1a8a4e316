#include "cli/whole_number.h"

#include <charconv>
#include <cstdint>
#include <string>
#include <system_error>

namespace rastercheck::cli {

CLI::Validator whole_number() {
  return {[](std::string& text) -> std::string {
            std::uint64_t value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, problem] = std::from_chars(text.data(), end, value);
            if (stop == end && problem == std::errc()) return "";
            return "Value " + text + " is no whole number from 0 to 2^64 - 1";
          },
          ""};
}

}  // namespace rastercheck::cli
