#include "reports/inspection_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/float_text.h"
#include "cases/json.h"
#include "records/enclosure.h"
#include "records/histogram.h"
#include "reports/counterexample_text.h"
#include "reports/text_table.h"
#include "reports/wrapped_text.h"

namespace rastercheck::reports {
namespace {

using records::Enclosure;
using records::InspectedSample;
using records::InspectedValue;
using records::Inspection;
using records::Verdict;

constexpr int kDigits = 6;  ///< the most digits of errors and distances

/// The number of bytes of the text's first character (UTF-8).
std::size_t first_length(std::string_view text) {
  std::size_t length = 1;
  while (length < text.size() && (text[length] & 0xc0) == 0x80) ++length;
  return length;
}

/// Returns `label`, then the text from column `indent` on, broken into lines.
std::string broken(std::string_view label, std::size_t indent, std::string_view text) {
  std::string lines = fmt::format("{:<{}}", label, indent);
  std::size_t column = indent;
  while (!text.empty()) {
    if (column == kTerminalWidth) {
      lines += "\n" + std::string(indent, ' ');
      column = indent;
    }
    const std::size_t length = first_length(text);
    lines += text.substr(0, length);
    text.remove_prefix(length);
    ++column;
  }
  return lines + "\n";
}

std::string number(const Enclosure& enclosure) { return records::to_decimal(enclosure, kDigits); }

// --- Triangle and sample -------------------------------------------------------------------------

std::string triangle_text(const Inspection& inspection) {
  const cases::Case& c = inspection.source;
  const cases::Triangle& triangle = c.triangles[inspection.place.triangle];
  std::string text = wrapped("", 2, state_text(c).substr(2, state_text(c).size() - 3));
  const char* unit = c.coverage ? "grid" : "window";
  std::vector<std::vector<std::string>> rows{
      {"  vertex", "x", "y", "z", "w", fmt::format("{} x", unit), fmt::format("{} y", unit)}};
  std::size_t behind = 0;
  for (const std::uint32_t vertex : triangle) {
    const cases::ClipVertex& p = c.positions[vertex];
    const auto [x, y] = window_text(c, p);
    std::vector<std::string> row{fmt::format("  {}", vertex)};
    for (const float coordinate : {p.x, p.y, p.z, p.w}) {
      row.push_back(fmt::format("{:.6g}", coordinate));
    }
    row.insert(row.end(), {x, y});
    rows.push_back(std::move(row));
    if (p.w <= 0) ++behind;
  }
  text += text_table(rows);
  if (!inspection.q_matrix)
    text += "  The triangle is seen edge-on (det M = 0) and covers nothing.\n";
  if (behind > 0) {
    text += fmt::format("  {} of its vertices {} not in front of the eye (w <= 0).\n", behind,
                        behind == 1 ? "is" : "are");
  }
  return text;
}

/// Describes the verdict together with what was drawn.
std::string coverage_words(const InspectedSample& sample) {
  const bool is_permitted = sample.verdict == Verdict::permitted;
  if (sample.is_drawn) {
    if (sample.verdict == Verdict::forbidden) return "EXTRA: drawn but must not be";
    return is_permitted ? "drawn, as it may be" : "drawn, as it must be";
  }
  if (sample.verdict == Verdict::required) return "MISSING: not drawn but must be";
  return is_permitted ? "not drawn, as it may be" : "not drawn, correctly";
}

/// "NaN", "inf", "-inf", or the number in decimal and hex.
std::string drawn_value_text(float actual) {
  if (std::isnan(actual)) return "NaN";
  if (!std::isfinite(actual)) return fmt::format("{}", actual);
  return fmt::format("{:.9g} = {}", actual, cases::to_hex(actual));
}

/// Names the values that are no numbers although the exact ones are: "; WRONG: attribute 0 'u' is
/// NaN". Empty if there are none.
std::string wrong_values(const Inspection& inspection, const InspectedSample& sample) {
  std::string text;
  for (const InspectedValue& value : sample.values) {
    const bool is_number = !value.actual || std::isfinite(*value.actual);
    const bool should_be =
        value.nearest && std::abs(*value.nearest) <= double{std::numeric_limits<float>::max()};
    if (is_number || !should_be) continue;
    std::string name = "depth";
    if (value.attribute) {
      name = fmt::format("attribute {}", *value.attribute);
      const std::string& own = inspection.source.attributes[*value.attribute].name;
      if (!own.empty()) name += fmt::format(" '{}'", cases::printable(own));
    }
    text += fmt::format("{} {} is {}", text.empty() ? "; WRONG:" : ",", name,
                        drawn_value_text(*value.actual));
  }
  return text;
}

/// The verdict, what was drawn, the place, and how far the sample is from the deciding boundary.
std::string found_text(const Inspection& inspection, const InspectedSample& sample) {
  const records::WindowPoint in_pixel = sample.place.sample < inspection.pattern.size()
                                            ? inspection.pattern[sample.place.sample]
                                            : records::WindowPoint{};
  std::string text =
      wrapped("", 0,
              fmt::format("{} ({}, {}){}", coverage_words(sample), to_string(sample.verdict),
                          to_string(sample.reason), wrong_values(inspection, sample)));
  text += fmt::format("  pixel ({}, {}), sample {}, of triangle {}, on {}\n", sample.place.x,
                      sample.place.y, sample.place.sample, inspection.place.triangle,
                      cases::printable(inspection.backend));
  if (!inspection.law.empty()) {
    text += wrapped("", 2, "A counterexample to " + cases::printable(inspection.law) + ".");
  }
  std::string where = fmt::format("The sample is at ({}, {})", sample.place.x + in_pixel.x,
                                  sample.place.y + in_pixel.y);
  if (sample.distance) {
    where += fmt::format(", {} pixels from the boundary that decides (positive: inside)",
                         number(*sample.distance));
  }
  text += wrapped("", 2, where + ".");
  if (inspection.coverage_stage) {
    text += wrapped("", 2,
                    fmt::format("Up to the stage `{}` its coverage is right; there it goes wrong.",
                                to_string(*inspection.coverage_stage)));
  }
  return text;
}

// --- The pixels around ---------------------------------------------------------------------------

/// One sample of the picture: drawn or not, rightly or not.
char sign_of(const InspectedSample& sample) {
  if (sample.is_drawn) return sample.verdict == Verdict::forbidden ? '+' : '#';
  return sample.verdict == Verdict::required ? '-' : '.';
}

/// Draws one sample of each pixel around, the inspected one in brackets. Empty if there are none.
std::string map_of_pixels(const Inspection& inspection) {
  constexpr std::uint32_t kAround = 6;  // pixels on either side
  const cases::SamplePlace& at = inspection.place;
  const auto is_near = [](std::uint32_t a, std::uint32_t b) {
    return (a > b ? a - b : b - a) <= kAround;
  };
  std::string rows;
  std::string columns;
  std::optional<std::uint32_t> row;
  bool is_first_row = true;
  for (const InspectedSample& sample : inspection.samples) {
    const cases::SamplePlace& place = sample.place;
    if (place.sample != at.sample || !is_near(place.x, at.x) || !is_near(place.y, at.y)) continue;
    if (row != place.y) {
      is_first_row = !row;
      rows.erase(rows.find_last_not_of(' ') + 1);
      rows += fmt::format("{}  y {:>5}", row ? "\n" : "", place.y);
      row = place.y;
    }
    if (is_first_row) columns += fmt::format("{:>5} ", place.x);
    const bool is_it = place.x == at.x && place.y == at.y;
    rows += fmt::format("   {}{}{}", is_it ? '[' : ' ', sign_of(sample), is_it ? ']' : ' ');
  }
  if (rows.empty()) return "";
  rows.erase(rows.find_last_not_of(' ') + 1);
  return fmt::format("{}\n  x      {}\n  # drawn   . correctly not drawn   - MISSING   + EXTRA\n",
                     rows, columns.substr(0, columns.find_last_not_of(' ') + 1));
}

// --- The projective map --------------------------------------------------------------------------

/// The sum of enclosed numbers, with both ends rounded outwards.
Enclosure sum_of(const std::array<Enclosure, 3>& numbers) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Enclosure sum = numbers[0];
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    sum.lo = std::nextafter(sum.lo + numbers[i].lo, -kInfinity);
    sum.hi = std::nextafter(sum.hi + numbers[i].hi, kInfinity);
  }
  return sum;
}

