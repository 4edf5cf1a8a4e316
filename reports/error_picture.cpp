#include "reports/error_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string_view>
#include <utility>

#include "reports/internal/canvas.h"
#include "reports/internal/lettering.h"
#include "reports/internal/log2.h"

namespace rastercheck::reports {
namespace {

using records::ErrorMap;
using records::PixelState;

constexpr Color kInk{40, 40, 40};
/// Not on the ramp, which has no red.
constexpr Color kViolated{235, 0, 50};

constexpr int kLeastExponent = -6;     ///< scale ULP 2^-6 and less
constexpr int kGreatestExponent = 10;  ///< scale ULP 2^10 and more

/// Dark to light with the error, from blue to yellow: apart for readers who do not tell red from
/// green, and on paper without colours.
constexpr std::array<Color, 6> kRamp{Color{27, 26, 84},   Color{40, 72, 138},  Color{46, 116, 142},
                                     Color{76, 156, 126}, Color{158, 196, 92}, Color{252, 232, 84}};

/// The colour of a place on the ramp, 0…1.
Color ramp_color(double share) {
  const double position = std::clamp(share, 0.0, 1.0) * (kRamp.size() - 1);
  const std::size_t below =
      std::min(static_cast<std::size_t>(position), std::size_t{kRamp.size() - 2});
  const double beyond = position - static_cast<double>(below);
  Color color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = kRamp[below][i];
    const double high = kRamp[below + 1][i];
    color[i] = static_cast<std::uint8_t>(std::lround(low + (high - low) * beyond));
  }
  return color;
}

Color error_color(float error) {
  if (std::isnan(error)) return kViolated;
  if (!(error > 0)) return ramp_color(0);
  if (std::isinf(error)) return ramp_color(1);
  constexpr double kOctaves = kGreatestExponent - kLeastExponent;
  return ramp_color((drawn_log2(error) - kLeastExponent) / kOctaves);
}

// The legend, in pixels from its top: a bar, ticks, their labels, and a line of text.
constexpr int kMargin = 8;
constexpr int kBarTop = 8;
constexpr int kBarHeight = 8;
constexpr int kTickHeight = 3;
constexpr int kLabelTop = kBarTop + kBarHeight + kTickHeight + 2;
constexpr int kTextTop = kLabelTop + kLetterHeight + 5;
constexpr int kLegendHeight = kTextTop + kLetterHeight + 6;
constexpr int kLeastWidth = 264;  ///< nine labels of four characters, with space between
/// Every second octave.
constexpr std::array<std::string_view, 9> kLabels{"1/64", "1/16", "1/4", "1",   "4",
                                                  "16",   "64",   "256", "1024"};

void draw_legend(Image& image, int top) {
  const int left = kMargin + width_of(kLabels.front()) / 2;
  const int right = image.width - 1 - kMargin - width_of(kLabels.back()) / 2;
  for (int column = left; column <= right; ++column) {
    const Color color = ramp_color(static_cast<double>(column - left) / (right - left));
    for (int row = 0; row < kBarHeight; ++row) image.set(column, top + kBarTop + row, color);
  }
  for (int i = 0; i < static_cast<int>(kLabels.size()); ++i) {
    const std::string_view label = kLabels[static_cast<std::size_t>(i)];
    const int column = left + (right - left) * i / (static_cast<int>(kLabels.size()) - 1);
    for (int row = 0; row < kTickHeight; ++row) {
      image.set(column, top + kBarTop + kBarHeight + row, kInk);
    }
    write_text(image, column - width_of(label) / 2, top + kLabelTop, label, kInk);
  }
  write_text(image, kMargin, top + kTextTop, "ERROR IN SCALE ULP", kInk);
  constexpr std::string_view kViolatedText = "VIOLATED";
  const int text = image.width - kMargin - width_of(kViolatedText);
  write_text(image, text, top + kTextTop, kViolatedText, kInk);
  for (int row = 0; row < kLetterHeight; ++row) {
    for (int column = 0; column < kLetterHeight; ++column) {
      image.set(text - kLetterHeight - 4 + column, top + kTextTop + row, kViolated);
    }
  }
}

}  // namespace

Image draw_error_map(const ErrorMap& map, cases::Rules rules) {
  assert(map.states.size() ==
         static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
  assert(map.errors.size() == map.states.size());
  Image image =
      Image::filled(std::max(map.width, kLeastWidth), map.height + kLegendHeight, kBackground);
  // A narrow map stands in the middle.
  const int left = (image.width - map.width) / 2;
  const auto for_each_pixel = [&](PixelState wanted, const auto& paint) {
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                              static_cast<std::size_t>(x);
        if (map.states[i] == wanted) paint(left + x, row_of(y, map.height, rules), map.errors[i]);
      }
    }
  };
  for_each_pixel(PixelState::correct, [&image](int column, int row, float error) {
    image.set(column, row, error_color(error));
  });
  // Last, so that no neighbour covers a cross: a single pixel would be lost among a million.
  for_each_pixel(PixelState::violated, [&image](int column, int row, float /*error*/) {
    for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      image.set(column + dx, row + dy, kViolated);
    }
  });
  draw_legend(image, map.height);
  return image;
}

}  // namespace rastercheck::reports
