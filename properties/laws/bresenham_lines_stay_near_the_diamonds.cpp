// Bresenham's lines stay near the diamonds: whatever algorithm a driver uses, its pixels are like
// those of the diamond-exit rule as a whole.
//
// Why. OpenGL (4.6, section 14.5.1) and Vulkan (Bresenham Line Segment Rasterization) permit other
// algorithms than the rule, and so no single pixel is certain. But of the pixels of a line
//
//   near        each is at most one unit in x and in y from one that the rule produces, and each of
//               the rule's is that near to one of the line's, unless the other has none at all
//   count       there are as many as the rule produces, or one more or less
//   one         no two are in the same column, or in the same row if y is the major axis
//   joint       where one line's end is the next one's start, and both have the same major axis and
//               direction, no pixel is drawn by both
//
// Lines: of width 1, with both ends inside all planes and at least two pixels inside framebuffer
// and scissor, so that nothing is cut. The rule's pixels are those of the ends without rounding.
// Snapping may move the line's pixels by one more unit, and change the rule's pixel at each end,
// which is allowed for. It may also turn the major axis of a line that is nearly diagonal, whose
// columns are then not looked at. Contracts that may move an end by more than half a pixel are left
// out. Samples: a pixel is drawn whole, so one is looked at.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "oracle/triangle_truth.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/primitive_cases.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/primitive_state.h"
#include "properties/random_state.h"

namespace rastercheck::properties::bresenham_lines_stay_near_the_diamonds_law {
namespace {

using Pixel = std::array<int, 2>;

/// The way that a line goes: its major axis and its direction along it.
struct Way {
  std::size_t axis = 0;
  bool is_up = true;
  bool is_certain = true;  ///< no rounding of the ends changes either
};

Way way_of(const cases::Case& c, const cases::Triangle& line) {
  const WindowPoint a = window_point(c, c.positions[line[0]]);
  const WindowPoint b = window_point(c, c.positions[line[1]]);
  const double du = b.u - a.u;
  const double dv = b.v - a.v;
  Way way;
  way.axis = std::abs(du) >= std::abs(dv) ? 0 : 1;
  way.is_up = (way.axis == 0 ? du : dv) > 0;
  way.is_certain =
      std::abs(std::abs(du) - std::abs(dv)) > 1 && std::max(std::abs(du), std::abs(dv)) > 1;
  return way;
}

/// True if a line's ends are so far inside framebuffer and scissor that all its pixels are drawn.
bool is_in_the_middle(const cases::Case& c, const cases::Triangle& line) {
  constexpr double kMargin = 2;
  const cases::Scissor all{0, 0, c.framebuffer.width, c.framebuffer.height};
  const cases::Scissor scissor = c.scissor.value_or(all);
  const auto is_between = [](double at, double begin, double size, double most) {
    return at >= std::max(begin, 0.0) + kMargin && at <= std::min(begin + size, most) - kMargin;
  };
  return std::all_of(line.begin(), line.begin() + 2, [&](std::uint32_t vertex) {
    const WindowPoint p = window_point(c, c.positions[vertex]);
    return is_between(p.u, scissor.x, scissor.width, all.width) &&
           is_between(p.v, scissor.y, scissor.height, all.height);
  });
}

std::string text(const Pixel& pixel) {
  return "(" + std::to_string(pixel[0]) + ", " + std::to_string(pixel[1]) + ")";
}

class LineCheck {
 public:
  LineCheck(const cases::Case& c, const cases::Contract& contract, const cases::Fragments& drawn)
      : case_(&c),
        scene_(c, {}),
        contract_(&contract),
        is_snapped_(contract.coverage.has_value()),
        tally_(c) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const cases::SamplePlace place = drawn.place_of(i);
      if (!is_of_case(c, place)) continue;
      pixels_[place.triangle].insert({static_cast<int>(place.x), static_cast<int>(place.y)});
    }
  }

  Check run() {
    for (std::uint32_t line = 0; line < case_->triangles.size(); ++line) {
      if (!is_looked_at(line)) continue;
      is_any_ = true;
      check_line(line);
      if (line > 0) check_joint(line - 1, line);
    }
    tally_.label_drawn();
    return is_any_ ? tally_.finish()
                   : not_applicable("no line is inside all planes and away from all sides");
  }

 private:
  void report(std::uint32_t line, const Pixel& pixel, records::FragmentClass of,
              const std::string& rule, const std::string& note = "") {
    tally_.report(violation_at(
        {line, static_cast<std::uint32_t>(pixel[1]), static_cast<std::uint32_t>(pixel[0]), 0}, of,
        rule, note));
  }