std::string map_text(const Inspection& inspection, const InspectedSample& sample) {
  if (!inspection.q_matrix) return "";
  std::string text = "q-matrix, of e_i = A_i u + B_i v + C_i\n";
  std::vector<std::vector<std::string>> rows{{"  i", "A", "B", "C"}};
  std::size_t width = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<std::string> row{fmt::format("  {}", i)};
    row.insert(row.end(), (*inspection.q_matrix)[i].begin(), (*inspection.q_matrix)[i].end());
    rows.push_back(std::move(row));
  }
  for (std::size_t column = 0; column < 4; ++column) {
    std::size_t widest = 0;
    for (const auto& row : rows) widest = std::max(widest, row[column].size());
    width += widest + 2;
  }
  if (width <= kTerminalWidth) {
    text += text_table(rows);
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        text += broken(fmt::format("  {}_{}", "ABC"[k], i), 7, (*inspection.q_matrix)[i][k]);
      }
    }
  }
  if (!sample.edges) return text;
  const auto& e = *sample.edges;
  text += wrapped("", 2,
                  fmt::format("Here e = ({}, {}, {}), and 1/w = D = Σ e_i = {}.", number(e[0]),
                              number(e[1]), number(e[2]), number(sum_of(e))));
  return text;
}

// --- The split -----------------------------------------------------------------------------------

