// Portable float maps (Debevec 1998): "PF" for colour or "Pf" for grey, width and height, a scale
// whose sign is the byte order, and float32 rows, the lowest first.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>

#include "cases/internal/picture_encoders.h"
#include "cases/internal/picture_formats.h"

namespace rastercheck::cases {
namespace {

/// Removes the next word and the one space behind it from the front of a text.
std::string_view take_word(std::string_view& text) {
  constexpr std::size_t kLongest = 32;
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  const std::size_t end = std::min(text.substr(0, kLongest).find_first_of(" \t\r\n"), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

template <typename Number>
std::optional<Number> number_of(std::string_view word) {
  Number number{};
  const auto [end, why] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (why != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

float float_at(const char* from, bool is_little_endian) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, from, sizeof bits);
  return std::bit_cast<float>(is_little_endian ? bits : __builtin_bswap32(bits));
}

}  // namespace

bool is_pfm(std::string_view bytes) {
  return bytes.size() >= 3 && (bytes.starts_with("PF") || bytes.starts_with("Pf")) &&
         std::string_view(" \t\r\n").find(bytes[2]) != std::string_view::npos;
}

PictureOrReason read_pfm(std::string_view bytes) {
  const auto refuse = [](const std::string& reason) { return tl::unexpected("PFM: " + reason); };
  const std::size_t channels = take_word(bytes) == "PF" ? 3 : 1;
  const auto width = number_of<std::uint64_t>(take_word(bytes));
  const auto height = number_of<std::uint64_t>(take_word(bytes));
  const auto scale = number_of<double>(take_word(bytes));
  if (!width || !height || !scale || *scale == 0) return refuse("its header is broken");
  if (const auto fault = size_fault(*width, *height, channels)) return refuse(*fault);
  PictureFile picture;
  picture.width = static_cast<int>(*width);
  picture.height = static_cast<int>(*height);
  picture.channels = default_channel_names(channels);
  picture.stored.assign(channels, Storage::float32);
  const std::size_t count = picture.value_count();
  if (bytes.size() != count * sizeof(float)) {
    return refuse(fmt::format("has {} bytes of numbers, not {}", bytes.size(), count * 4));
  }
  picture.values.resize(count);
  const std::size_t row = *width * channels;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = (*height - 1 - i / row) * row + i % row;
    picture.values[i] = float_at(bytes.data() + at * sizeof(float), *scale < 0);
  }
  return picture;
}

BytesOrReason write_pfm(const PictureFile& picture) {
  const std::size_t channels = picture.channels.size();
  const bool is_float = std::all_of(picture.stored.begin(), picture.stored.end(),
                                    [](Storage one) { return one == Storage::float32; });
  if (!is_float) return tl::unexpected(std::string("PFM holds float32 numbers"));
  if (channels != 1 && channels != 3) {
    return tl::unexpected(fmt::format("PFM holds 1 or 3 channels, not {}", channels));
  }
  std::string bytes =
      fmt::format("{}\n{} {}\n-1.0\n", channels == 3 ? "PF" : "Pf", picture.width, picture.height);
  for (int row = picture.height - 1; row >= 0; --row) {
    bytes.append(reinterpret_cast<const char*>(picture.pixel(0, row)),
                 static_cast<std::size_t>(picture.width) * channels * sizeof(float));
  }
  return bytes;
}

}  // namespace rastercheck::cases
