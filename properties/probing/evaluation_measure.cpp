// Measures the arithmetic of values: the reference point of planes, and how r/w is divided by 1/w.
// Drivers that draw in float32 are judged by bounds for these forms (docs/judge-a-driver.md), so it
// matters whether they use one of them.
//
// Planes: draws small right triangles with vertices at whole pixels, w = 1, far from the window's
// origin. At a sample p, a float32 plane about P is off by about |p − P| / leg ulp: it adds numbers
// that are larger by this factor and cancel. The worst error is compared with the worst errors of
// float32 planes about a vertex, about points 16 and 64 pixels away, and about the window's origin.
// The result is the form for which the ratio of the two errors is nearest to 1.
//
// Division: draws triangles with constant w and constant value, which show only the arithmetic of
// (r/w) / (1/w): each form gives different bits.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

constexpr int kLeg = 8;         ///< pixels
constexpr int kWidth = 1024;    ///< pixels
constexpr int kHeight = 64;     ///< pixels
constexpr int kEvaluated = 64;  ///< triangles

// --- Planes --------------------------------------------------------------------------------------

/// A right triangle with its right angle at (x, y) and legs along the axes.
struct RightTriangle {
  int x = 0;  ///< pixels
  int y = 0;  ///< pixels
  std::array<float, 3> values{};

  /// Returns the exact value, in double, this many pixels from the right angle along each axis.
  double exact(double along_x, double along_y) const {
    return double{values[0]} + along_x / kLeg * (double{values[1]} - double{values[0]}) +
           along_y / kLeg * (double{values[2]} - double{values[0]});
  }

  /// Evaluates a float32 plane about the point this far from the right angle along each axis.
  float by_plane(float along_x, float along_y, float away_x, float away_y) const {
    const float slope_x = (values[1] - values[0]) / float{kLeg};
    const float slope_y = (values[2] - values[0]) / float{kLeg};
    const float at_point = values[0] - slope_x * away_x - slope_y * away_y;
    return at_point + slope_x * (along_x + away_x) + slope_y * (along_y + away_y);
  }
};

/// Worst errors in scale ULP, of values from 1/2 to 1.
struct PlaneErrors {
  double drawn = 0;
  std::array<double, 4> of_forms{};
  int samples = 0;
};

constexpr std::array<std::string_view, 4> kPlaneForms{
    "a vertex", "a point 16 pixels away", "a point 64 pixels away", "the window's origin"};

void see(const RightTriangle& t, int x, int y, float drawn, PlaneErrors& errors) {
  constexpr double kUlp = 0x1p-24;
  const double along_x = x + 0.5 - t.x;
  const double along_y = y + 0.5 - t.y;
  const double exact = t.exact(along_x, along_y);
  const auto keep = [exact](double& worst, float value) {
    worst = std::max(worst, std::abs(double{value} - exact) / kUlp);
  };
  ++errors.samples;
  keep(errors.drawn, drawn);
  const std::array<std::array<int, 2>, 4> away{{{0, 0}, {16, 16}, {64, 64}, {t.x, t.y}}};
  for (std::size_t i = 0; i < away.size(); ++i) {
    keep(errors.of_forms[i],
         t.by_plane(static_cast<float>(along_x), static_cast<float>(along_y),
                    static_cast<float>(away[i][0]), static_cast<float>(away[i][1])));
  }
}

std::optional<PlaneErrors> plane_errors(Subject& subject, cases::Interpolation interpolation) {
  MeasureDraw draw(subject, "planes");
  cases::Case c = subject.base();
  c.framebuffer = {kWidth, kHeight, 1};
  c.viewport.width = kWidth;
  c.viewport.height = kHeight;
  c.attributes = {{"r", interpolation}};
  std::vector<RightTriangle> triangles;
  for (int i = 0; i < kEvaluated; ++i) {
    RightTriangle t{draw.between(kWidth / 2, kWidth - kLeg), draw.between(0, kHeight - kLeg), {}};
    for (float& value : t.values) value = 0.5F + draw.unit() / 2;
    const auto corner = [&](int along_x, int along_y) {
      const WindowPoint at{static_cast<double>(t.x + along_x), static_cast<double>(t.y + along_y)};
      return at_window(c, at, 0.5F, 1);
    };
    add_triangle(c, corner(0, 0), corner(kLeg, 0), corner(0, kLeg));
    c.attribute_values.insert(c.attribute_values.end(), t.values.begin(), t.values.end());
    triangles.push_back(t);
  }
  const std::optional<cases::Fragments> drawn = subject.draw(c);
  if (!drawn || drawn->size() == 0) return std::nullopt;
  PlaneErrors errors;
  for (std::size_t f = 0; f < drawn->size(); ++f) {
    if (drawn->triangle[f] >= triangles.size()) continue;
    see(triangles[drawn->triangle[f]], drawn->x[f], drawn->y[f], drawn->attributes_of(f)[0],
        errors);
  }
  return errors;
}

