#include "reports/internal/part_data.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "reports/commands.h"
#include "reports/internal/embedded_json.h"
#include "reports/internal/picture_colors.h"
#include "reports/internal/picture_wording.h"

namespace rastercheck::reports {
namespace {

using nlohmann::json;

/// Gives the fewest digits that identify the float32; gives NaN and infinities as texts.
json stored_data(float value) {
  if (std::isfinite(value)) return std::strtod(fmt::format("{}", value).c_str(), nullptr);
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

std::string color_text(const Color& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

json channels_data(const JudgedPage& page) {
  json all = json::array();
  for (std::size_t c = 0; c < page.view.channels.size(); ++c) {
    const ChannelUnit unit = unit_of(page.view, c);
    const bool is_half = page.view.channels[c].storage == cases::Storage::float16;
    all.push_back({page.view.channels[c].name, shown_text(page, c), unit.scale,
                   unit.is_encoded ? 1 : 0, is_half ? 1 : 0});
  }
  return all;
}

json verdicts_data() {
  json all = json::array();
  for (std::size_t i = 0; i < records::kPixelVerdicts; ++i) {
    const auto verdict = static_cast<records::PixelVerdict>(i);
    all.push_back({to_string(verdict), meaning_of(verdict), color_text(color_of(verdict))});
  }
  return all;
}

/// The triangle or null, then each channel's range: null if the channel is free, one number if both
/// ends are equal.
json answer_data(const records::PermittedAnswer& answer) {
  json ranges = json::array();
  for (const records::StoredRange& range : answer.channels) {
    if (range.is_free) {
      ranges.push_back(nullptr);
    } else if (range.least == range.greatest) {
      ranges.push_back(stored_data(range.least));
    } else {
      ranges.push_back({stored_data(range.least), stored_data(range.greatest)});
    }
  }
  return {answer.triangle ? json(*answer.triangle) : json(), std::move(ranges)};
}

json pixel_data(const PictureColors& colors, const records::DetailedPixel& pixel) {
  json stored = json::array();
  for (const float value : pixel.stored) stored.push_back(stored_data(value));
  json answers = json::array();
  for (const records::PermittedAnswer& answer : pixel.answers) {
    answers.push_back(answer_data(answer));
  }
  return {static_cast<int>(pixel.verdict), color_text(colors.of(pixel.stored.data())),
          std::move(stored), std::move(answers), pixel.more_answers};
}

}  // namespace

std::string part_data(const JudgedPage& page, const PictureColors& colors,
                      const records::PicturePart& part) {
  json pixels = json::array();
  for (const records::DetailedPixel& pixel : part.pixels) {
    pixels.push_back(pixel_data(colors, pixel));
  }
  json outlines = json::array();
  for (const records::TriangleOutline& outline : part.outlines) {
    json points = json::array();
    for (const records::WindowPoint& point : outline.points) points.push_back({point.x, point.y});
    outlines.push_back({outline.triangle, std::move(points)});
  }
  const json document{
      {"isUp", is_upwards(page)},
      {"flippedHeight", page.view.is_flipped ? json(page.view.size.height) : json()},
      {"samples", page.view.size.samples},
      {"channels", channels_data(page)},
      {"verdicts", verdicts_data()},
      {"explain", page.explain.empty() ? json() : json(command_line(page.explain))},
      {"left", part.left},
      {"top", part.top},
      {"width", part.width},
      {"height", part.height},
      {"x", part.x},
      {"y", part.row},
      {"outlines", std::move(outlines)},
      {"pixels", std::move(pixels)}};
  return embedded_json(document);
}

}  // namespace rastercheck::reports
