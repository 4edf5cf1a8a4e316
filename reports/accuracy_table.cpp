#include "reports/accuracy_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reports/text_table.h"

namespace rastercheck::reports {
namespace {

using records::AccuracyFigure;
using records::AccuracyRow;
using records::AttributeKind;
using records::Stratum;

constexpr double kMillion = 1e6;
/// Where there is no such figure.
constexpr const char* kNone = "–";

std::string error_number(double value) {
  if (value >= 1e4 && std::isfinite(value)) return fmt::format("{:.1e}", value);
  return fmt::format("{:.3g}", value);
}

/// "0.5 / 0.48": the largest error and the 99 % quantile.
std::string figure_text(const AccuracyRow& row, AttributeKind kind,
                        std::optional<Stratum> stratum) {
  const AccuracyFigure* const figure = row.figure(kind, stratum);
  if (figure == nullptr) return kNone;
  return error_number(figure->worst) + " / " + error_number(figure->p99);
}

std::string percentage(std::uint64_t part, std::uint64_t all) {
  if (all == 0) return kNone;
  if (part > 0 && part < all / 100) return "< 1%";
  return fmt::format("{:.0f}%", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

std::string wrong_samples_text(const AccuracyRow& row) {
  if (row.samples == 0) return kNone;
  const double share = static_cast<double>(row.wrong_samples) / static_cast<double>(row.samples);
  return row.wrong_samples == 0 ? "0" : error_number(share * kMillion);
}

std::vector<std::string> column_names() {
  return {"rasterizer",    "version",      "cases drawn", "wrong samples in 10^6",
          "ordinary",      "near horizon", "clipped",     "slivers",
          "window-linear", "depth",        "not numbers", "values not judged",
          "promise",       "frame time"};
}

std::vector<std::string> cells(const AccuracyRow& row) {
  const auto smooth_of = [&](Stratum stratum) {
    return figure_text(row, AttributeKind::smooth, stratum);
  };
  return {row.backend,
          row.drawn_by,
          fmt::format("{} of {}", row.drawn, row.asked),
          wrong_samples_text(row),
          smooth_of(Stratum::ordinary),
          smooth_of(Stratum::near_horizon),
          smooth_of(Stratum::clipped),
          smooth_of(Stratum::sliver),
          figure_text(row, AttributeKind::noperspective, std::nullopt),
          figure_text(row, AttributeKind::depth, std::nullopt),
          std::to_string(row.not_numbers),
          percentage(row.not_judged, row.values + row.not_judged),
          row.keeps_promise() ? "kept" : "broken",
          row.frame_time ? fmt::format("{:.1f}", *row.frame_time) : kNone};
}

/// The largest error of ordinary smooth values; infinite without any.
double inexactness_of(const AccuracyRow& row) {
  const AccuracyFigure* const figure = row.figure(AttributeKind::smooth, Stratum::ordinary);
  return figure == nullptr ? std::numeric_limits<double>::infinity() : figure->worst;
}

std::vector<AccuracyRow> ranked(std::vector<AccuracyRow> rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const AccuracyRow& a, const AccuracyRow& b) {
    return inexactness_of(a) < inexactness_of(b);
  });
  return rows;
}

std::string markdown_row(const std::vector<std::string>& row) {
  std::string line = "|";
  for (const std::string& cell : row) line += " " + cell + " |";
  return line + "\n";
}

}  // namespace

std::string accuracy_text(const std::vector<AccuracyRow>& rows,
                          std::optional<std::size_t> columns) {
  std::vector<std::vector<std::string>> table{column_names()};
  for (const AccuracyRow& row : ranked(rows)) table.push_back(cells(row));
  return text_table(table, columns);
}

std::string accuracy_markdown(const std::vector<AccuracyRow>& rows) {
  std::string text = markdown_row(column_names());
  text += "|---|---|";
  for (std::size_t i = 2; i < column_names().size(); ++i) text += "--:|";
  text += "\n";
  for (const AccuracyRow& row : ranked(rows)) text += markdown_row(cells(row));
  return text;
}

}  // namespace rastercheck::reports