/// Returns the form whose worst error is nearest to that of the drawn values, compared as a ratio.
std::size_t nearest_form(const PlaneErrors& errors) {
  const auto ratio = [&errors](double of_form) {
    return std::max(errors.drawn, of_form) / std::min(errors.drawn, of_form);
  };
  const auto& forms = errors.of_forms;
  const auto nearest = std::min_element(
      forms.begin(), forms.end(), [&ratio](double a, double b) { return ratio(a) < ratio(b); });
  return static_cast<std::size_t>(nearest - forms.begin());
}

void add_planes(Subject& subject, cases::Interpolation interpolation, const char* of) {
  const std::string what = fmt::format("planes of {}", of);
  const std::optional<PlaneErrors> errors = plane_errors(subject, interpolation);
  if (!errors) {
    subject.add(what, kNotDeclared, "not drawn");
    return;
  }
  const auto& forms = errors->of_forms;
  if (errors->drawn <= forms[0]) {
    subject.add(what, kNotDeclared, "about a point of the triangle, or better",
                fmt::format("{:.3g} ULP at most; {:.3g} about a vertex", errors->drawn, forms[0]),
                sure_of("samples", errors->samples));
    return;
  }
  const std::size_t form = nearest_form(*errors);
  subject.add(what, kNotDeclared, fmt::format("as about {}", kPlaneForms[form]),
              fmt::format("{:.3g} ULP at most; {:.3g} so, {:.3g} about a vertex", errors->drawn,
                          forms[form], forms[0]),
              sure_of("samples", errors->samples));
}

// --- Division ------------------------------------------------------------------------------------

/// A way to compute a value r at a w in float32.
struct DivisionForm {
  std::string_view name;
  float (*value)(float r, float w);
};

constexpr std::array<DivisionForm, 6> kDivisions{{
    {"the value itself", [](float r, float /*w*/) { return r; }},
    {"r/w divided by 1/w", [](float r, float w) { return r / w / (1 / w); }},
    {"r (1/w) divided by 1/w", [](float r, float w) { return r * (1 / w) / (1 / w); }},
    {"r/w times a reciprocal of 1/w", [](float r, float w) { return r / w * (1 / (1 / w)); }},
    {"r (1/w) times a reciprocal of 1/w",
     [](float r, float w) { return r * (1 / w) * (1 / (1 / w)); }},
    {"r (1/w) times w", [](float r, float w) { return r * (1 / w) * w; }},
}};

void measure_division(Subject& subject) {
  constexpr const char* kWhat = "division by 1/w";
  MeasureDraw draw(subject, "division");
  cases::Case c = subject.base();
  c.attributes = {{"r"}};
  std::vector<std::array<float, 2>> given;  // r and w
  for (int i = 0; i < kEvaluated; ++i) {
    const float r = 0.5F + draw.unit() / 2;
    const float w = 0.5F + 7 * draw.unit();
    const double left = 4 + i % 14 * 4;
    const auto corner = [&](double x, double y) { return at_window(c, {left + x, 8 + y}, 0, w); };
    add_triangle(c, corner(0, 0), corner(kLeg, 0), corner(0, kLeg));
    c.attribute_values.insert(c.attribute_values.end(), 3, r);
    given.push_back({r, w});
  }
  const std::optional<cases::Fragments> drawn = subject.draw(c);
  int samples = 0;
  std::array<int, kDivisions.size()> alike{};
  for (std::size_t f = 0; drawn && f < drawn->size(); ++f) {
    if (drawn->triangle[f] >= given.size()) continue;
    const auto [r, w] = given[drawn->triangle[f]];
    ++samples;
    for (std::size_t i = 0; i < kDivisions.size(); ++i) {
      alike[i] += kDivisions[i].value(r, w) == drawn->attributes_of(f)[0] ? 1 : 0;
    }
  }
  if (samples == 0) {
    subject.add(kWhat, kNotDeclared, "not drawn");
    return;
  }
  const auto best = std::max_element(alike.begin(), alike.end());
  const std::string name(kDivisions[static_cast<std::size_t>(best - alike.begin())].name);
  subject.add(kWhat, kNotDeclared, *best == samples ? name : "none of the forms tried",
              *best == samples ? "" : fmt::format("best: {}", name),
              sure_of("samples", *best, samples - *best));
}

}  // namespace

void measure_evaluation(Subject& subject) {
  add_planes(subject, cases::Interpolation::smooth, "smooth attributes");
  add_planes(subject, cases::Interpolation::noperspective, "noperspective attributes");
  measure_division(subject);
}

}  // namespace rastercheck::properties
