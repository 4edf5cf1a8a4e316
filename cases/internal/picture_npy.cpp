// NumPy arrays, the NPY format 1.0 to 3.0 (NumPy Enhancement Proposal 1, Kern 2007).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <vector>

#include "cases/internal/half.h"
#include "cases/internal/picture_encoders.h"
#include "cases/internal/picture_formats.h"

namespace rastercheck::cases {
namespace {

static_assert(std::endian::native == std::endian::little);

struct Array {
  std::string type;
  std::vector<std::uint64_t> shape;
};

/// The text behind a key of the header, which is a Python dictionary.
std::optional<std::string_view> member_of(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(fmt::format("'{}'", key));
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t colon = header.find(':', at);
  if (colon == std::string_view::npos) return std::nullopt;
  std::string_view rest = header.substr(colon + 1);
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  return rest;
}

/// Reads "(2, 3)"; empty if the text is no such tuple.
std::optional<std::vector<std::uint64_t>> tuple_of(std::string_view text) {
  if (!text.starts_with('(')) return std::nullopt;
  text = text.substr(1, text.find(')') - 1);
  std::vector<std::uint64_t> numbers;
  while (!text.empty()) {
    text.remove_prefix(std::min(text.find_first_not_of(" ,"), text.size()));
    if (text.empty()) break;
    std::uint64_t number = 0;
    const auto [end, why] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (why != std::errc()) return std::nullopt;
    numbers.push_back(number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return numbers;
}

/// Reads the header and removes it from the front of the bytes.
tl::expected<Array, std::string> read_npy_header(std::string_view& bytes) {
  const auto refuse = [](std::string reason) { return tl::unexpected(std::move(reason)); };
  constexpr std::size_t kMagic = 8;  // "\x93NUMPY", major and minor version
  if (bytes.size() < kMagic + 4) return refuse("the file ends too early");
  const bool is_short = bytes[6] == 1;
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + kMagic, is_short ? 2 : 4);
  bytes.remove_prefix(kMagic + (is_short ? 2U : 4U));
  if (bytes.size() < length) return refuse("the file ends too early");
  const std::string_view header = bytes.substr(0, length);
  bytes.remove_prefix(length);
  const auto type = member_of(header, "descr");
  const auto order = member_of(header, "fortran_order");
  const auto shape = member_of(header, "shape");
  if (!type || !order || !shape) return refuse("its header lacks descr, fortran_order or shape");
  if (!order->starts_with("False")) return refuse("is in Fortran order; C order is read");
  if (!type->starts_with('\'')) return refuse("is an array of records");
  Array array;
  array.type = type->substr(1, type->find('\'', 1) - 1);
  const auto sizes = tuple_of(*shape);
  if (!sizes) return refuse("its shape is not a list of sizes");
  array.shape = *sizes;
  return array;
}

struct ElementType {
  std::string_view name;
  std::size_t size;
  Storage storage;
};
constexpr std::array kElementTypes{
    ElementType{"<f4", 4, Storage::float32}, ElementType{"<f2", 2, Storage::float16},
    ElementType{"|u1", 1, Storage::unorm8}, ElementType{"<u1", 1, Storage::unorm8},
    ElementType{"<u2", 2, Storage::unorm16}};

float element_at(const char* from, Storage storage) {
  std::uint16_t two = 0;
  float four = 0;
  switch (storage) {
    case Storage::float32:
      std::memcpy(&four, from, sizeof four);
      return four;
    case Storage::float16:
      std::memcpy(&two, from, sizeof two);
      return float_of_half(two);
    case Storage::unorm16:
      std::memcpy(&two, from, sizeof two);
      return two;
    case Storage::unorm8:
    case Storage::srgb8:
      break;
  }
  return static_cast<unsigned char>(*from);
}

void put_element(char* to, Storage storage, float value) {
  std::uint16_t two = 0;
  switch (storage) {
    case Storage::float32:
      std::memcpy(to, &value, sizeof value);
      return;
    case Storage::float16:
      two = half_of_float(value);
      break;
    case Storage::unorm16:
      two = static_cast<std::uint16_t>(value);
      break;
    case Storage::unorm8:
    case Storage::srgb8:
      *to = static_cast<char>(static_cast<unsigned char>(value));
      return;
  }
  std::memcpy(to, &two, sizeof two);
}

}  // namespace

bool is_npy(std::string_view bytes) { return bytes.starts_with("\x93NUMPY"); }

PictureOrReason read_npy(std::string_view bytes, ArrayOrder order) {
  const auto refuse = [](const std::string& reason) { return tl::unexpected("NPY: " + reason); };
  const auto array = read_npy_header(bytes);
  if (!array) return refuse(array.error());
  const auto type = std::find_if(kElementTypes.begin(), kElementTypes.end(),
                                 [&](const ElementType& one) { return one.name == array->type; });
  if (type == kElementTypes.end()) {
    return refuse(fmt::format("its numbers are '{}'; <f4, <f2, |u1 and <u2 are read", array->type));
  }
  std::vector<std::uint64_t> shape = array->shape;
  if (shape.size() == 2) shape.insert(order == ArrayOrder::hwc ? shape.end() : shape.begin(), 1);
  if (shape.size() != 3) {
    return refuse(fmt::format("has {} axes; 2 or 3 are read", array->shape.size()));
  }
  const bool is_hwc = order == ArrayOrder::hwc;
  const std::uint64_t height = shape[is_hwc ? 0 : 1];
  const std::uint64_t width = shape[is_hwc ? 1 : 2];
  const std::uint64_t channels = shape[is_hwc ? 2 : 0];
  if (const auto fault = size_fault(width, height, channels)) return refuse(*fault);
  PictureFile picture;
  picture.width = static_cast<int>(width);
  picture.height = static_cast<int>(height);
  picture.channels = default_channel_names(channels);
  picture.stored.assign(channels, type->storage);
  const std::size_t count = picture.value_count();
  if (bytes.size() != count * type->size) {
    return refuse(fmt::format("has {} bytes of numbers, not {}", bytes.size(), count * type->size));
  }
  picture.values.resize(count);
  const std::size_t pixels = width * height;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = is_hwc ? i : i % channels * pixels + i / channels;
    picture.values[i] = element_at(bytes.data() + at * type->size, type->storage);
  }
  return picture;
}

BytesOrReason write_npy(const PictureFile& picture) {
  const Storage storage = picture.stored.front();
  const bool is_uniform = std::all_of(picture.stored.begin(), picture.stored.end(),
                                      [storage](Storage one) { return one == storage; });
  if (!is_uniform) return tl::unexpected(std::string("NPY holds numbers of one kind"));
  const auto type = std::find_if(kElementTypes.begin(), kElementTypes.end(),
                                 [storage](const auto& one) { return one.storage == storage; });
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}, {}), }}", type->name,
                  picture.height, picture.width, picture.channels.size());
  // Magic, version and length take ten bytes; the numbers begin at a multiple of 64.
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  const std::size_t start = bytes.size();
  bytes.resize(start + picture.values.size() * type->size);
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    put_element(bytes.data() + start + i * type->size, storage, picture.values[i]);
  }
  return bytes;
}

}  // namespace rastercheck::cases
