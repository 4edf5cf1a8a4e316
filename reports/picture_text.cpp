#include "reports/picture_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "cases/float_text.h"
#include "cases/json.h"
#include "cases/names.h"
#include "reports/internal/picture_wording.h"
#include "reports/internal/wording.h"
#include "reports/text_table.h"
#include "reports/wrapped_text.h"

namespace rastercheck::reports {
namespace {

using nlohmann::json;
using records::JudgedPicture;
using records::PixelVerdict;

std::string stored_text(float value) {
  return std::isnan(value) ? "NaN" : fmt::format("{:.9g}", value);
}

std::string permitted_text(const records::WrongChannel& channel) {
  if (channel.is_free) return "any";
  if (channel.least == channel.greatest) return stored_text(channel.least);
  return fmt::format("{} to {}", stored_text(channel.least), stored_text(channel.greatest));
}

/// The channels of a wrong pixel that are wrong: "R 133, not 128 to 129".
std::string channels_text(const records::WrongPixel& pixel, const JudgedPicture& judged) {
  std::string text;
  for (std::size_t c = 0; c < pixel.channels.size(); ++c) {
    const records::WrongChannel& channel = pixel.channels[c];
    if (!is_wrong(channel)) continue;
    text += fmt::format("{}{} {}, not {}", text.empty() ? "" : "; ",
                        cases::printable(judged.channels[c]), stored_text(channel.actual),
                        permitted_text(channel));
  }
  return text;
}

std::string percent_of(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "0%"
                    : fmt::format("{:.3g}%",
                                  100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string counts_table(const JudgedPicture& judged) {
  std::vector<std::vector<std::string>> rows{{"pixels", "verdict", "meaning"}};
  for (std::size_t i = 0; i < records::kPixelVerdicts; ++i) {
    const auto verdict = static_cast<PixelVerdict>(i);
    if (judged.counts[i] == 0) continue;
    rows.push_back({grouped(judged.counts[i]), std::string(to_string(verdict)),
                    std::string(meaning_of(verdict))});
  }
  return text_table(rows);
}

std::string worst_table(const JudgedPicture& judged) {
  constexpr std::size_t kMostShown = 8;
  std::vector<std::vector<std::string>> rows{{"x", "row", "verdict", "steps off", "stored"}};
  for (const records::WrongPixel& pixel : judged.worst) {
    if (rows.size() > kMostShown) break;
    rows.push_back({std::to_string(pixel.x), std::to_string(pixel.row),
                    std::string(to_string(pixel.verdict)),
                    std::isfinite(pixel.steps) ? fmt::format("{:.6g}", pixel.steps) : "–",
                    channels_text(pixel, judged)});
  }
  return text_table(rows);
}

std::string freedom_text(const JudgedPicture& judged) {
  std::string text;
  for (const std::string& sentence : freedom_sentences(judged)) {
    text += (text.empty() ? "" : " ") + sentence;
  }
  return wrapped("", 0, text) + "\n";
}

json number_or_text(float value) {
  return std::isfinite(value) ? json(cases::to_hex(value)) : json(stored_text(value));
}

json pixel_to_json(const records::WrongPixel& pixel) {
  json channels = json::array();
  for (const records::WrongChannel& one : pixel.channels) {
    json channel{{"stored", number_or_text(one.actual)}};
    if (!one.is_free) {
      channel["least"] = number_or_text(one.least);
      channel["greatest"] = number_or_text(one.greatest);
    }
    channels.push_back(std::move(channel));
  }
  json object{{"x", pixel.x},
              {"row", pixel.row},
              {"verdict", to_string(pixel.verdict)},
              {"channels", std::move(channels)}};
  if (pixel.triangle) object["triangle"] = *pixel.triangle;
  if (std::isfinite(pixel.steps)) object["steps"] = pixel.steps;
  return object;
}

}  // namespace

std::string picture_text(const JudgedPicture& judged, bool is_brief) {
  if (is_brief) return counts_table(judged);
  const std::uint64_t wrong = judged.wrong();
  const std::uint64_t all = pixel_count(judged);
  std::string text = counts_table(judged) + "\n";
  if (!judged.worst.empty()) {
    text +=
        "Farthest off, by the nearest permitted drawing (integers k stand for k/255 or "
        "k/65535):\n" +
        worst_table(judged) + "\n";
  }
  text += freedom_text(judged);
  if (wrong > 0) {
    return text + fmt::format("Wrong: {} of {} pixels ({}).\n", grouped(wrong), grouped(all),
                              percent_of(wrong, all));
  }
  const std::uint64_t open = judged.count(PixelVerdict::not_judged);
  if (open > 0) {
    return text + fmt::format("Not judged: {} of {} pixels; the others are right.\n", grouped(open),
                              grouped(all));
  }
  return text + fmt::format("Right: all {} pixels.\n", grouped(all));
}

std::string picture_json(const JudgedPicture& judged, const cases::PictureView& view) {
  json counts;
  for (std::size_t i = 0; i < records::kPixelVerdicts; ++i) {
    counts[std::string(to_string(static_cast<PixelVerdict>(i)))] = judged.counts[i];
  }
  json channels = json::array();
  for (const cases::ShownChannel& one : view.channels) {
    channels.push_back({{"name", one.name}, {"storage", cases::name_of(one.storage)}});
  }
  json worst = json::array();
  for (const records::WrongPixel& pixel : judged.worst) worst.push_back(pixel_to_json(pixel));
  const records::PictureFreedom& freedom = judged.freedom;
  const json document{{"format", "rastercheck-judged-picture"},
                      {"version", 1},
                      {"width", judged.width},
                      {"height", judged.height},
                      {"channels", std::move(channels)},
                      {"pixels", std::move(counts)},
                      {"wrong", judged.wrong()},
                      {"worst", std::move(worst)},
                      {"one_value", freedom.one_value},
                      {"may_differ", freedom.may_differ},
                      {"background", freedom.background},
                      {"widened", freedom.widened},
                      {"layered", freedom.layered},
                      {"not_compared", judged.not_compared},
                      {"unpromised_triangles", judged.unpromised_triangles}};
  return cases::json_line(document);
}

Image verdict_image(const JudgedPicture& judged) {
  Image image;
  image.width = judged.width;
  image.height = judged.height;
  image.rgb.reserve(judged.pixels.size() * 3);
  for (const PixelVerdict verdict : judged.pixels) {
    for (const std::uint8_t part : color_of(verdict)) image.rgb.push_back(part);
  }
  return image;
}

std::string verdict_legend() {
  std::string legend;
  for (std::size_t i = 0; i < records::kPixelVerdicts; ++i) {
    const auto verdict = static_cast<PixelVerdict>(i);
    const auto color = color_of(verdict);
    legend += fmt::format("#{:02x}{:02x}{:02x} {}: {}\n", color[0], color[1], color[2],
                          to_string(verdict), meaning_of(verdict));
  }
  return legend;
}

}  // namespace rastercheck::reports
