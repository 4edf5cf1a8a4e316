#include "reports/internal/judged_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "cases/base64.h"
#include "reports/internal/html.h"
#include "reports/internal/page.h"
#include "reports/internal/picture_wording.h"
#include "reports/internal/wording.h"
#include "reports/png.h"

namespace rastercheck::reports {
namespace {

using records::PixelVerdict;

/// The largest PNG files, in bytes: of the picture, and of the verdicts and the differences.
constexpr std::size_t kMostOfPicture = 600'000;
constexpr std::size_t kMostOfOthers = 250'000;

/// Pictures narrower and lower than this, in pixels, are shown with square pixels.
constexpr int kSmallPicture = 320;

/// The colours of wrong pixels in the picture of differences, the largest difference last. The
/// viewer (reports/viewer/part_views.js) uses the same colours.
struct DifferenceStep {
  double most;  ///< steps, inclusive
  Color color;
  std::string_view text;
};
constexpr Color kRightColor{64, 64, 64};
constexpr std::array kDifferenceSteps{
    DifferenceStep{1, {139, 92, 186}, "1"}, DifferenceStep{4, {206, 76, 140}, "≤ 4"},
    DifferenceStep{64, {245, 125, 95}, "≤ 64"}, DifferenceStep{INFINITY, {255, 222, 140}, "> 64"}};
constexpr Color kNaNColor{255, 255, 255};

Color difference_color(double steps) {
  if (std::isinf(steps)) return kNaNColor;
  for (const DifferenceStep& step : kDifferenceSteps) {
    if (steps <= step.most) return step.color;
  }
  return kDifferenceSteps.back().color;
}

/// Makes each block of block × block pixels one pixel, in the colour of the block's worst pixel
/// (`is_worse(a, b)`: b is worse than a), or in the mean colour if `is_worse` is empty.
Image reduced(const Image& whole, int block,
              const std::function<bool(std::size_t a, std::size_t b)>& is_worse) {
  if (block == 1) return whole;
  Image image =
      Image::filled((whole.width + block - 1) / block, (whole.height + block - 1) / block, {});
  for (int row = 0; row < image.height; ++row) {
    for (int x = 0; x < image.width; ++x) {
      std::array<int, 3> sum{};
      int count = 0;
      std::size_t shown = static_cast<std::size_t>(row) * static_cast<std::size_t>(block) *
                              static_cast<std::size_t>(whole.width) +
                          static_cast<std::size_t>(x) * static_cast<std::size_t>(block);
      for (int v = row * block; v < std::min(whole.height, (row + 1) * block); ++v) {
        for (int u = x * block; u < std::min(whole.width, (x + 1) * block); ++u) {
          const Color color = whole.at(u, v);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c];
          ++count;
          const auto place = static_cast<std::size_t>(v) * static_cast<std::size_t>(whole.width) +
                             static_cast<std::size_t>(u);
          if (is_worse && is_worse(shown, place)) shown = place;
        }
      }
      const auto width = static_cast<std::size_t>(whole.width);
      Color color = whole.at(static_cast<int>(shown % width), static_cast<int>(shown / width));
      for (std::size_t c = 0; c < 3 && !is_worse; ++c) {
        color[c] = static_cast<std::uint8_t>(sum[c] / count);
      }
      image.set(x, row, color);
    }
  }
  return image;
}

struct Encoded {
  std::string png;
  int block = 1;
};

/// Encodes a picture as PNG, shrunk until the file has at most `most` bytes.
Result<Encoded> encoded(const Image& image, std::size_t most,
                        const std::function<bool(std::size_t, std::size_t)>& is_worse) {
  for (int block = 1;; ++block) {
    const Result<std::string> png = to_png(reduced(image, block, is_worse));
    if (!png) return tl::unexpected(png.error());
    if (png->size() <= most) return Encoded{*png, block};
  }
}

/// Frames around the parts; each frame links to its part. Empty if the picture is one part.
std::string frames_of(const JudgedPage& page) {
  const int width = page.picture.width;
  const int height = page.picture.height;
  std::string text;
  for (std::size_t i = 0; i < page.parts.size(); ++i) {
    const records::PicturePart& part = page.parts[i];
    if (part.width == width && part.height == height) return "";
    const int top = is_upwards(page) ? height - part.top - part.height : part.top;
    text += fmt::format(
        "<a href=\"#{}\" tabindex=\"-1\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">"
        "<title>Part {}: pixel ({}, {})</title></rect></a>\n",
        inspection_link(i), part.left, top, part.width, part.height, i + 1, part.x, part.row);
  }
  if (text.empty()) return "";
  // Hidden from keys and screen readers, because the list below links to the same parts.
  return fmt::format(
      "<svg class=\"frames\" viewBox=\"0 0 {} {}\" aria-hidden=\"true\">\n{}</svg>\n", width,
      height, text);
}

std::string whole_picture(const JudgedPage& page, const Encoded& encoded, std::string_view name,
                          const std::string& caption) {
  const bool is_small = page.picture.width < kSmallPicture && page.picture.height < kSmallPicture;
  const std::string smaller =
      encoded.block == 1 ? ""
                         : fmt::format(" Shown smaller: 1 pixel for {0} × {0}.", encoded.block);
  return fmt::format(
      "<figure><div class=\"whole\"><img{} src=\"data:image/png;base64,{}\" width=\"{}\" "
      "height=\"{}\" alt=\"{}\">\n{}</div><figcaption><strong>{}.</strong> {}{}</figcaption>"
      "</figure>\n",
      is_small ? " class=\"small\"" : "", cases::to_base64(encoded.png), page.picture.width,
      page.picture.height, name, frames_of(page), name, caption, smaller);
}

/// The rank of a verdict in a block of pixels: wrong above not judged, and not judged above right.
int rank_of(PixelVerdict verdict) {
  if (verdict == PixelVerdict::right) return 0;
  return verdict == PixelVerdict::not_judged ? 1 : 2;
}

std::string color_swatch(const Color& color) {
  return fmt::format(
      "<span class=\"swatch\" style=\"background:#{:02x}{:02x}{:02x}\" aria-hidden=\"true\">"
      "</span>",
      color[0], color[1], color[2]);
}

std::string verdict_key(const records::JudgedPicture& judged) {
  std::string text = "The verdict of each pixel: ";
  for (std::size_t i = 0; i < records::kPixelVerdicts; ++i) {
    if (judged.counts[i] == 0) continue;
    const auto verdict = static_cast<PixelVerdict>(i);
    text += fmt::format("<span class=\"of-key\">{}{}</span> ", color_swatch(color_of(verdict)),
                        to_string(verdict));
  }
  return text;
}

std::string difference_key(const records::JudgedPicture& judged) {
  std::string text = fmt::format(
      "Steps beyond what is permitted, in the channel that is farthest off: "
      "<span class=\"of-key\">{}none</span> ",
      color_swatch(kRightColor));
  for (const DifferenceStep& step : kDifferenceSteps) {
    text += fmt::format("<span class=\"of-key\">{}{}</span> ", color_swatch(step.color), step.text);
  }
  if (judged.count(PixelVerdict::not_a_number) > 0) {
    text += fmt::format("<span class=\"of-key\">{}NaN</span>", color_swatch(kNaNColor));
  }
  return text;
}

std::string picture_key(const JudgedPage& page, const PictureColors& colors) {
  const auto& names = page.picture.channels;
  const auto& channels = colors.channels();
  std::string text;
  if (names.size() == 1) {
    text = "As it is in the file.";
  } else {
    text = fmt::format("Channel {} is shown as red, {} as green", html(names[channels[0]]),
                       html(names[channels[1]]));
    text += names.size() == 2 ? "." : fmt::format(", {} as blue.", html(names[channels[2]]));
  }
  if (colors.is_stretched()) {
    text += " Channels with numbers outside 0 to 1 run from their least to their greatest number.";
  }
  return text;
}

/// Makes a picture with a colour for each pixel of the file, in the order of rows as displayed.
template <typename ColorOf>
Image drawn(const JudgedPage& page, const ColorOf& color_at) {
  const records::JudgedPicture& judged = page.judged;
  Image image = Image::filled(judged.width, judged.height, {});
  for (int row = 0; row < judged.height; ++row) {
    const int shown = is_upwards(page) ? judged.height - 1 - row : row;
    for (int x = 0; x < judged.width; ++x) {
      image.set(x, shown,
                color_at(static_cast<std::size_t>(row) * static_cast<std::size_t>(judged.width) +
                         static_cast<std::size_t>(x)));
    }
  }
  return image;
}

}  // namespace

