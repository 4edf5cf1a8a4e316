#include "reports/internal/picture_wording.h"

#include <fmt/format.h>

#include <cmath>

#include "cases/json.h"
#include "reports/internal/exact_text.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::PixelVerdict;

constexpr int kScale8 = 255;
constexpr int kScale16 = 65535;

/// Formats the number that a stored value stands for. If stored values are integers, the number
/// gets enough decimals to tell neighbouring integers apart.
std::string number_of(const ChannelUnit& unit, float stored, int digits) {
  if (std::isnan(stored)) return "NaN";
  if (unit.is_encoded) return fmt::format("{}", stored);
  if (unit.scale == kScale8) return fmt::format("{:.3f}", stored / kScale8);
  if (unit.scale == kScale16) return fmt::format("{:.5f}", stored / kScale16);
  return fmt::format("{:.{}g}", stored, digits);
}

std::string range_words(const std::string& least, const std::string& greatest) {
  return least == greatest ? least : least + " to " + greatest;
}

}  // namespace

std::string_view meaning_of(PixelVerdict verdict) {
  switch (verdict) {
    case PixelVerdict::right:
      return "shown by some permitted drawing";
    case PixelVerdict::wrong_value:
      return "in a colour of no triangle that may be seen there";
    case PixelVerdict::wrong_triangle:
      return "in the colour of a triangle that must not be seen there";
    case PixelVerdict::extra:
      return "drawn where nothing may be drawn";
    case PixelVerdict::missing:
      return "background where a triangle must be seen";
    case PixelVerdict::not_a_number:
      return "NaN";
    case PixelVerdict::not_judged:
      break;
  }
  return "blended of several triangles, or open to one that nothing is promised about";
}

Color color_of(PixelVerdict verdict) {
  switch (verdict) {
    case PixelVerdict::right:
      return {64, 64, 64};
    case PixelVerdict::wrong_value:
      return {230, 159, 0};
    case PixelVerdict::wrong_triangle:
      return {86, 180, 233};
    case PixelVerdict::extra:
      return {240, 228, 66};
    case PixelVerdict::missing:
      return {213, 94, 0};
    case PixelVerdict::not_a_number:
      return {204, 121, 167};
    case PixelVerdict::not_judged:
      break;
  }
  return {128, 128, 128};
}

std::uint64_t pixel_count(const records::JudgedPicture& judged) {
  return static_cast<std::uint64_t>(judged.width) * static_cast<std::uint64_t>(judged.height);
}

std::vector<std::string> freedom_sentences(const records::JudgedPicture& judged) {
  const records::PictureFreedom& freedom = judged.freedom;
  std::vector<std::string> all{fmt::format(
      "The case leaves {} of its pixels one value each, lets {} differ, and keeps {} background.",
      grouped(freedom.one_value), grouped(freedom.may_differ), grouped(freedom.background))};
  if (freedom.widened > 0) {
    all.push_back(fmt::format(
        "{} have too many mixtures of samples to tell apart, and are judged by the range around "
        "all.",
        counted(freedom.widened, "pixel", "pixels")));
  }
  if (freedom.layered > 0) {
    all.push_back(fmt::format("{} not judged, since several triangles may be blended there.",
                              counted(freedom.layered, "pixel is", "pixels are")));
  }
  if (judged.not_compared > 0) {
    all.push_back(fmt::format("{} were not compared with hidden triangles.",
                              counted(judged.not_compared, "wrong pixel", "wrong pixels")));
  }
  if (judged.unpromised_triangles > 0) {
    all.push_back(fmt::format("Nothing is promised about {}.",
                              counted(judged.unpromised_triangles, "triangle", "triangles")));
  }
  return all;
}

ChannelUnit unit_of(const cases::PictureView& view, std::size_t channel) {
  switch (view.channels[channel].storage) {
    case cases::Storage::unorm8:
      return {kScale8, false};
    case cases::Storage::unorm16:
      return {kScale16, false};
    case cases::Storage::srgb8:
      return {kScale8, true};
    case cases::Storage::float32:
    case cases::Storage::float16:
      break;
  }
  return {};
}

bool is_wrong(const records::WrongChannel& channel) {
  // NaN fails these comparisons, so it is never within a range.
  const bool is_within = channel.actual >= channel.least && channel.actual <= channel.greatest;
  return !channel.is_free && !is_within;
}

std::string fault_of(const records::WrongPixel& pixel, const cases::PictureView& view) {
  constexpr std::size_t kMostNamed = 4;
  std::string text;
  std::size_t wrong = 0;
  for (std::size_t c = 0; c < pixel.channels.size(); ++c) {
    const records::WrongChannel& channel = pixel.channels[c];
    if (!is_wrong(channel) || ++wrong > kMostNamed) continue;
    const ChannelUnit unit = unit_of(view, c);
    const int digits = distinct_digits(channel.actual, {channel.least, channel.greatest});
    text += fmt::format("{}{} was drawn as {} and must be {}", text.empty() ? "" : "; ",
                        cases::printable(view.channels[c].name),
                        number_of(unit, channel.actual, digits),
                        range_words(number_of(unit, channel.least, digits),
                                    number_of(unit, channel.greatest, digits)));
    if (unit.is_encoded) {
      text += fmt::format(" of {}, sRGB", unit.scale);
    } else if (unit.scale > 1) {
      text += fmt::format(
          " ({}, not {}, of {})", channel.actual,
          range_words(fmt::format("{}", channel.least), fmt::format("{}", channel.greatest)),
          unit.scale);
    }
  }
  if (wrong > kMostNamed) {
    text += fmt::format("; and {}", counted(wrong - kMostNamed, "more channel", "more channels"));
  }
  return text;
}

std::string steps_text(double steps) {
  constexpr double kTooMany = 1e6;
  if (!(steps < kTooMany)) return "";
  if (steps == 1) return "off by 1 step";
  return fmt::format("off by {} steps", grouped(static_cast<std::uint64_t>(steps)));
}

}  // namespace rastercheck::reports
