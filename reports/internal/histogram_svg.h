#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "records/histogram.h"

namespace rastercheck::reports {

/// A magnitude that readers can compare errors with.
struct Limit {
  double at = 0;          ///< in the histogram's unit; positive
  std::string_view name;  ///< what the magnitude limits
};

/// A histogram as an SVG element. It has a bar for each octave of magnitude from the least to the
/// greatest seen, one for exactly 0, and one for values beyond the last border. Both axes are
/// logarithmic. The page supplies the colours (--ink, --muted, --line, --accent). Empty if nothing
/// finite was counted. Screen readers read `title`. The limit is a line, if it lies within the
/// bars.
std::string histogram_svg(const records::Histogram& histogram, std::string_view title,
                          const std::optional<Limit>& limit = std::nullopt);

/// Two histograms over the same octaves, as an SVG element like that of histogram_svg(). Bars of
/// `after` are filled, bars of `before` are outlines over them, and both have the same scale of
/// heights. The page also supplies the colours of .before and .after. Empty if nothing finite was
/// counted in either.
std::string overlay_svg(const records::Histogram& before, const records::Histogram& after,
                        std::string_view title);
/// The numbers of overlay_svg(), as an HTML table.
std::string overlay_table(const records::Histogram& before, const records::Histogram& after);

/// A histogram as JSON, for reports/viewer/histogram.js: {"zero": 3, "octaves": [[-2, 8], …],
/// "beyond": 0, "limit": 0.5, "limitName": "…"}. An octave is [k, number of values in (2^(k−1),
/// 2^k]]; the first octave also counts everything below. Empty octaves are left out.
std::string histogram_data(const records::Histogram& histogram, const std::optional<Limit>& limit);

}  // namespace rastercheck::reports