double middle_of(const Enclosure& enclosure) { return (enclosure.lo + enclosure.hi) / 2; }

/// The number of decimals with which `largest`, the largest of some numbers, has six digits. It
/// must not be 0.
int decimals_for(double largest) {
  if (!std::isfinite(largest)) return 1;
  return std::clamp(5 - static_cast<int>(std::floor(std::log10(largest))), 0, 15);
}

/// A signed number with fixed decimals, so that readers can add up parts by eye. Uses powers of ten
/// if the number would not fit or would show only zeros.
std::string signed_text(double value, int decimals) {
  constexpr double kMost = 1e15;
  if (value == 0) return "0";
  if (std::abs(value) >= kMost) return fmt::format("{:+.6e}", value);
  std::string text = fmt::format("{:+.{}f}", value, decimals);
  const bool is_seen = text.find_first_of("123456789") != std::string::npos;
  return is_seen ? text : fmt::format("{:+.1e}", value);
}

/// A bar, `###|` or `|###`, whose length is the value's share of the largest; a dot if that is too
/// short.
std::string bar_text(double value, double largest, std::size_t half) {
  const bool is_visible = value != 0 && largest > 0 && std::isfinite(largest);
  const auto length = is_visible ? static_cast<std::size_t>(std::lround(std::abs(value) / largest *
                                                                        static_cast<double>(half)))
                                 : 0;
  std::string bar(length, '#');
  if (is_visible && length == 0) bar = ".";
  if (value < 0) return std::string(half - bar.size(), ' ') + bar + "|";
  return std::string(half, ' ') + "|" + bar;
}

std::string split_text(const records::ErrorSplit& split) {
  constexpr std::size_t kIndent = 4;
  double largest = records::magnitude_bound(split.total);
  for (const records::StagePart& part : split.parts) {
    largest = std::max(largest, records::magnitude_bound(part.error));
  }
  if (largest == 0) return ": no stage is off\n";
  const int decimals = decimals_for(largest);
  std::vector<std::pair<std::string, double>> rows;
  rows.reserve(split.parts.size() + 1);
  for (const records::StagePart& part : split.parts) {
    rows.emplace_back(to_string(part.stage), middle_of(part.error));
  }
  rows.emplace_back("total", middle_of(split.total));
  std::size_t names = 0;
  std::size_t numbers = 0;
  for (const auto& [name, value] : rows) {
    names = std::max(names, name.size());
    numbers = std::max(numbers, signed_text(value, decimals).size());
  }
  const std::size_t before = kIndent + names + 2 + numbers + 2;
  const std::size_t half = (kTerminalWidth - before - 1) / 2;
  std::string text = fmt::format(
      " by stage, in scale ULP, {}:\n",
      split.is_traced ? "as the backend traced it" : "without the backend's own stages");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [name, value] = rows[i];
    if (i + 1 == rows.size()) {
      text += std::string(kIndent, ' ') + std::string(names + 2 + numbers, '-') + "\n";
    }
    text += fmt::format("{:{}}{:<{}}  {:>{}}  {}", "", kIndent, name, names,
                        signed_text(value, decimals), numbers, bar_text(value, largest, half));
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  return text;
}

const records::ErrorSplit* find_split(const Inspection& inspection,
                                      std::optional<std::uint32_t> attribute) {
  const auto found =
      std::find_if(inspection.splits.begin(), inspection.splits.end(),
                   [&](const records::ErrorSplit& one) { return one.attribute == attribute; });
  return found == inspection.splits.end() ? nullptr : &*found;
}

// --- Values --------------------------------------------------------------------------------------

constexpr std::size_t kColumn = 10;  ///< where descriptions of a value begin

