#include "reports/internal/stage_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <span>

#include "reports/internal/page.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::Stage;
using records::StageMean;

constexpr double kStageWidth = 100;  ///< width of a bar, in its own units
constexpr double kStageHeight = 10;

/// The total that a part adds to the errors of its kind and stratum; 0 if unknown.
double weight_of(const StageMean& part) {
  if (!part.mean) return 0;
  return (part.mean->lo / 2 + part.mean->hi / 2) * static_cast<double>(part.values);
}

const StageMean* find_part(std::span<const StageMean> parts, Stage stage) {
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [stage](const StageMean& part) { return part.stage == stage; });
  return found == parts.end() ? nullptr : &*found;
}

std::string bar_of(std::span<const StageMean> parts) {
  double whole = 0;
  for (const StageMean& part : parts) whole += weight_of(part);
  std::string text = fmt::format(
      "<svg class=\"shares\" viewBox=\"0 0 {} {}\" preserveAspectRatio=\"none\" "
      "aria-hidden=\"true\">",
      kStageWidth, kStageHeight);
  double from = 0;
  for (const StageMean& part : parts) {
    const double width = whole > 0 ? weight_of(part) / whole * kStageWidth : 0;
    if (width > 0) {
      text += fmt::format("<rect class=\"stage-{}\" x=\"{:.2f}\" width=\"{:.2f}\" height=\"{}\"/>",
                          static_cast<int>(part.stage), from, width, kStageHeight);
    }
    from += width;
  }
  return text + "</svg>";
}

std::string stage_row(std::span<const StageMean> parts, const std::set<Stage>& stages) {
  const StageMean& first = parts.front();
  const auto largest = std::max_element(
      parts.begin(), parts.end(),
      [](const StageMean& a, const StageMean& b) { return weight_of(a) < weight_of(b); });
  std::string text =
      "<tr>" + cell(std::string(to_string(first.kind))) +
      cell(first.stratum ? std::string(to_string(*first.stratum)) : std::string("all")) +
      "<td class=\"bar\">" + bar_of(parts) + "</td>";
  for (const Stage stage : stages) {
    const StageMean* const part = find_part(parts, stage);
    const std::string number = part != nullptr ? mean_text(part->mean) : std::string(kNothing);
    const bool is_largest = part == &*largest && weight_of(*largest) > 0;
    text += number_cell(to_string(stage), is_largest ? "<strong>" + number + "</strong>" : number);
  }
  return text + "</tr>\n";
}

}  // namespace

std::string stage_table(const records::LawSummary& row) {
  if (row.stages.empty()) return "";
  std::set<Stage> stages;
  for (const StageMean& part : row.stages) stages.insert(part.stage);
  std::string text =
      "<h4>Errors by stage</h4>\n<p class=\"unit\">How large the part of each stage is on the "
      "mean, in scale ULP; the bar is of their shares. Parts of several stages may cancel, "
      "so that an error can be smaller than its parts.</p>\n<table class=\"stages\">\n<thead><tr>"
      "<th>kind</th><th>stratum</th><th>share of each stage</th>";
  for (const Stage stage : stages) {
    text += fmt::format("<th class=\"number\"><span class=\"key stage-{}\"></span>{}</th>",
                        static_cast<int>(stage), to_string(stage));
  }
  text += "</tr></thead>\n<tbody>\n";
  const std::span<const StageMean> all = row.stages;
  for (std::size_t begin = 0; begin < all.size();) {
    std::size_t end = begin;
    while (end < all.size() && all[end].kind == all[begin].kind &&
           all[end].stratum == all[begin].stratum) {
      ++end;
    }
    text += stage_row(all.subspan(begin, end - begin), stages);
    begin = end;
  }
  return text + "</tbody>\n</table>\n";
}

}  // namespace rastercheck::reports
