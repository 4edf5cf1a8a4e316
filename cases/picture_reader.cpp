#include "cases/picture_reader.h"

#include <fmt/format.h>

#include "cases/case.h"
#include "cases/files.h"
#include "cases/internal/picture_formats.h"

namespace rastercheck::cases {
namespace {

constexpr std::uint64_t kMostValues = std::uint64_t{1} << 28;

PictureOrReason read_any(std::string_view bytes, ArrayOrder order) {
  if (is_exr(bytes)) return read_exr(bytes);
  if (is_png(bytes)) return read_png(bytes);
  if (is_npy(bytes)) return read_npy(bytes, order);
  if (is_pfm(bytes)) return read_pfm(bytes);
  return tl::unexpected(std::string("is not a picture: expected OpenEXR, PNG, NPY or PFM"));
}

}  // namespace

std::optional<std::string> size_fault(std::uint64_t width, std::uint64_t height,
                                      std::uint64_t channels) {
  const auto most = static_cast<std::uint64_t>(kMaxSize);
  if (width == 0 || height == 0) return "has no pixels";
  if (width > most || height > most) {
    return fmt::format("{} x {} pixels; at most {} x {} are read", width, height, most, most);
  }
  if (channels == 0 || channels > kMaxPictureChannels) {
    return fmt::format("{} channels; 1 to {} are read", channels, kMaxPictureChannels);
  }
  if (width * height * channels > kMostValues) {
    return fmt::format("{} numbers; at most 2^28 are read", width * height * channels);
  }
  return std::nullopt;
}

Result<PictureFile> parse_picture(std::string_view bytes, const std::string& file,
                                  ArrayOrder order) {
  PictureOrReason picture = read_any(bytes, order);
  if (!picture) return tl::unexpected(Error{file, "", picture.error()});
  return *std::move(picture);
}

Result<PictureFile> read_picture(const std::string& file, ArrayOrder order) {
  return read_text(file).and_then(
      [&](const std::string& bytes) { return parse_picture(bytes, file, order); });
}

}  // namespace rastercheck::cases
