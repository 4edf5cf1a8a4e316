#include "reports/internal/embedded_json.h"

#include <nlohmann/json.hpp>

namespace rastercheck::reports {

std::string embedded_json(const nlohmann::json& data) {
  const std::string text = data.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace rastercheck::reports
