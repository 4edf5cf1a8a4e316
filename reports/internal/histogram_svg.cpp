#include "reports/internal/histogram_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "cases/json.h"
#include "reports/internal/html.h"
#include "reports/internal/log2.h"
#include "reports/internal/page.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::Histogram;

// The layout of the drawing, in units of its view box.
constexpr double kHistogramWidth = 420;
constexpr double kHistogramHeight = 150;
constexpr double kHistogramLeft = 6;
constexpr double kHistogramRight = 414;
constexpr double kHistogramTop = 18;
constexpr double kHistogramBottom = 118;
constexpr double kWidestBar = 34;
constexpr double kLeastBetweenLabels = 34;

struct Bar {
  std::uint64_t count = 0;
  int exponent = 0;   ///< the bar's upper border is 2^exponent; 0 if it has none
  std::string sizes;  ///< the sizes that the bar counts, for its tooltip
  std::string label;  ///< shown below the right border; may be empty
};

/// Octave k holds magnitudes in (2^(kLeastExponent + k − 1), 2^(kLeastExponent + k)]. Octave 0 also
/// holds all smaller magnitudes.
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

/// The bars of a histogram for those buckets in which `seen` has counts, so that several histograms
/// have their bars at the same places.
std::vector<Bar> bars_of(const Histogram& histogram, const Histogram& seen) {
  std::vector<Bar> bars;
  const auto has = [&seen](std::size_t bucket) { return seen.count_in(bucket) > 0; };
  if (has(Histogram::kZeroBucket)) {
    bars.push_back({histogram.count_in(Histogram::kZeroBucket), 0, "error 0", "0"});
  }
  const Octaves octaves(histogram);
  const Octaves shown(seen);
  const auto is_seen = [](std::uint64_t count) { return count > 0; };
  const auto first = std::find_if(shown.counts.begin(), shown.counts.end(), is_seen);
  const auto last = std::find_if(shown.counts.rbegin(), shown.counts.rend(), is_seen).base();
  for (auto at = first; at < last; ++at) {
    const auto octave = static_cast<std::size_t>(at - shown.counts.begin());
    const int exponent = Histogram::kLeastExponent + static_cast<int>(octave);
    bars.push_back({octaves.counts[octave], exponent, octave_text(octave), power_of_two(exponent)});
  }
  if (has(Histogram::kOverflowBucket)) {
    bars.push_back({histogram.count_in(Histogram::kOverflowBucket), 0,
                    fmt::format("error > 2^{}", Histogram::kGreatestExponent), "more"});
  }
  return bars;
}

std::uint64_t most_of(const std::vector<Bar>& bars) {
  std::uint64_t most = 0;
  for (const Bar& bar : bars) most = std::max(most, bar.count);
  return most;
}

double step_of(const std::vector<Bar>& bars) {
  return std::min((kHistogramRight - kHistogramLeft) / static_cast<double>(bars.size()),
                  kWidestBar);
}

/// The height of a bar. The scale starts at half a count, so that a single count is visible.
double height_of(std::uint64_t count, std::uint64_t most) {
  if (count == 0) return 0.0;
  return (kHistogramBottom - kHistogramTop) * (drawn_log2(static_cast<double>(count)) + 1) /
         (drawn_log2(static_cast<double>(most)) + 1);
}

std::string svg_start(std::string_view title, std::uint64_t most) {
  return fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n"
      "<text x=\"{}\" y=\"11\" class=\"axis\">{} in the highest bar</text>\n",
      kHistogramWidth, kHistogramHeight, html(title), kHistogramLeft,
      counted(most, "value", "values"));
}

/// The "x, y, width and height" attributes of a bar's <rect>.
std::string rectangle(std::size_t i, double step, std::uint64_t count, std::uint64_t most) {
  const double height = height_of(count, most);
  return fmt::format(R"(x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}")",
                     kHistogramLeft + static_cast<double>(i) * step + 0.5,
                     kHistogramBottom - height, step - 1, height);
}

/// Writes labels after their bars, where they fit.
class Labels {
 public:
  explicit Labels(double step) : step_(step) {}

  std::string of(std::size_t i, const Bar& bar) {
    const double x = kHistogramLeft + static_cast<double>(i) * step_;
    // An octave's label stands at its upper border, the label of exactly 0 below the middle of its
    // bar.
    const double at = bar.label == "0" ? x + step_ / 2 : x + step_;
    if (at - last_ < kLeastBetweenLabels || at > kHistogramRight) return "";
    last_ = at;
    return fmt::format(
        "<text x=\"{:.1f}\" y=\"{}\" class=\"axis\" text-anchor=\"middle\">{}</text>\n", at,
        kHistogramBottom + 14, bar.label);
  }

