#include "reports/wrapped_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace rastercheck::reports {

// A continuation byte of UTF-8 is 10xxxxxx.
std::size_t characters_in(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string wrapped(std::string_view label, std::size_t indent, std::string_view text,
                    std::size_t columns) {
  std::string lines = fmt::format("{:<{}}", label, indent);
  std::size_t column = indent;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    const std::size_t width = characters_in(word);
    if (column > indent && column + 1 + width > columns) {
      lines += "\n" + std::string(indent, ' ');
      column = indent;
    }
    if (column > indent) {
      lines += " ";
      ++column;
    }
    lines += word;
    column += width;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines + "\n";
}

}  // namespace rastercheck::reports