  bool is_looked_at(std::uint32_t line) const {
    const cases::Triangle& ends = case_->triangles[line];
    return is_inside(*case_, ends) && is_in_the_middle(*case_, ends) &&
           cases::promise_of(*contract_, *case_, line).is_made;
  }

  /// True if one of the pixels is within a unit of this one or, if snapping may have moved the
  /// line's pixels, two.
  bool is_near(const Pixel& pixel, const std::set<Pixel>& others) const {
    const int most = is_snapped_ ? 2 : 1;
    return std::any_of(others.begin(), others.end(), [&pixel, most](const Pixel& other) {
      return std::abs(other[0] - pixel[0]) <= most && std::abs(other[1] - pixel[1]) <= most;
    });
  }

  /// A pixel that the rule selects has its middle within a pixel of the line along the minor axis.
  std::set<Pixel> pixels_of_rule(std::uint32_t line) const {
    const oracle::TriangleTruth truth(scene_, line);
    const oracle::PixelBox box = truth.pixels();
    const cases::Triangle& ends = case_->triangles[line];
    const WindowPoint from = window_point(*case_, case_->positions[ends[0]]);
    const WindowPoint to = window_point(*case_, case_->positions[ends[1]]);
    const bool is_x_major = way_of(*case_, ends).axis == 0;
    const double along = is_x_major ? to.u - from.u : to.v - from.v;
    const double across = is_x_major ? to.v - from.v : to.u - from.u;
    std::set<Pixel> all;
    if (along == 0) return all;
    const int first = is_x_major ? box.x0 : box.y0;
    const int last = is_x_major ? box.x1 : box.y1;
    for (int major = first; major < last; ++major) {
      const double share = (major + 0.5 - (is_x_major ? from.u : from.v)) / along;
      const int near =
          static_cast<int>(std::floor((is_x_major ? from.v : from.u) + share * across));
      for (int minor = near - 2; minor <= near + 2; ++minor) {
        const Pixel pixel = is_x_major ? Pixel{major, minor} : Pixel{minor, major};
        if (truth.judge(pixel[0], pixel[1], 0).verdict == records::Verdict::required) {
          all.insert(pixel);
        }
      }
    }
    return all;
  }

  void check_line(std::uint32_t line) {
    const std::set<Pixel>& drawn = pixels_[line];
    const std::set<Pixel> rule = pixels_of_rule(line);
    tally_.counts().required += rule.size();
    if (!drawn.empty()) tally_.see(line);
    for (const Pixel& pixel : drawn) {
      if (rule.empty() || is_near(pixel, rule)) {
        tally_.pass(records::AttributeKind::coverage);
      } else {
        report(line, pixel, records::FragmentClass::extra,
               "forbidden: farther than one unit from every pixel of the diamond-exit rule");
      }
    }
    for (const Pixel& pixel : rule) {
      if (drawn.empty() || is_near(pixel, drawn)) continue;
      report(line, pixel, records::FragmentClass::missing,
             "required: a pixel within one unit of it");
    }
    check_count(line, drawn, rule);
    check_columns(line, drawn);
  }

  void check_count(std::uint32_t line, const std::set<Pixel>& drawn, const std::set<Pixel>& rule) {
    // One that APIs permit and, if the ends may have been moved, one at each.
    const std::size_t off = is_snapped_ ? 3 : 1;
    const std::size_t most = rule.size() + off;
    const bool is_more = drawn.size() > most;
    const bool is_less = drawn.size() + off < rule.size();
    if (!is_more && !is_less) return;
    const std::string counts = std::to_string(drawn.size()) +
                               " pixels drawn, the diamond-exit rule has " +
                               std::to_string(rule.size());
    if (is_more) return report(line, *drawn.rbegin(), records::FragmentClass::extra, counts);
    report(line, *rule.rbegin(), records::FragmentClass::missing, counts);
  }

  void check_columns(std::uint32_t line, const std::set<Pixel>& drawn) {
    const Way way = way_of(*case_, case_->triangles[line]);
    if (!way.is_certain) return;
    tally_.label("columns");
    std::map<int, Pixel> columns;
    for (const Pixel& pixel : drawn) {
      const auto [first, is_first] = columns.emplace(pixel[way.axis], pixel);
      if (is_first) continue;
      report(line, pixel, records::FragmentClass::extra,
             std::string("forbidden: pixel ") + text(first->second) + " is in the same " +
                 (way.axis == 0 ? "column" : "row"));
    }
  }

