// Measures how lines and points are drawn: which of the three sets of samples a line covers, how
// widths and sizes are rounded, and which pixel of a line is left out.
//
// Ends are on multiples of 1/16 pixel, where a grid of 2^-4 pixels or finer leaves them. A drawn
// line is compared with the exact sets of all three modes (RULES §10); samples on borders, which a
// fill rule decides, count for none of them. APIs permit that Bresenham's lines differ from the
// diamond-exit rule, so for these the pixels that differ are counted.
//
// Widths are measured by level lines at eight heights, a sixteenth off the eighths of a pixel: a
// line that is w pixels wide covers w rows on average. Sizes of points likewise.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cases/names.h"
#include "oracle/triangle_truth.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

using cases::LineMode;
using cases::Primitive;
using Pixels = std::set<std::array<std::uint32_t, 3>>;  // y, x, sample

constexpr std::array kModes{LineMode::rectangular, LineMode::parallelogram, LineMode::bresenham};

std::string words_for(LineMode mode) {
  switch (mode) {
    case LineMode::rectangular:
      return "rectangles";
    case LineMode::parallelogram:
      return "parallelograms";
    case LineMode::bresenham:
      break;
  }
  return "diamonds";
}

void add_line(cases::Case& c, const WindowPoint& a, const WindowPoint& b) {
  const float depth = c.rules == cases::Rules::opengl ? 0.0F : 0.5F;
  const std::uint32_t first = add_vertex(c, at_window(c, a, depth, 1));
  const std::uint32_t second = add_vertex(c, at_window(c, b, depth, 1));
  c.triangles.push_back({first, second, second});
}

void add_point(cases::Case& c, const WindowPoint& p) {
  const float depth = c.rules == cases::Rules::opengl ? 0.0F : 0.5F;
  const std::uint32_t vertex = add_vertex(c, at_window(c, p, depth, 1));
  c.triangles.push_back({vertex, vertex, vertex});
}

WindowPoint random_place(Draw& draw) {
  const int u = draw.between(80, 16 * 64 - 80);
  const int v = draw.between(80, 16 * 64 - 80);
  return {u / 16.0, v / 16.0};
}

/// Lines of one width in all directions.
cases::Case random_lines(const Subject& subject, LineMode mode) {
  constexpr int kLines = 60;
  MeasureDraw draw(subject, "lines");
  cases::Case c = subject.base();
  c.primitive = Primitive::lines;
  c.line_mode = mode;
  for (int i = 0; i < kLines; ++i) {
    const WindowPoint a = random_place(draw);
    const WindowPoint b = random_place(draw);
    add_line(c, a, b);
  }
  return c;
}

std::vector<Pixels> by_primitive(const DrawnCase& drawn) {
  std::vector<Pixels> all(drawn.source.triangles.size());
  for (std::size_t i = 0; i < drawn.fragments.size(); ++i) {
    const cases::SamplePlace place = drawn.fragments.place_of(i);
    if (place.triangle < all.size()) all[place.triangle].insert({place.y, place.x, place.sample});
  }
  return all;
}

/// How many lines or points are just like the exact ones, and how many samples are not.
struct Likeness {
  std::size_t same = 0;
  std::size_t others = 0;
};

Likeness likeness_to(const cases::Case& exact, const std::vector<Pixels>& drawn) {
  cases::Contract contract;
  contract.tie_rule = cases::TieRule::unspecified;
  const oracle::SceneTruth scene(exact, contract);
  Likeness likeness;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const oracle::TriangleTruth truth(scene, i);
    const oracle::PixelBox box = truth.pixels();
    std::size_t others = 0;
    std::size_t seen = 0;
    for (int y = box.y0; y < box.y1; ++y) {
      for (int x = box.x0; x < box.x1; ++x) {
        for (int s = 0; s < exact.framebuffer.samples; ++s) {
          const records::Verdict verdict = truth.judge(x, y, s).verdict;
          const bool is_drawn =
              drawn[i].contains({static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x),
                                 static_cast<std::uint32_t>(s)});
          seen += is_drawn ? 1 : 0;
          if (verdict == records::Verdict::permitted) continue;
          others += is_drawn == (verdict == records::Verdict::required) ? 0 : 1;
        }
      }
    }
    others += drawn[i].size() - seen;  // outside of the box
    likeness.same += others == 0 ? 1 : 0;
    likeness.others += others;
  }
  return likeness;
}

/// Measures which set of samples is drawn where a case asks for one of the modes.
void measure_mode(Subject& subject, LineMode asked) {
  const std::string what = "lines as " + words_for(asked);
  const std::optional<DrawnCase> drawn = subject.drawn(random_lines(subject, asked));
  if (!drawn) {
    subject.add(what, kNotDeclared, "not drawn");
    return;
  }
  const std::vector<Pixels> lines = by_primitive(*drawn);
  std::optional<LineMode> best;
  Likeness of_best;
  for (const LineMode mode : kModes) {
    cases::Case exact = drawn->source;
    exact.line_mode = mode;
    const Likeness likeness = likeness_to(exact, lines);
    const bool is_better = !best || likeness.others < of_best.others ||
                           (likeness.others == of_best.others && mode == asked);
    if (is_better) {
      best = mode;
      of_best = likeness;
    }
  }
  std::string detail = fmt::format("{} of {} lines to the pixel", of_best.same, lines.size());
  if (of_best.others > 0) detail += fmt::format(", {} samples differ", of_best.others);
  const bool is_like = of_best.same == lines.size();
  subject.add(what, words_for(asked), (is_like ? "" : "nearest to ") + words_for(*best), detail,
              sure_of("lines", of_best.same, lines.size() - of_best.same));
}

