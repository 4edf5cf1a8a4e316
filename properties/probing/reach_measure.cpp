// Measures how far out vertices may lie: the guard band, and the greatest window coordinate that
// draws correctly.
//
// Draws triangles with w = 1 whose vertices lie D pixels from the window's origin, two of them on
// opposite sides, so that long edges cross the window. With no clip tolerance the triangles obey
// the contract up to the guard band, beyond which a clipper makes new vertices. With the measured
// tolerance they obey the contract as far out as they are drawn correctly. D is doubled until the
// contract is violated, and the last step is then bisected.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

/// Exponents of D in pixels, both inclusive.
constexpr int kNearest = 7;
constexpr int kFarthest = 96;
/// Halvings of the last step.
constexpr int kHalvings = 3;

/// Returns the point on the ray from `from` whose greater coordinate is `distance` from the origin.
WindowPoint far_point(const WindowPoint& from, double along_u, double along_v, double distance) {
  const auto steps = [distance](double start, double along) {
    if (along == 0) return std::numeric_limits<double>::infinity();
    return ((along > 0 ? distance : -distance) - start) / along;
  };
  const double t = std::min(steps(from.u, along_u), steps(from.v, along_v));
  return {from.u + t * along_u, from.v + t * along_v};
}

/// Adds a triangle with a long edge anywhere across the window.
void add_random_far(Draw& draw, cases::Case& c, double distance) {
  const double x = draw.between(16, 47) + double{draw.unit()};
  const double y = draw.between(16, 47) + double{draw.unit()};
  const double along_u = double{draw.uniform(-1, 1)};
  const double along_v = double{draw.uniform(-1, 1)};
  const double side = draw.one_in(2) ? 1 : -1;
  const auto far = [&](double u, double v) {
    return at_window(c, far_point({x, y}, u, v, distance), 0.5F, 1);
  };
  const cases::ClipVertex first = far(along_u, along_v);
  const cases::ClipVertex second = far(-along_u, -along_v);
  add_triangle(c, first, second, far(-side * along_v, side * along_u));
}

/// Adds a triangle with a long edge exactly through samples. Along at least one axis, the edge's
/// slope, such as 1/3 or 4/5, is not a binary fraction. If the triangle is cut, the new corner
/// therefore usually has to be rounded, and then the samples are no longer on the edge. Exact in
/// float32 up to kMostExact pixels.
void add_far_through_samples(Draw& draw, cases::Case& c, double distance) {
  const double x = draw.between(16, 47) + 0.5;
  const double y = draw.between(16, 47) + 0.5;
  const double run = draw.pick(std::array{3, 5, 7}) * (draw.one_in(2) ? 1 : -1);
  const double rise = draw.pick(std::array{1, 2, 4}) * (draw.one_in(2) ? 1 : -1);
  const bool is_steep = draw.one_in(2);
  const double side = draw.one_in(2) ? 1 : -1;
  const double steps = std::floor((distance - 64) / std::max(std::abs(run), std::abs(rise)));
  const double u = steps * (is_steep ? rise : run);
  const double v = steps * (is_steep ? run : rise);
  add_triangle(c, at_window(c, {x + u, y + v}, 0.5F, 1), at_window(c, {x - u, y - v}, 0.5F, 1),
               at_window(c, {x - side * v, y + side * u}, 0.5F, 1));
}

std::optional<DrawnCase> draw_far(Subject& subject, double distance) {
  constexpr int kTriangles = 32;
  constexpr double kMostExact = 0x1p21;
  MeasureDraw draw(subject, "reach");
  cases::Case c = subject.base();
  for (int i = 0; i < kTriangles; ++i) {
    add_random_far(draw, c, distance);
    if (distance <= kMostExact) add_far_through_samples(draw, c, distance);
  }
  return subject.drawn(std::move(c));
}

class Reach {
 public:
  explicit Reach(Subject& subject) : subject_(&subject) {}

  /// Returns the greatest distance tried up to which all drawings hold; 0 if none does.
  double greatest(const cases::ContractTerms& terms) {
    is_refused_ = false;
    tried_ = 0;
    double good = 0;
    double bad = std::ldexp(1.0, kFarthest + 1);
    for (int e = kNearest; e <= kFarthest; ++e) {
      const double distance = std::ldexp(1.0, e);
      if (!holds(distance, terms)) {
        bad = distance;
        break;
      }
      good = distance;
    }
    if (good == 0 || bad > std::ldexp(1.0, kFarthest)) return good;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (good + bad) / 2;
      (holds(middle, terms) ? good : bad) = middle;
    }
    return good;
  }

  /// True if triangles with vertices that far out are drawn right.
  bool holds(double distance, const cases::ContractTerms& terms) {
    ++tried_;
    const auto [at, is_new] = drawn_.try_emplace(distance);
    if (is_new) at->second = draw_far(*subject_, distance);
    if (at->second && subject_->holds({*at->second}, terms)) return true;
    is_refused_ = !at->second;
    return false;
  }

  /// True if the backend refused to draw farther out, instead of drawing wrongly.
  bool is_refused() const { return is_refused_; }
  /// The number of distances that greatest() tried.
  int tried() const { return tried_; }

 private:
  Subject* subject_;
  bool is_refused_ = false;
  int tried_ = 0;
  std::map<double, std::optional<DrawnCase>> drawn_;
};

std::string reach_text(double pixels) {
  if (pixels == 0) return fmt::format("below {:g} pixels", std::ldexp(1.0, kNearest));
  if (pixels >= std::ldexp(1.0, kFarthest)) return fmt::format("2^{} pixels or more", kFarthest);
  return fmt::format("{:.10g} pixels", pixels);
}

}  // namespace

void measure_reach(Subject& subject) {
  constexpr float kEverything = std::numeric_limits<float>::max();
  const cases::Contract declared = subject.declared();
  Reach reach(subject);
  cases::ContractTerms& terms = subject.result.terms;
  // Positions far out often lie midway between grid points. How such positions are rounded is not
  // measured here, so a small position error is allowed.
  cases::ContractTerms placed = terms;
  const cases::Coverage known = subject.contract(subject.base()).coverage;
  if (known) {
    cases::Snapping lax = *known;
    lax.position_error = std::max(lax.position_error, 0x1p-14F);
    placed.coverage = cases::Coverage(lax);
  }
  const auto add = [&](const char* what, const std::string& says,
                       double pixels) -> records::Measured& {
    const bool is_last = pixels > 0 && pixels < std::ldexp(1.0, kFarthest);
    return subject.add(what, says, reach_text(pixels),
                       is_last && reach.is_refused() ? "nothing is drawn farther out" : "",
                       sure_of("distances", reach.tried()));
  };
  if (known) {
    cases::ContractTerms strict = placed;
    strict.guard_band = kEverything;
    strict.clip_tolerance = 0.0F;
    const double band = reach.greatest(strict);
    add("guard band",
        declared.coverage ? fmt::format("{:g} pixels", declared.guard_band) : kNotDeclared, band)
        .contradicts = declared.coverage && band < declared.guard_band &&
                       !reach.holds(declared.guard_band, strict);
    terms.guard_band = placed.guard_band = static_cast<float>(band);
  }
  add("greatest coordinate drawn right", kNotDeclared, reach.greatest(placed));
}

}  // namespace rastercheck::properties
