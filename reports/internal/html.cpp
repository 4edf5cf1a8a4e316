#include "reports/internal/html.h"

#include <nlohmann/json.hpp>

namespace rastercheck::reports {

namespace {

/// Replaces U+FFFE and U+FFFF, which XML does not allow, by U+FFFD.
std::string without_noncharacters(std::string text) {
  for (const std::string_view one : {"\xef\xbf\xbe", "\xef\xbf\xbf"}) {
    for (std::size_t at = 0; (at = text.find(one, at)) != std::string::npos;) {
      text.replace(at, one.size(), "\xef\xbf\xbd");
    }
  }
  return text;
}

}  // namespace

std::string html(std::string_view text) {
  using nlohmann::json;
  // Writing JSON replaces bytes that are not UTF-8; parsing it returns the text.
  const std::string valid =
      json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
  std::string escaped;
  for (const char c : without_noncharacters(valid)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default: {
        constexpr char kDelete = 0x7f;
        const bool is_control =
            (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == kDelete;
        escaped += is_control ? std::string("�") : std::string(1, c);
      }
    }
  }
  return escaped;
}

}  // namespace rastercheck::reports
