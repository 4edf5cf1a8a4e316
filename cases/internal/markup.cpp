#include "cases/internal/markup.h"

#include <algorithm>
#include <array>

namespace rastercheck::cases {
namespace {

constexpr std::string_view kSpaces = " \t\r\n";

void skip_spaces(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kSpaces), text.size()));
}

/// Removes the characters before the first of `ends`, and returns them.
std::string_view take_until(std::string_view& text, std::string_view ends) {
  const std::string_view taken = text.substr(0, text.find_first_of(ends));
  text.remove_prefix(taken.size());
  return taken;
}

bool skip(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

/// Replaces the five named entities by their characters. Any other & stays as it is.
std::string unescaped(std::string_view text) {
  constexpr auto kEntities = std::to_array<std::pair<std::string_view, char>>(
      {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&apos;", '\''}, {"&quot;", '"'}});
  std::string plain;
  plain.reserve(text.size());
  while (!text.empty()) {
    plain += take_until(text, "&");
    if (text.empty()) break;
    char character = '&';
    std::size_t length = 1;
    for (const auto& [entity, meant] : kEntities) {
      if (!text.starts_with(entity)) continue;
      character = meant;
      length = entity.size();
    }
    plain += character;
    text.remove_prefix(length);
  }
  return plain;
}

}  // namespace

std::string_view MarkupEvent::attribute(std::string_view wanted) const {
  for (const auto& [key, value] : attributes) {
    if (key == wanted) return value;
  }
  return {};
}

std::optional<MarkupEvent> MarkupReader::next() {
  MarkupEvent event;
  if (!ends_.empty()) {
    event.kind = MarkupEvent::Kind::end;
    event.name = std::exchange(ends_, {});
    return event;
  }
  if (rest_.starts_with("<?")) {
    const std::size_t end = rest_.find("?>");
    if (end == std::string_view::npos) return std::nullopt;
    rest_.remove_prefix(end + 2);
  }
  if (rest_.empty()) return event;
  if (rest_.front() == '<') return next_tag();
  event.kind = MarkupEvent::Kind::text;
  event.text = unescaped(take_until(rest_, "<"));
  return event;
}

std::optional<MarkupEvent> MarkupReader::next_tag() {
  MarkupEvent event;
  event.kind = MarkupEvent::Kind::begin;
  std::string_view rest = rest_.substr(1);
  if (skip(rest, "/")) event.kind = MarkupEvent::Kind::end;
  event.name = take_until(rest, " \t\r\n/>=<\"");
  if (event.name.empty()) return std::nullopt;
  while (true) {
    skip_spaces(rest);
    if (skip(rest, ">")) break;
    if (event.kind == MarkupEvent::Kind::end) return std::nullopt;
    if (skip(rest, "/>")) {
      ends_ = event.name;
      break;
    }
    const std::string_view key = take_until(rest, " \t\r\n/>=<\"");
    if (key.empty() || !skip(rest, "=\"")) return std::nullopt;
    const std::string_view value = take_until(rest, "\"");
    if (!skip(rest, "\"")) return std::nullopt;
    event.attributes.emplace_back(key, unescaped(value));
  }
  rest_ = rest;
  return event;
}

}  // namespace rastercheck::cases