  /// Lines that are not side by side have nothing to say.
  void check_joint(std::uint32_t first, std::uint32_t second) {
    const cases::Triangle& a = case_->triangles[first];
    const cases::Triangle& b = case_->triangles[second];
    const Way way = way_of(*case_, a);
    const Way next = way_of(*case_, b);
    if (a[1] != b[0] || !is_looked_at(first)) return;
    if (!way.is_certain || !next.is_certain || way.axis != next.axis || way.is_up != next.is_up) {
      return;
    }
    tally_.label("joint");
    for (const Pixel& pixel : pixels_[second]) {
      if (!pixels_[first].contains(pixel)) continue;
      report(second, pixel, records::FragmentClass::extra,
             "forbidden: line " + std::to_string(first) + ", which it goes on, has it as well",
             "at the joint of two lines");
    }
  }

  const cases::Case* case_;
  oracle::SceneTruth scene_;  ///< of the ends as given
  const cases::Contract* contract_;
  bool is_snapped_;
  std::map<std::uint32_t, std::set<Pixel>> pixels_;
  bool is_any_ = false;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  if (clip.primitive != cases::Primitive::lines) return not_applicable(kNotLines);
  if (clip.line_mode != cases::LineMode::bresenham || clip.line_width != 1) {
    return not_applicable("the property is about Bresenham's lines of width 1");
  }
  cases::ClipCase c = clip;
  c.depth_test = cases::DepthTest::none;
  const Result<backends::Drawn> drawn = draw(c, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  const auto& grid = drawn->contract.coverage;
  if (grid && placement_reach(*grid) > 0.5) {
    return not_applicable("the contract may move ends by more than half a pixel");
  }
  return LineCheck(c, drawn->contract, drawn->fragments).run();
}

/// A strip of lines, mostly going on in one direction.
Generated generate(Draw& draw) {
  cases::Case c = random_primitive_state(draw, cases::Primitive::lines, false);
  c.line_mode = cases::LineMode::bresenham;
  c.framebuffer.samples = 1;
  c.line_width = 1;
  c.scissor.reset();
  const double width = c.framebuffer.width;
  const double height = c.framebuffer.height;
  c.viewport.x = 0;
  c.viewport.y = 0;
  c.viewport.width = static_cast<float>(width);
  c.viewport.height = static_cast<float>(height);
  const int strips = draw.between(1, 2 + draw.size() / 25);
  for (int strip = 0; strip < strips; ++strip) {
    const int count = draw.between(2, 5);
    const bool is_along_x = draw.one_in(2);
    const bool is_back = draw.one_in(2);
    const bool is_exact = draw.one_in(2);
    std::uint32_t last = 0;
    for (int i = 0; i < count; ++i) {
      const double along = (i + 0.5 + double{draw.uniform(-0.2F, 0.2F)}) / count;
      const double across = 0.5 + double{draw.uniform(-0.3F, 0.3F)} / count;
      const double forward = is_back ? 1 - along : along;
      WindowPoint p = is_along_x ? WindowPoint{forward * width, across * height}
                                 : WindowPoint{across * width, forward * height};
      if (is_exact) p = {floor_to_eighths(p.u), floor_to_eighths(p.v)};
      const float depth = random_depth(draw, c);
      const float w = draw.one_in(2) ? 1.0F : draw.uniform(0.5F, 2);
      const std::uint32_t vertex = add_vertex(c, at_window(c, p, depth, w));
      if (i > 0) c.triangles.push_back({last, vertex, vertex});
      last = vertex;
    }
  }
  add_attribute_values(draw, c);
  c.clip_distance_count = 0;
  return {c, "strips of lines"};
}

const LawRegistration kRegistration(
    {.id = "bresenham-lines-stay-near-the-diamonds",
     .sentence = "Bresenham's lines stay near the diamonds, one pixel to a column",
     .reason = "APIs permit other algorithms than the diamond-exit rule, but each line as a whole "
               "must be like the rule's.",
     .exceptions = "lines that are wider or clipped",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_lines,
     .unpromised = kDrawsNoLines,
     .takes_lines_and_points = true,
     .covers = {cover(40, "drawn"), cover(40, "columns"), cover(40, "joint")}});

}  // namespace
}  // namespace rastercheck::properties::bresenham_lines_stay_near_the_diamonds_law
