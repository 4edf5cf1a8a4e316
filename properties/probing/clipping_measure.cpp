// Measures how triangles are cut by the near plane, the far plane and w = 0.
//
// A clipper makes new vertices, which are rounded to the grid, so cut edges move. The clip
// tolerance says how far, in grid units. The measured tolerance is the least under which the judge
// finds nothing wrong. Triangles with w <= 0 at a vertex are counted separately: drawn correctly,
// not at all, or wrongly.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "properties/probing/measures.h"
#include "properties/random_state.h"

namespace rastercheck::properties {
namespace {

/// Returns a vertex that appears in or near the window, in front of the eye and between the depth
/// planes.
cases::ClipVertex visible_vertex(Draw& draw, const cases::Case& c) {
  const float w = draw.uniform(0.5F, 2);
  const WindowPoint p = point_about(draw, c);
  return at_window(c, p, random_depth(draw, c), w);
}

using MakeVertex = cases::ClipVertex (*)(Draw& draw, const cases::Case& c);

cases::ClipVertex before_near(Draw& draw, const cases::Case& c) {
  cases::ClipVertex vertex = visible_vertex(draw, c);
  vertex.z = (near_depth(c) - draw.uniform(0.125F, 2)) * vertex.w;
  return vertex;
}
cases::ClipVertex beyond_far(Draw& draw, const cases::Case& c) {
  cases::ClipVertex vertex = visible_vertex(draw, c);
  vertex.z = draw.uniform(1.125F, 3) * vertex.w;
  return vertex;
}
/// Keeps z between -1 and 1, so that the triangle is cut because of w.
cases::ClipVertex behind_eye(Draw& draw, const cases::Case& /*c*/) {
  const float x = draw.uniform(-2, 2);
  const float y = draw.uniform(-2, 2);
  const float z = draw.uniform(-1, 1);
  return {x, y, z, -draw.uniform(0.125F, 2)};
}
cases::ClipVertex at_eye(Draw& draw, const cases::Case& /*c*/) {
  const float x = draw.uniform(-2, 2);
  const float y = draw.uniform(-2, 2);
  return {x, y, 0, 0};
}

/// Draws triangles with `cut` vertices beyond the plane and the others visible; one case each, so
/// that each triangle is judged separately.
std::vector<DrawnCase> draw_cut(Subject& subject, const std::string& name, MakeVertex make,
                                int cut) {
  constexpr std::uint64_t kCases = 64;
  std::vector<DrawnCase> all;
  for (std::uint64_t i = 0; i < kCases; ++i) {
    MeasureDraw draw(subject, name, i);
    cases::Case c = subject.base();
    std::array<cases::ClipVertex, 3> corners;
    for (int k = 0; k < 3; ++k) {
      corners[static_cast<std::size_t>(k)] = k < cut ? make(draw, c) : visible_vertex(draw, c);
    }
    const int turns = draw.between(0, 2);
    std::rotate(corners.begin(), corners.begin() + turns, corners.end());
    add_triangle(c, corners[0], corners[1], corners[2]);
    if (auto drawn = subject.drawn(std::move(c))) all.push_back(*std::move(drawn));
  }
  return all;
}

/// Exponent of the greatest tolerance that is tried, in grid units.
constexpr int kGreatestExponent = 12;

/// Returns the least tolerance under which the drawings hold, in grid units; empty if none
/// suffices.
std::optional<float> tolerance_of(const Subject& subject, const std::vector<DrawnCase>& drawn) {
  cases::ContractTerms terms = subject.result.terms;
  terms.clip_tolerance = 0.0F;
  if (subject.holds(drawn, terms)) return 0.0F;
  for (int e = -4; e <= kGreatestExponent; ++e) {
    terms.clip_tolerance = std::ldexp(1.0F, e);
    if (subject.holds(drawn, terms)) return terms.clip_tolerance;
  }
  return std::nullopt;
}

/// Counts for and against: triangles that stay within a tolerance of one grid unit, as rounding of
/// new corners requires, and others.
records::Sureness within_a_unit(const Subject& subject, const std::vector<DrawnCase>& drawn) {
  cases::ContractTerms terms = subject.result.terms;
  terms.clip_tolerance = 1.0F;
  const auto kept = std::count_if(drawn.begin(), drawn.end(), [&](const DrawnCase& one) {
    return subject.holds({one}, terms);
  });
  return sure_of("triangles", kept, static_cast<std::ptrdiff_t>(drawn.size()) - kept);
}

/// Returns the size of a pixel in grid units. A larger tolerance would permit any triangle.
float pixel_of(const Subject& subject) {
  const cases::Coverage coverage = subject.contract(subject.base()).coverage;
  return coverage ? static_cast<float>(coverage->steps()) : 0.0F;
}

/// Counts triangles by outcome.
struct ClippingOutcomes {
  int right = 0;
  int left_out = 0;
  int wrong = 0;
  int empty = 0;  ///< nothing had to be drawn, and nothing was

  std::string text() const {
    if (right == 0 && left_out == 0 && wrong == 0) return "nothing to draw, nothing drawn";
    if (left_out == 0 && wrong == 0) return "drawn right";
    if (right == 0 && wrong == 0) return "left out";
    return fmt::format("right {}, left out {}, wrong {}", right, left_out, wrong);
  }