Result<std::string> pictures_section(const JudgedPage& page, const PictureColors& colors) {
  const records::JudgedPicture& judged = page.judged;
  // Converts the index of a pixel as displayed to its index in the file.
  const auto in_file = [&](std::size_t place) {
    const auto width = static_cast<std::size_t>(judged.width);
    const auto height = static_cast<std::size_t>(judged.height);
    return is_upwards(page) ? (height - 1 - place / width) * width + place % width : place;
  };
  const Result<Encoded> picture =
      encoded(image_of(page.picture, colors, is_upwards(page)), kMostOfPicture, {});
  if (!picture) return tl::unexpected(picture.error());
  const Result<Encoded> verdicts =
      encoded(drawn(page, [&](std::size_t i) { return color_of(judged.pixels[i]); }), kMostOfOthers,
              [&](std::size_t a, std::size_t b) {
                return rank_of(judged.pixels[in_file(b)]) > rank_of(judged.pixels[in_file(a)]);
              });
  if (!verdicts) return tl::unexpected(verdicts.error());
  std::string text = "<section id=\"pictures\">\n<h2>The picture</h2>\n<div class=\"pictures\">\n" +
                     whole_picture(page, *picture, "Picture", picture_key(page, colors)) +
                     whole_picture(page, *verdicts, "Verdicts", verdict_key(judged));
  if (judged.wrong() > 0) {
    const Result<Encoded> differences =
        encoded(drawn(page,
                      [&](std::size_t i) {
                        return rank_of(judged.pixels[i]) > 1 ? difference_color(judged.steps[i])
                                                             : kRightColor;
                      }),
                kMostOfOthers, [&](std::size_t a, std::size_t b) {
                  return judged.steps[in_file(b)] > judged.steps[in_file(a)];
                });
    if (!differences) return tl::unexpected(differences.error());
    text += whole_picture(page, *differences, "Difference", difference_key(judged));
  }
  return text + "</div>\n</section>\n";
}

}  // namespace rastercheck::reports
