#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "records/histogram.h"

namespace rastercheck::reports {

/// A magnitude that readers compare with.
struct Limit {
  double at = 0;          ///< in the histogram's unit; positive
  std::string_view name;  ///< of what it is the limit
};

/// A histogram as an SVG element: a bar for each octave of magnitude from the least to the greatest
/// that was seen, one for exactly 0, one for what lies beyond the last border. Both axes are
/// logarithmic. Colours come from the page (--ink, --muted, --line, --accent). Empty where nothing
/// finite was counted. `title` is what readers hear who do not see it. The limit is a line, where
/// it lies within the bars.
std::string histogram_svg(const records::Histogram& histogram, std::string_view title,
                          const std::optional<Limit>& limit = std::nullopt);

/// Two histograms over the same octaves, as an SVG element like the above: the bars of `after`
/// filled, those of `before` as outlines over them, heights on one scale. Colours, besides: those
/// of .before and .after. Empty where nothing finite was counted in either.
std::string overlay_svg(const records::Histogram& before, const records::Histogram& after,
                        std::string_view title);
/// Its numbers, as an HTML table.
std::string overlay_table(const records::Histogram& before, const records::Histogram& after);

/// A histogram as JSON, as reports/viewer/histogram.js reads it: {"zero": 3, "octaves": [[-2, 8],
/// …], "beyond": 0, "limit": 0.5, "limitName": "…"}. An octave is [k, values in (2^(k−1), 2^k]],
/// the first one all below as well; empty ones are left out.
std::string histogram_data(const records::Histogram& histogram, const std::optional<Limit>& limit);

}  // namespace rastercheck::reports