  /// Counts for the commonest outcome; triangles that show nothing either way are undecided.
  records::Sureness sureness() const {
    const int most = std::max({right, left_out, wrong});
    if (most == 0) return sure_of("triangles", empty);
    return sure_of("triangles", most, right + left_out + wrong - most, empty);
  }
};

ClippingOutcomes outcomes_of(const Subject& subject, const std::vector<DrawnCase>& drawn) {
  ClippingOutcomes outcomes;
  for (const DrawnCase& one : drawn) {
    const CoverageTally tally = subject.tally({one}, subject.result.terms);
    const bool is_left_out = one.fragments.size() == 0;
    if (tally.holds()) {
      ++(tally.required == 0 && is_left_out ? outcomes.empty : outcomes.right);
    } else {
      ++(is_left_out ? outcomes.left_out : outcomes.wrong);
    }
  }
  return outcomes;
}

/// Finds out whether triangles that a plane cuts are clipped or left out. They are left out if
/// nothing is drawn of any of them.
void measure_cut_triangles(Subject& subject, const std::vector<std::vector<DrawnCase>>& by_plane) {
  std::uint64_t drawn_in_part = 0;
  std::uint64_t left_out = 0;
  for (const std::vector<DrawnCase>& drawn : by_plane) {
    for (const DrawnCase& one : drawn) ++(one.fragments.size() == 0 ? left_out : drawn_in_part);
  }
  const bool culls = drawn_in_part == 0;
  const bool is_declared = subject.declared().culls_instead_of_clipping;
  const auto text_of = [](bool is_culled) { return is_culled ? "left out" : "clipped"; };
  const char* const what = "triangles that a plane cuts";
  if (left_out == 0 && culls) {
    subject.add(what, text_of(is_declared), "not drawn");
    return;
  }
  // A clipped triangle may lie outside the window.
  const records::Sureness sureness =
      culls ? sure_of("triangles", left_out) : sure_of("triangles", drawn_in_part, 0, left_out);
  subject.add(what, text_of(is_declared), text_of(culls), "", sureness).contradicts =
      culls != is_declared;
  if (culls != is_declared) subject.result.terms.culls_instead_of_clipping = culls;
}

}  // namespace

void measure_clipping(Subject& subject) {
  struct Cut {
    const char* name;
    MakeVertex make;
    int vertices;
  };
  constexpr std::array kPlanes{Cut{"near plane", &before_near, 1}, Cut{"far plane", &beyond_far, 1},
                               Cut{"w = 0", &behind_eye, 1}};
  const cases::Contract declared = subject.declared();
  const std::string units =
      declared.coverage ? fmt::format("{:g} grid units", declared.clip_tolerance) : kNotDeclared;
  std::vector<std::vector<DrawnCase>> by_plane;
  by_plane.reserve(kPlanes.size());
  for (const Cut& cut : kPlanes) {
    by_plane.push_back(draw_cut(subject, cut.name, cut.make, cut.vertices));
  }
  measure_cut_triangles(subject, by_plane);
  float greatest = 0;
  for (std::size_t i = 0; i < kPlanes.size(); ++i) {
    const Cut& cut = kPlanes[i];
    const std::vector<DrawnCase>& drawn = by_plane[i];
    if (drawn.empty()) {
      subject.add(fmt::format("clip tolerance, {}", cut.name), units, "not drawn");
      continue;
    }
    const auto tolerance = tolerance_of(subject, drawn);
    cases::ContractTerms promised = subject.result.terms;
    promised.clip_tolerance = declared.clip_tolerance;
    if (tolerance) greatest = std::max(greatest, *tolerance);
    subject
        .add(fmt::format("clip tolerance, {}", cut.name), units,
             tolerance ? fmt::format("{:g} grid units", *tolerance)
                       : fmt::format("more than {} grid units", 1 << kGreatestExponent),
             "within one grid unit", within_a_unit(subject, drawn))
        .contradicts = declared.coverage && !subject.holds(drawn, promised);
  }
  // The drawn triangles need not show the worst case, which for corners rounded to the grid is
  // about a unit. A tolerance beyond a pixel would permit any triangle; instead, a run shows such
  // triangles as violations.
  const float tolerance = greatest == 0 ? 0.0F : std::max(1.0F, 2 * greatest);
  subject.result.terms.clip_tolerance = std::min(tolerance, pixel_of(subject));

  constexpr std::array kBehind{
      Cut{"one vertex with w < 0", &behind_eye, 1}, Cut{"two vertices with w < 0", &behind_eye, 2},
      Cut{"three vertices with w < 0", &behind_eye, 3}, Cut{"one vertex with w = 0", &at_eye, 1},
      Cut{"all zero but x and y", &at_eye, 3}};
  for (const Cut& cut : kBehind) {
    const std::vector<DrawnCase> drawn = draw_cut(subject, cut.name, cut.make, cut.vertices);
    if (drawn.empty()) {
      subject.add(cut.name, kNotDeclared, "not drawn");
      continue;
    }
    const ClippingOutcomes outcomes = outcomes_of(subject, drawn);
    subject.add(cut.name, kNotDeclared, outcomes.text(), "", outcomes.sureness());
  }
}

}  // namespace rastercheck::properties
