#include "cases/internal/reader_reply.h"

#include <nlohmann/json.hpp>

namespace rastercheck::cases {

std::string header_line(const nlohmann::json& header) {
  return header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::optional<std::string_view> take_header_line(std::string_view& reply) {
  constexpr std::size_t kLongestLine = 65536;  // it may quote file names
  const std::size_t end = reply.find('\n');
  if (end == std::string_view::npos || end > kLongestLine) return std::nullopt;
  const std::string_view line = reply.substr(0, end);
  reply.remove_prefix(end + 1);
  return line;
}

Error reply_fault(const std::string& file, std::string_view what, const std::string& reason) {
  return {file, "", "the " + std::string(what) + " reader's answer: " + reason};
}

}  // namespace rastercheck::cases
