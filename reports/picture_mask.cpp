#include "reports/picture_mask.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "cases/json.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::PixelFreedom;

struct MaskKind {
  PixelFreedom freedom;
  std::array<std::uint8_t, 3> color;
  std::string_view meaning;
};
constexpr std::array kMaskKinds{
    MaskKind{PixelFreedom::one_value, {64, 64, 64}, "must have one value"},
    MaskKind{PixelFreedom::may_differ, {230, 159, 0}, "may differ"},
    MaskKind{PixelFreedom::background, {255, 255, 255}, "must be background"}};

cases::PictureFile picture_like(const records::PictureMask& mask) {
  cases::PictureFile picture;
  picture.width = mask.width;
  picture.height = mask.height;
  return picture;
}

}  // namespace

std::string mask_text(const records::PictureMask& mask) {
  const records::PictureFreedom& freedom = mask.freedom;
  std::string text = fmt::format("{} must have one value, {} may differ, {} must be background.\n",
                                 counted(freedom.one_value, "pixel", "pixels"),
                                 grouped(freedom.may_differ), grouped(freedom.background));
  if (freedom.widened > 0) {
    text += fmt::format("{} too many mixtures of samples to tell apart.\n",
                        counted(freedom.widened, "pixel has", "pixels have"));
  }
  if (freedom.layered > 0) {
    text += fmt::format("{} open, since several triangles may be blended there.\n",
                        counted(freedom.layered, "pixel is", "pixels are"));
  }
  return text;
}

std::string mask_json(const records::PictureMask& mask) {
  const records::PictureFreedom& freedom = mask.freedom;
  return cases::json_line({{"format", "rastercheck-mask"},
                           {"version", 1},
                           {"width", mask.width},
                           {"height", mask.height},
                           {"channels", mask.channels},
                           {"one_value", freedom.one_value},
                           {"may_differ", freedom.may_differ},
                           {"background", freedom.background},
                           {"widened", freedom.widened},
                           {"layered", freedom.layered}});
}

cases::PictureFile mask_picture(const records::PictureMask& mask) {
  cases::PictureFile picture = picture_like(mask);
  picture.channels = cases::default_channel_names(3);
  picture.stored.assign(3, cases::Storage::unorm8);
  picture.values.reserve(mask.pixels.size() * 3);
  for (const PixelFreedom freedom : mask.pixels) {
    for (const MaskKind& kind : kMaskKinds) {
      if (kind.freedom != freedom) continue;
      picture.values.insert(picture.values.end(), kind.color.begin(), kind.color.end());
    }
  }
  return picture;
}

std::string mask_legend() {
  std::string legend;
  for (const MaskKind& kind : kMaskKinds) {
    legend += fmt::format("#{:02x}{:02x}{:02x}: {}\n", kind.color[0], kind.color[1], kind.color[2],
                          kind.meaning);
  }
  return legend;
}

cases::PictureFile bounds_picture(const records::PictureMask& mask) {
  cases::PictureFile picture = picture_like(mask);
  for (const char* side : {"lower.", "upper."}) {
    for (const std::string& name : mask.channels) picture.channels.push_back(side + name);
  }
  const std::size_t channels = mask.channels.size();
  picture.stored.assign(2 * channels, cases::Storage::float32);
  picture.values.reserve(picture.value_count());
  for (std::size_t pixel = 0; pixel < mask.pixels.size(); ++pixel) {
    const auto first = static_cast<std::ptrdiff_t>(pixel * channels);
    const auto last = first + static_cast<std::ptrdiff_t>(channels);
    picture.values.insert(picture.values.end(), mask.least.begin() + first,
                          mask.least.begin() + last);
    picture.values.insert(picture.values.end(), mask.greatest.begin() + first,
                          mask.greatest.begin() + last);
  }
  return picture;
}

}  // namespace rastercheck::reports
