#include "reports/internal/markdown.h"

#include "cases/json.h"

namespace rastercheck::reports {

std::string markdown(std::string_view text) {
  std::string escaped;
  for (const char c : cases::printable(text)) {
    if (std::string_view("\\`*_{}[]<>#|~&").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string command_block(std::string_view command) {
  return "    " + cases::printable(command) + "\n";
}

}  // namespace rastercheck::reports
