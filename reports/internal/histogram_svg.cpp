#include "reports/internal/histogram_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cases/json.h"
#include "reports/internal/html.h"
#include "reports/internal/log2.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::Histogram;

// The drawing, in units of its view box.
constexpr double kWidth = 420;
constexpr double kHeight = 150;
constexpr double kLeft = 6;
constexpr double kRight = 414;
constexpr double kTop = 18;
constexpr double kBottom = 118;
constexpr double kWidestBar = 34;
constexpr double kLeastBetweenLabels = 34;

struct Bar {
  std::uint64_t count = 0;
  int exponent = 0;   ///< of its upper border 2^exponent; of those without one 0
  std::string sizes;  ///< what it counts, for its tooltip
  std::string label;  ///< below its right border; empty for none
};

/// Octave k holds magnitudes up to 2^(kLeastExponent + k), above half of that; octave 0 all below.
struct Octaves {
  std::vector<std::uint64_t> counts;

  explicit Octaves(const Histogram& histogram)
      : counts(1 + Histogram::kGreatestExponent - Histogram::kLeastExponent) {
    constexpr std::size_t kFirst = Histogram::kZeroBucket + 1;
    for (std::size_t bucket = kFirst; bucket < Histogram::kOverflowBucket; ++bucket) {
      constexpr std::size_t kOfOctave = Histogram::kBucketsPerOctave;
      counts[(bucket - kFirst + kOfOctave - 1) / kOfOctave] += histogram.count_in(bucket);
    }
  }
};

std::string power_of_two(int exponent) {
  return fmt::format(R"(2<tspan dy="-4" font-size="8">{}</tspan>)", exponent);
}

/// "2^-3 < error ≤ 2^-2".
std::string octave_text(std::size_t octave) {
  const int upper = Histogram::kLeastExponent + static_cast<int>(octave);
  return octave == 0 ? fmt::format("0 < error ≤ 2^{}", upper)
                     : fmt::format("2^{} < error ≤ 2^{}", upper - 1, upper);
}

std::vector<Bar> bars_of(const Histogram& histogram) {
  std::vector<Bar> bars;
  const std::uint64_t zeros = histogram.count_in(Histogram::kZeroBucket);
  if (zeros > 0) bars.push_back({zeros, 0, "error 0", "0"});
  const Octaves octaves(histogram);
  const auto is_seen = [](std::uint64_t count) { return count > 0; };
  const auto first = std::find_if(octaves.counts.begin(), octaves.counts.end(), is_seen);
  const auto last = std::find_if(octaves.counts.rbegin(), octaves.counts.rend(), is_seen).base();
  for (auto at = first; at < last; ++at) {
    const auto octave = static_cast<std::size_t>(at - octaves.counts.begin());
    const int exponent = Histogram::kLeastExponent + static_cast<int>(octave);
    bars.push_back({*at, exponent, octave_text(octave), power_of_two(exponent)});
  }
  const std::uint64_t beyond = histogram.count_in(Histogram::kOverflowBucket);
  if (beyond > 0) {
    bars.push_back({beyond, 0, fmt::format("error > 2^{}", Histogram::kGreatestExponent), "more"});
  }
  return bars;
}

/// Where the limit lies among the bars; nothing where it lies beyond them.
std::optional<double> place_of(const Limit& limit, const std::vector<Bar>& bars, double step) {
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const bool is_octave = bars[i].label != "0" && bars[i].label != "more";
    const double octaves = drawn_log2(limit.at) - bars[i].exponent;
    if (!is_octave || octaves <= -1 || octaves > 0) continue;
    return kLeft + (static_cast<double>(i) + 1 + octaves) * step;
  }
  return std::nullopt;
}

std::string limit_line(const Limit& limit, double place) {
  const bool is_right = place > (kLeft + kRight) / 2;
  return fmt::format(
      "<line class=\"limit\" x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\"/>\n"
      "<text class=\"limit\" x=\"{3:.1f}\" y=\"{4}\" text-anchor=\"{5}\">{6} {7}</text>\n",
      place, kTop - 3, kBottom, place + (is_right ? -4 : 4), kTop + 6, is_right ? "end" : "start",
      html(limit.name), limit.at);
}

}  // namespace

std::string histogram_data(const Histogram& histogram, const std::optional<Limit>& limit) {
  std::string octaves;
  const Octaves all(histogram);
  for (std::size_t i = 0; i < all.counts.size(); ++i) {
    if (all.counts[i] == 0) continue;
    octaves += fmt::format("{}[{},{}]", octaves.empty() ? "" : ",",
                           Histogram::kLeastExponent + static_cast<int>(i), all.counts[i]);
  }
  std::string text = fmt::format(R"({{"zero":{},"octaves":[{}],"beyond":{})",
                                 histogram.count_in(Histogram::kZeroBucket), octaves,
                                 histogram.count_in(Histogram::kOverflowBucket));
  if (limit) {
    text +=
        fmt::format(R"(,"limit":{},"limitName":{})", limit->at, cases::json_string(limit->name));
  }
  return text + "}";
}

std::string histogram_svg(const Histogram& histogram, std::string_view title,
                          const std::optional<Limit>& limit) {
  const std::vector<Bar> bars = bars_of(histogram);
  if (bars.empty()) return "";
  std::uint64_t most = 0;
  for (const Bar& bar : bars) most = std::max(most, bar.count);

  const double step = std::min((kRight - kLeft) / static_cast<double>(bars.size()), kWidestBar);
  // One count is a bar that is seen: the scale starts at half of it.
  const auto height_of = [most](std::uint64_t count) {
    if (count == 0) return 0.0;
    return (kBottom - kTop) * (drawn_log2(static_cast<double>(count)) + 1) /
           (drawn_log2(static_cast<double>(most)) + 1);
  };
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n"
      "<text x=\"{}\" y=\"11\" class=\"axis\">{} in the highest bar</text>\n",
      kWidth, kHeight, html(title), kLeft, counted(most, "value", "values"));
  double last_label = kLeft - kLeastBetweenLabels;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const double x = kLeft + static_cast<double>(i) * step;
    const double height = height_of(bars[i].count);
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">"
        "<title>{}: {}</title></rect>\n",
        x + 0.5, kBottom - height, step - 1, height, html(bars[i].sizes),
        counted(bars[i].count, "value", "values"));
    const bool is_zero = bars[i].label == "0";
    // An octave's label stands at its upper border, that of exactly 0 below its bar.
    const double label_at = is_zero ? x + step / 2 : x + step;
    if (label_at - last_label < kLeastBetweenLabels || label_at > kRight) continue;
    svg +=
        fmt::format("<text x=\"{:.1f}\" y=\"{}\" class=\"axis\" text-anchor=\"middle\">{}</text>\n",
                    label_at, kBottom + 14, bars[i].label);
    last_label = label_at;
  }
  if (const auto place = limit ? place_of(*limit, bars, step) : std::nullopt) {
    svg += limit_line(*limit, *place);
  }
  svg += fmt::format(
      "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n"
      "<text x=\"{}\" y=\"{}\" class=\"axis\">magnitude in scale ULP, by octave; both scales "
      "logarithmic</text>\n</svg>\n",
      kLeft, kBottom, kRight, kBottom, kLeft, kHeight - 4);
  return svg;
}

}  // namespace rastercheck::reports
