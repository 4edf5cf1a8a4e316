#include "reports/counterexample_text.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "cases/float_text.h"
#include "cases/json.h"
#include "cases/names.h"
#include "records/enclosure.h"
#include "reports/finding_text.h"
#include "reports/internal/exact_text.h"
#include "reports/internal/wording.h"
#include "reports/text_table.h"

namespace rastercheck::reports {
namespace {

using records::Counterexample;
using records::Violation;

/// Maximum number of vertices, and of triangles, of a case that are shown; the case file has the
/// rest.
constexpr std::size_t kMostShown = 12;
constexpr int kMeasureDigits = 6;  ///< the most digits of errors and distances

/// Formats a number as "0x1.8p-2 (0.375)", or a small whole number in decimal.
std::string float_text(float value) {
  const bool is_minus_zero = value == 0 && std::signbit(value);
  const bool is_plain = value == std::trunc(value) && std::abs(value) < 1000;
  if (is_plain && !is_minus_zero) return fmt::format("{}", value);
  return fmt::format("{} ({:.6g})", cases::to_hex(value), value);
}

/// The fault in a sentence; for a value, both numbers in full as well.
std::string printed_violation(const Violation& v, const cases::Case& c) {
  std::string text = fmt::format("  {}\n", finding_text(v, c));
  if (v.has_place() && v.kind != records::AttributeKind::coverage) {
    text +=
        fmt::format("    exactly {}; drawn {}\n", exact_text(v.exact), cases::printable(v.actual));
  }
  return text;
}

/// Says where the case was found and how it was changed.
std::string history_text(const Counterexample& one) {
  const cases::Found found = one.source.found.value_or(cases::Found());
  std::string text;
  switch (one.origin) {
    case records::Origin::corpus:
      text = fmt::format("case {} of the corpus", found.index);
      break;
    case records::Origin::scene:
      text = fmt::format("triangle {} of a scene", found.index);
      break;
    case records::Origin::saved:
      text = "saved before: " + records::random_case_text(found);
      break;
    case records::Origin::random:
      text = records::random_case_text(found);
      break;
  }
  if (!one.source.name.empty()) text += fmt::format(", “{}”", cases::printable(one.source.name));
  if (!one.is_shrunk()) return text + "; as found";
  return text + fmt::format("; shrunk in {} tries{}", one.shrinking->tries,
                            one.shrinking->is_least ? "" : ", which might go on");
}

std::string attribute_header(const cases::Attribute& attribute, std::size_t index) {
  std::string text =
      attribute.name.empty() ? fmt::format("[{}]", index) : cases::printable(attribute.name);
  if (attribute.interpolation != cases::Interpolation::smooth) {
    text += fmt::format(" {}", cases::name_of(attribute.interpolation));
  }
  if (attribute.location != cases::Location::sample) {
    text += fmt::format(" at {}", cases::name_of(attribute.location));
  }
  return text;
}

std::string enclosure_text(const std::optional<records::Enclosure>& enclosure) {
  return enclosure ? records::to_decimal(*enclosure, kMeasureDigits) : "-";
}

}  // namespace

std::string state_text(const cases::Case& c) {
  const cases::Viewport& v = c.viewport;
  std::string text = fmt::format(
      "  {} × {} pixels{}, viewport {} {} {} {}, rules {}", c.framebuffer.width,
      c.framebuffer.height,
      c.framebuffer.samples > 1 ? fmt::format(" of {} samples", c.framebuffer.samples) : "", v.x,
      v.y, v.width, v.height, cases::name_of(c.rules));
  const auto add = [&text](const std::string& more) { text += ", " + more; };
  if (v.min_depth != 0 || v.max_depth != 1) {
    add(fmt::format("depth range {} {}", float_text(v.min_depth), float_text(v.max_depth)));
  }
  if (c.coverage) {
    add(fmt::format("snapped to {} subpixel bits ({}, position error {})",
                    c.coverage->subpixel_bits, cases::name_of(c.coverage->rounding),
                    c.coverage->position_error));
    add(fmt::format("basis {}", cases::name_of(c.basis)));
  }
  if (c.fill_rule != cases::default_fill_rule(c.rules)) {
    add(fmt::format("fill rule {}", cases::name_of(c.fill_rule)));
  }
  if (c.cull != cases::Cull::none) add(fmt::format("cull {}", cases::name_of(c.cull)));
  if (c.front_face != cases::FrontFace::ccw) {
    add(fmt::format("front face {}", cases::name_of(c.front_face)));
  }
  if (c.scissor) {
    const cases::Scissor& s = *c.scissor;
    add(fmt::format("scissor {} {} {} {}", s.x, s.y, s.width, s.height));
  }
  if (c.depth_test != cases::DepthTest::none) {
    add(fmt::format("depth test {}", cases::name_of(c.depth_test)));
  }
  if (c.depth_clamp) add("depth clamp");
  if (c.camera) add("a camera (see the file)");
  return text + "\n";
}

std::pair<std::string, std::string> window_text(const cases::Case& c, const cases::ClipVertex& p) {
  if (!(p.w > 0)) return {"-", "-"};
  const cases::Viewport& v = c.viewport;
  const double up = c.rules == cases::Rules::d3d ? -1 : 1;
  const double x = (p.x / static_cast<double>(p.w) + 1) / 2 * v.width + v.x;
  const double y = (up * p.y / static_cast<double>(p.w) + 1) / 2 * v.height + v.y;
  const double grid = c.coverage ? std::ldexp(1.0, c.coverage->subpixel_bits) : 1;
  return {fmt::format("{:.10g}", x * grid), fmt::format("{:.10g}", y * grid)};
}

std::string violations_text(std::span<const Violation> violations, std::uint64_t all,
                            std::optional<std::size_t> columns) {
  std::vector<std::vector<std::string>> rows{{"  class", "of", "triangle", "x", "y", "s", "exact",
                                              "actual", "error", "bound", "distance", "note"}};
  for (const Violation& v : violations) {
    if (!v.has_place()) {
      std::vector<std::string> row(rows[0].size(), "-");
      row.front() = fmt::format("  {}", to_string(v.fragment_class));
      row.back() = cases::printable(v.note);
      rows.push_back(std::move(row));
      continue;
    }
    const std::string of = v.attribute ? fmt::format("{} [{}]", to_string(v.kind), *v.attribute)
                                       : std::string(to_string(v.kind));
    rows.push_back({fmt::format("  {}", to_string(v.fragment_class)), of,
                    std::to_string(v.place.triangle), std::to_string(v.place.x),
                    std::to_string(v.place.y), std::to_string(v.place.sample), v.exact, v.actual,
                    enclosure_text(v.error), enclosure_text(v.bound), enclosure_text(v.distance),
                    cases::printable(v.note)});
  }
  std::string text = text_table(rows, columns);
  if (all > violations.size()) text += fmt::format("  … {} in all\n", all);
  return text;
}

std::string case_text(const cases::Case& c) {
  std::string text = state_text(c);
  if (c.positions.size() > kMostShown || c.triangles.size() > kMostShown) {
    return text + fmt::format("  {} and {}: see the file\n",
                              counted(c.positions.size(), "vertex", "vertices"),
                              counted(c.triangles.size(), "triangle", "triangles"));
  }
  std::vector<std::vector<std::string>> rows{{"  vertex", "x", "y", "z", "w"}};
  if (!c.camera) {
    const char* where = c.coverage ? "grid" : "window";
    for (const char* axis : {"x", "y"}) rows[0].push_back(fmt::format("{} {}", where, axis));
  }
  for (std::size_t i = 0; i < c.attributes.size(); ++i) {
    rows[0].push_back(attribute_header(c.attributes[i], i));
  }
  for (std::size_t i = 0; i < c.clip_distance_count; ++i) {
    rows[0].push_back(fmt::format("distance {}", i));
  }
  for (std::size_t vertex = 0; vertex < c.positions.size(); ++vertex) {
    const cases::ClipVertex& p = c.positions[vertex];
    std::vector<std::string> row{fmt::format("  {}", vertex)};
    for (const float number : {p.x, p.y, p.z, p.w}) row.push_back(float_text(number));
    if (!c.camera) {
      const auto [x, y] = window_text(c, p);
      row.insert(row.end(), {x, y});
    }
    for (const float value : c.attributes_of(vertex)) row.push_back(float_text(value));
    for (const float distance : c.clip_distances_of(vertex)) row.push_back(float_text(distance));
    rows.push_back(std::move(row));
  }
  text += text_table(rows);
  text += c.triangles.size() == 1 ? "  triangle" : "  triangles";
  for (std::size_t i = 0; i < c.triangles.size(); ++i) {
    const cases::Triangle& t = c.triangles[i];
    text += fmt::format("{} {} {} {}", i > 0 ? "," : "", t[0], t[1], t[2]);
  }
  return text + "\n";
}

std::string counterexample_text(const Counterexample& counterexample, const std::string& command) {
  const cases::Case& c = counterexample.source;
  const cases::Found found = c.found.value_or(cases::Found());
  std::string text = fmt::format("\n{}\n  on {}: {}. It is {}.\n", cases::printable(found.law),
                                 found.backend, found.verdict, history_text(counterexample));
  if (!counterexample.violations.empty())
    text += printed_violation(counterexample.violations[0], c);
  if (counterexample.violation_count > 1) {
    text += fmt::format("  … {} violations in all\n", counterexample.violation_count);
  }
  for (const std::string& line : counterexample.close_up) text += "    " + line + "\n";
  text += case_text(c);
  return text + fmt::format("  Again: {}\n", command);
}

}  // namespace rastercheck::reports