std::string value_name(const Inspection& inspection, std::optional<std::uint32_t> attribute) {
  if (!attribute) return "depth";
  const cases::Attribute& declared = inspection.source.attributes[*attribute];
  std::string text = fmt::format("attribute {}", *attribute);
  if (!declared.name.empty()) text += fmt::format(" '{}'", cases::printable(declared.name));
  text += fmt::format(", {}", cases::name_of(declared.interpolation));
  if (declared.location != cases::Location::sample) {
    text += fmt::format(" at the {}", cases::name_of(declared.location));
  }
  const cases::Triangle& triangle = inspection.source.triangles[inspection.place.triangle];
  std::string values;
  for (const std::uint32_t vertex : triangle) {
    values += fmt::format("{}{:.9g}", values.empty() ? "" : ", ",
                          inspection.source.attributes_of(vertex)[*attribute]);
  }
  return fmt::format("{}; at the vertices {}", text, values);
}

std::string errors_text(const InspectedValue& value) {
  if (!value.scale_error) return "";
  std::string text = fmt::format("{} scale ULP", number(*value.scale_error));
  if (value.local_error) text += fmt::format(", {} local ULP", number(*value.local_error));
  if (value.excess) {
    text += fmt::format("; {} after allowances", number(*value.excess));
  }
  return wrapped("  error", kColumn, text);
}

std::string conditions_text(const InspectedValue& value) {
  if (!value.kappa && !value.kappa_d) return "";
  const auto text_of = [](const std::optional<Enclosure>& condition) {
    return condition ? number(*condition) : std::string("none");
  };
  return fmt::format("  {:<8}{}, κ_D {}\n", "κ", text_of(value.kappa), text_of(value.kappa_d));
}

std::string value_text(const Inspection& inspection, const InspectedValue& value) {
  std::string text = wrapped("", 0, value_name(inspection, value.attribute));
  text += value.exact.empty() ? broken("  exact", kColumn, "undefined")
                              : broken("  exact", kColumn, value.exact);
  if (value.nearest && value.exact != fmt::format("{:.17g}", *value.nearest)) {
    text += broken("", kColumn, fmt::format("about {:.12g}", *value.nearest));
  }
  text += broken("  drawn", kColumn, value.actual ? drawn_value_text(*value.actual) : "nothing");
  return text + errors_text(value) + conditions_text(value);
}

/// How the value's error comes about, stage by stage; empty if unknown.
std::string stages_of_error(const Inspection& inspection, const InspectedValue& value) {
  const records::ErrorSplit* split = find_split(inspection, value.attribute);
  if (split == nullptr) return "";
  std::string text =
      "error of " +
      (value.attribute ? fmt::format("attribute {}", *value.attribute) : std::string("depth")) +
      split_text(*split);
  if (value.scale_error && *value.scale_error != split->total) {
    text += value.exact.starts_with('[')
                ? "    The total is against the exact value at the place that was taken.\n"
                : "    The total is against the case's object positions, not yet rounded.\n";
  }
  return text;
}

constexpr std::string_view kLegend =
    "Scale ULP: the spacing of float32 at the largest of the triangle's three values, of depth at "
    "the greater end of the depth range; local ULP: at the exact value itself. κ: how relative "
    "errors of the weights e_i are amplified; κ_D: how much cancels within them. Errors are drawn "
    "minus exact.";

}  // namespace

std::string inspection_text(const Inspection& inspection, std::optional<std::size_t> value) {
  const cases::Case& c = inspection.source;
  const InspectedSample* sample = records::inspected_sample(inspection);
  if (sample == nullptr || inspection.place.triangle >= c.triangles.size()) return "";
  std::string text = found_text(inspection, *sample);
  std::string stages;
  for (std::size_t i = 0; i < sample->values.size(); ++i) {
    if (value && *value != i) continue;
    text += "\n" + value_text(inspection, sample->values[i]);
    const std::string of_value = stages_of_error(inspection, sample->values[i]);
    if (!of_value.empty()) stages += "\n" + of_value;
  }
  const std::string map = map_of_pixels(inspection);
  if (!map.empty()) text += "\n" + map;
  text += stages + "\n";
  text += fmt::format("triangle {} of {}\n", inspection.place.triangle, c.triangles.size());
  if (!c.name.empty()) text += wrapped("", 2, "of “" + cases::printable(c.name) + "”");
  return text + triangle_text(inspection) + "\n" + map_text(inspection, *sample);
}

std::string inspection_legend() { return wrapped("", 0, kLegend); }

}  // namespace rastercheck::reports
