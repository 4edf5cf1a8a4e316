#include "reports/error_picture.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <string_view>
#include <utility>

#include "reports/internal/canvas.h"
#include "reports/internal/lettering.h"

namespace rastercheck::reports {
namespace {

using records::ErrorMap;
using records::PixelState;

constexpr Color kInk{40, 40, 40};

// The layout of the legend, in pixels from its top: a bar, ticks, their labels, and a line of text.
constexpr int kMargin = 8;
constexpr int kBarTop = 8;
constexpr int kBarHeight = 8;
constexpr int kTickHeight = 3;
constexpr int kLabelTop = kBarTop + kBarHeight + kTickHeight + 2;
constexpr int kTextTop = kLabelTop + kLetterHeight + 5;
constexpr int kLegendHeight = kTextTop + kLetterHeight + 6;
constexpr int kLeastWidth = 264;  ///< nine labels of four characters, with space between

void draw_legend(Image& image, int top) {
  const std::span<const std::string_view> labels = ulp_scale().labels;
  const int left = kMargin + width_of(labels.front()) / 2;
  const int right = image.width - 1 - kMargin - width_of(labels.back()) / 2;
  for (int column = left; column <= right; ++column) {
    const Color color =
        ramp_color(ulp_scale(), static_cast<double>(column - left) / (right - left));
    for (int row = 0; row < kBarHeight; ++row) image.set(column, top + kBarTop + row, color);
  }
  for (int i = 0; i < static_cast<int>(labels.size()); ++i) {
    const std::string_view label = labels[static_cast<std::size_t>(i)];
    const int column = left + (right - left) * i / (static_cast<int>(labels.size()) - 1);
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
      image.set(text - kLetterHeight - 4 + column, top + kTextTop + row, ulp_scale().violated);
    }
  }
}

/// Paints the map's pixels, with the map's first column at `left`.
void paint(Image& image, int left, const ErrorMap& map, cases::Rules rules,
           const ErrorScale& scale) {
  assert(map.states.size() ==
         static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
  assert(map.errors.size() == map.states.size());
  const auto for_each_pixel = [&](PixelState wanted, const auto& show) {
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                              static_cast<std::size_t>(x);
        if (map.states[i] == wanted) show(left + x, row_of(y, map.height, rules), map.errors[i]);
      }
    }
  };
  for_each_pixel(PixelState::correct, [&](int column, int row, float error) {
    image.set(column, row, error_color(scale, error));
  });
  // Violated pixels come last, so that no neighbour covers their crosses. A cross is easier to see
  // than a single pixel among a million.
  for_each_pixel(PixelState::violated, [&](int column, int row, float /*error*/) {
    for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      image.set(column + dx, row + dy, scale.violated);
    }
  });
}

}  // namespace

Image draw_errors(const ErrorMap& map, cases::Rules rules, const ErrorScale& scale) {
  Image image = Image::filled(map.width, map.height, kUndrawn);
  paint(image, 0, map, rules, scale);
  return image;
}

Image draw_error_map(const ErrorMap& map, cases::Rules rules) {
  Image image =
      Image::filled(std::max(map.width, kLeastWidth), map.height + kLegendHeight, kUndrawn);
  // Centres a map that is narrower than the legend.
  paint(image, (image.width - map.width) / 2, map, rules, ulp_scale());
  draw_legend(image, map.height);
  return image;
}

}  // namespace rastercheck::reports
