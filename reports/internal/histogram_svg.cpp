#include "reports/internal/histogram_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

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
  if (zeros > 0) bars.push_back({zeros, "error 0", "0"});
  const Octaves octaves(histogram);
  const auto is_seen = [](std::uint64_t count) { return count > 0; };
  const auto first = std::find_if(octaves.counts.begin(), octaves.counts.end(), is_seen);
  const auto last = std::find_if(octaves.counts.rbegin(), octaves.counts.rend(), is_seen).base();
  for (auto at = first; at < last; ++at) {
    const auto octave = static_cast<std::size_t>(at - octaves.counts.begin());
    bars.push_back({*at, octave_text(octave),
                    power_of_two(Histogram::kLeastExponent + static_cast<int>(octave))});
  }
  const std::uint64_t beyond = histogram.count_in(Histogram::kOverflowBucket);
  if (beyond > 0) {
    bars.push_back({beyond, fmt::format("error > 2^{}", Histogram::kGreatestExponent), "more"});
  }
  return bars;
}

}  // namespace

std::string histogram_svg(const Histogram& histogram, std::string_view title) {
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
  svg += fmt::format(
      "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n"
      "<text x=\"{}\" y=\"{}\" class=\"axis\">magnitude in scale ULP, by octave; both scales "
      "logarithmic</text>\n</svg>\n",
      kLeft, kBottom, kRight, kBottom, kLeft, kHeight - 4);
  return svg;
}

}  // namespace rastercheck::reports