 private:
  double step_;
  double last_ = kHistogramLeft - kLeastBetweenLabels;
};

std::string axis_and_end() {
  return fmt::format(
      "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n"
      "<text x=\"{}\" y=\"{}\" class=\"axis\">magnitude in scale ULP, by octave; both scales "
      "logarithmic</text>\n</svg>\n",
      kHistogramLeft, kHistogramBottom, kHistogramRight, kHistogramBottom, kHistogramLeft,
      kHistogramHeight - 4);
}

/// The position of the limit among the bars; empty if it lies beyond them.
std::optional<double> place_of_limit(const Limit& limit, const std::vector<Bar>& bars,
                                     double step) {
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const bool is_octave = bars[i].label != "0" && bars[i].label != "more";
    const double octaves = drawn_log2(limit.at) - bars[i].exponent;
    if (!is_octave || octaves <= -1 || octaves > 0) continue;
    return kHistogramLeft + (static_cast<double>(i) + 1 + octaves) * step;
  }
  return std::nullopt;
}

std::string limit_line(const Limit& limit, double place) {
  const bool is_right = place > (kHistogramLeft + kHistogramRight) / 2;
  return fmt::format(
      "<line class=\"limit\" x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\"/>\n"
      "<text class=\"limit\" x=\"{3:.1f}\" y=\"{4}\" text-anchor=\"{5}\">{6} {7}</text>\n",
      place, kHistogramTop - 3, kHistogramBottom, place + (is_right ? -4 : 4), kHistogramTop + 6,
      is_right ? "end" : "start", html(limit.name), limit.at);
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
  const std::vector<Bar> bars = bars_of(histogram, histogram);
  if (bars.empty()) return "";
  const std::uint64_t most = most_of(bars);
  const double step = step_of(bars);
  Labels labels(step);
  std::string svg = svg_start(title, most);
  for (std::size_t i = 0; i < bars.size(); ++i) {
    svg += fmt::format("<rect {}><title>{}: {}</title></rect>\n",
                       rectangle(i, step, bars[i].count, most), html(bars[i].sizes),
                       counted(bars[i].count, "value", "values"));
    svg += labels.of(i, bars[i]);
  }
  if (const auto place = limit ? place_of_limit(*limit, bars, step) : std::nullopt) {
    svg += limit_line(*limit, *place);
  }
  return svg + axis_and_end();
}

std::string overlay_svg(const Histogram& before, const Histogram& after, std::string_view title) {
  Histogram both = before;
  both.merge(after);
  const std::vector<Bar> old_bars = bars_of(before, both);
  const std::vector<Bar> new_bars = bars_of(after, both);
  if (new_bars.empty()) return "";
  const std::uint64_t most = std::max(most_of(old_bars), most_of(new_bars));
  const double step = step_of(new_bars);
  Labels labels(step);
  std::string svg = svg_start(title, most);
  for (std::size_t i = 0; i < new_bars.size(); ++i) {
    svg += fmt::format("<g><title>{}: {} → {}</title>", html(new_bars[i].sizes),
                       grouped(old_bars[i].count), counted(new_bars[i].count, "value", "values"));
    for (const auto& [style, count] :
         {std::pair("after", new_bars[i].count), std::pair("before", old_bars[i].count)}) {
      if (count == 0) continue;
      svg += fmt::format("<rect class=\"{}\" {}/>", style, rectangle(i, step, count, most));
    }
    svg += "</g>\n" + labels.of(i, new_bars[i]);
  }
  return svg + axis_and_end();
}

std::string overlay_table(const Histogram& before, const Histogram& after) {
  Histogram both = before;
  both.merge(after);
  const std::vector<Bar> old_bars = bars_of(before, both);
  const std::vector<Bar> new_bars = bars_of(after, both);
  std::string text =
      "<table class=\"counts\">\n<thead><tr><th>scale ULP</th><th class=\"number\">baseline</th>"
      "<th class=\"number\">now</th></tr></thead>\n<tbody>\n";
  const auto add = [&text](const std::string& sizes, std::uint64_t was, std::uint64_t is) {
    text += "<tr>" + cell(html(sizes)) + number_cell("baseline", grouped(was)) +
            number_cell("now", grouped(is)) + "</tr>\n";
  };
  for (std::size_t i = 0; i < new_bars.size(); ++i) {
    if (old_bars[i].count == 0 && new_bars[i].count == 0) continue;
    add(new_bars[i].sizes, old_bars[i].count, new_bars[i].count);
  }
  if (both.non_finite() > 0) add("not finite", before.non_finite(), after.non_finite());
  return text + "</tbody>\n</table>\n";
}

}  // namespace rastercheck::reports
