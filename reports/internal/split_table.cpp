#include "reports/internal/split_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "reports/internal/page.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

constexpr double kSplitWidth = 200;  ///< width of a bar's box, in its own units
constexpr double kSplitHeight = 14;
constexpr double kLeastBar = 1.5;  ///< keeps the smallest bar visible

double middle(const records::Enclosure& error) { return error.lo / 2 + error.hi / 2; }

/// Maps errors to places in the box of a bar.
struct Scale {
  double least = 0;
  double greatest = 0;

  void take_in(double at) {
    if (!std::isfinite(at)) return;
    least = std::min(least, at);
    greatest = std::max(greatest, at);
  }
  double place(double at) const {
    const double range = greatest - least;
    return range > 0 ? std::clamp((at - least) / range, 0.0, 1.0) * kSplitWidth : 0;
  }
};

std::string bar(const Scale& scale, double from, double to, std::string_view style) {
  const double left = scale.place(std::min(from, to));
  const double width = std::max(scale.place(std::max(from, to)) - left, kLeastBar);
  const double zero = scale.place(0);
  return fmt::format(
      "<svg class=\"part\" viewBox=\"0 0 {} {}\" preserveAspectRatio=\"none\" aria-hidden=\"true\">"
      "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"0\" y2=\"{}\"/>"
      "<rect class=\"{}\" x=\"{:.1f}\" y=\"2\" width=\"{:.1f}\" height=\"{}\"/></svg>",
      kSplitWidth, kSplitHeight, zero, zero, kSplitHeight, style,
      std::min(left, kSplitWidth - width), width, kSplitHeight - 4);
}

std::string split_row(std::string_view name, const records::Enclosure& error,
                      const std::string& bar_of, std::string_view style) {
  const std::string text = number_text(error);
  const bool is_above = error.lo > 0;
  return fmt::format(
      "<tr{}><th scope=\"row\">{}</th><td class=\"number\">{}{}</td><td>{}</td></tr>\n", style,
      name, is_above ? "+" : "", text, bar_of);
}

}  // namespace

std::string split_table(const records::ErrorSplit& split) {
  Scale scale;
  double sum = 0;
  for (const records::StagePart& part : split.parts) {
    sum += middle(part.error);
    scale.take_in(sum);
  }
  scale.take_in(middle(split.total));

  std::string text =
      "<table class=\"split\">\n<thead><tr><th scope=\"col\">stage</th><th scope=\"col\" "
      "class=\"number\">scale ULP</th><th scope=\"col\">adds up to the total</th></tr></thead>\n"
      "<tbody>\n";
  const std::optional<records::Stage> largest = records::largest_part(split);
  double from = 0;
  for (const records::StagePart& part : split.parts) {
    const double size = middle(part.error);
    const std::string drawn =
        size == 0 ? "" : bar(scale, from, from + size, size > 0 ? "above" : "below");
    text += split_row(to_string(part.stage), part.error, drawn,
                      largest == part.stage ? " class=\"largest\"" : "");
    from += size;
  }
  text += split_row("total", split.total, bar(scale, 0, middle(split.total), "total"),
                    " class=\"total\"");
  return text + "</tbody>\n</table>\n";
}

}  // namespace rastercheck::reports
