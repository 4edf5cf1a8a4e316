#include "cases/picture_writer.h"

#include <algorithm>
#include <array>

#include "cases/files.h"
#include "cases/internal/picture_encoders.h"

namespace rastercheck::cases {
namespace {

BytesOrReason encoded(const PictureFile& picture, PictureFormat format, const PictureTexts& texts) {
  switch (format) {
    case PictureFormat::exr:
      return write_exr(picture, texts);
    case PictureFormat::png:
      return write_png(picture, texts);
    case PictureFormat::npy:
      return write_npy(picture);
    case PictureFormat::pfm:
      break;
  }
  return write_pfm(picture);
}

}  // namespace

std::optional<PictureFormat> picture_format_of(std::string_view file) {
  constexpr std::array<std::pair<std::string_view, PictureFormat>, 4> kEndings{
      {{".exr", PictureFormat::exr},
       {".png", PictureFormat::png},
       {".npy", PictureFormat::npy},
       {".pfm", PictureFormat::pfm}}};
  const auto found = std::find_if(kEndings.begin(), kEndings.end(),
                                  [file](const auto& one) { return file.ends_with(one.first); });
  return found == kEndings.end() ? std::nullopt : std::optional(found->second);
}

Result<void> write_picture(const PictureFile& picture, const std::string& file,
                           const PictureTexts& texts) {
  const std::optional<PictureFormat> format = picture_format_of(file);
  if (!format) {
    return tl::unexpected(Error{file, "", "a picture's name ends in .exr, .png, .npy or .pfm"});
  }
  const BytesOrReason bytes = encoded(picture, *format, texts);
  if (!bytes) return tl::unexpected(Error{file, "", bytes.error()});
  return write_file(file, *bytes);
}

}  // namespace rastercheck::cases
