#pragma once

// The form of the answers of processes that read files (reader_process.h): one line of JSON, then
// little-endian numbers without separators.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"

namespace rastercheck::cases {

static_assert(std::endian::native == std::endian::little);

/// The header as the first line of an answer.
std::string header_line(const nlohmann::json& header);

/// Removes the first line from an answer and returns it. Empty if there is none, or if it is longer
/// than any header: parsing it would take many times its length in memory.
std::optional<std::string_view> take_header_line(std::string_view& reply);

/// The error of an answer that makes no sense. `what`: the kind of file.
Error reply_fault(const std::string& file, std::string_view what, const std::string& reason);

template <typename Element>
std::string_view bytes_of(const std::vector<Element>& elements) {
  return {reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(Element)};
}

/// Removes the bytes of `count` elements from the front of a text, which must have them.
template <typename Element>
std::vector<Element> take_elements(std::string_view& bytes, std::size_t count) {
  std::vector<Element> elements(count);
  const std::size_t size = count * sizeof(Element);
  std::copy_n(bytes.begin(), size, reinterpret_cast<char*>(elements.data()));
  bytes.remove_prefix(size);
  return elements;
}

}  // namespace rastercheck::cases