/// The mean number of rows that level lines of a width cover, or the root of the mean number of
/// pixels that points of a size do; empty if the backend does not draw it.
std::optional<double> measured_size(Subject& subject, Primitive primitive, float size,
                                    LineMode mode) {
  constexpr int kPlaces = 8;
  cases::Case c = subject.base();
  c.primitive = primitive;
  c.line_mode = mode;
  (primitive == Primitive::lines ? c.line_width : c.point_size) = size;
  for (int i = 0; i < kPlaces; ++i) {
    const double off = i / 8.0 + 1 / 16.0;
    if (primitive == Primitive::lines) {
      add_line(c, {8, 32 + off}, {40, 32 + off});
    } else {
      for (int k = 0; k < kPlaces; ++k) add_point(c, {32 + k / 8.0 + 1 / 16.0, 32 + off});
    }
  }
  const std::optional<cases::Fragments> drawn = subject.draw(c);
  if (!drawn) return std::nullopt;
  const double pixels = static_cast<double>(drawn->size()) / c.framebuffer.samples;
  return primitive == Primitive::lines ? pixels / kPlaces / 32
                                       : std::sqrt(pixels / (kPlaces * kPlaces));
}

/// Measures whether widths or sizes are rounded to whole pixels.
void measure_sizes(Subject& subject, Primitive primitive, LineMode mode, const std::string& what) {
  constexpr std::array kSizes{1.0F, 1.25F, 1.5F, 1.75F, 2.0F, 2.5F, 3.0F, 4.25F};
  int as_asked = 0;
  int rounded = 0;
  int seen = 0;
  std::string detail;
  for (const float size : kSizes) {
    const std::optional<double> measured = measured_size(subject, primitive, size, mode);
    if (!measured) continue;
    ++seen;
    // Eight places tell sizes apart that differ by an eighth.
    constexpr double kApart = 1.0 / 16;
    as_asked += std::abs(*measured - size) < kApart ? 1 : 0;
    rounded += std::abs(*measured - std::floor(size + 0.5F)) < kApart ? 1 : 0;
    detail += fmt::format("{}{} for {}", detail.empty() ? "" : ", ", *measured, size);
  }
  if (seen == 0) return;
  const char* measured = as_asked == seen  ? "as asked for"
                         : rounded == seen ? "rounded to whole pixels"
                                           : "of another kind";
  subject.add(what, kNotDeclared, measured, detail,
              sure_of("sizes", std::max(as_asked, rounded), seen - std::max(as_asked, rounded)));
}

/// Measures whether the pixel that holds a line's first end, or its second, is drawn.
void measure_ends(Subject& subject) {
  cases::Case c = subject.base();
  c.primitive = Primitive::lines;
  c.line_mode = LineMode::bresenham;
  constexpr std::array<WindowPoint, 4> kTo{{{40.5, 20.5}, {8.5, 20.5}, {24.5, 40.5}, {24.5, 4.5}}};
  for (const WindowPoint& to : kTo) add_line(c, {24.5, 20.5}, to);
  const std::optional<DrawnCase> drawn = subject.drawn(std::move(c));
  if (!drawn) return;
  const std::vector<Pixels> lines = by_primitive(*drawn);
  int firsts = 0;
  int seconds = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto x = static_cast<std::uint32_t>(kTo[i].u);
    const auto y = static_cast<std::uint32_t>(kTo[i].v);
    firsts += lines[i].contains({20, 24, 0}) ? 1 : 0;
    seconds += lines[i].contains({y, x, 0}) ? 1 : 0;
  }
  const auto text = [](int count) {
    return count == 0 ? "left out" : count == 4 ? "drawn" : "drawn in some directions";
  };
  subject.add("pixel of a line's first end", "drawn", text(firsts), "",
              sure_of("lines", firsts, 4 - firsts));
  subject.add("pixel of a line's second end", "left out", text(seconds), "",
              sure_of("lines", 4 - seconds, seconds));
}

void measure_points(Subject& subject) {
  constexpr int kPoints = 60;
  MeasureDraw draw(subject, "points");
  cases::Case c = subject.base();
  c.primitive = Primitive::points;
  c.point_size = 5;
  for (int i = 0; i < kPoints; ++i) add_point(c, random_place(draw));
  const std::optional<DrawnCase> drawn = subject.drawn(std::move(c));
  if (!drawn) {
    subject.add("points", kNotDeclared, "not drawn");
    return;
  }
  const Likeness likeness = likeness_to(drawn->source, by_primitive(*drawn));
  const bool are_squares = likeness.same == kPoints;
  subject.add("points", "squares", are_squares ? "squares" : "of another shape",
              fmt::format("{} of {} to the sample", likeness.same, kPoints),
              sure_of("points", likeness.same, kPoints - likeness.same));
  measure_sizes(subject, Primitive::points, LineMode::rectangular, "sizes of points");
}

}  // namespace

void measure_primitives(Subject& subject) {
  const cases::Capabilities has = subject.capabilities();
  if (has.draws(Primitive::lines)) {
    for (const LineMode mode : kModes) measure_mode(subject, mode);
    for (const LineMode mode : {LineMode::rectangular, LineMode::bresenham}) {
      measure_sizes(subject, Primitive::lines, mode, "widths of " + words_for(mode));
    }
    measure_ends(subject);
  }
  if (has.draws(Primitive::points)) measure_points(subject);
}

}  // namespace rastercheck::properties
