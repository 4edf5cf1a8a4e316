// Measures how far out vertices may lie: the guard band, and the greatest window coordinate that
// draws correctly.
//
// Draws triangles with w = 1 whose vertices lie D pixels from the window's origin, two of them on
// opposite sides, so that long edges cross the window. With no clip tolerance the triangles obey
// the contract up to the guard band, beyond which a clipper makes new vertices. With the measured
// tolerance they obey the contract as far out as they are drawn correctly. D is doubled until the
// contract is violated, and the last step is then bisected. If not even the least D is obeyed, or
// if that is declared, D is measured from the viewport's sides instead.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

/// Exponents of D in pixels, both inclusive. A vertex has to lie outside the window.
constexpr int kNearest = 7;
constexpr int kNearestBeyond = 0;
constexpr int kFarthest = 96;
/// Halvings of the last step.
constexpr int kHalvings = 3;

/// The square whose sides far vertices lie on, in window coordinates.
struct FarSquare {
  double least = 0;
  double greatest = 0;

  static FarSquare about_origin(double distance) { return {-distance, distance}; }
  static FarSquare beyond_viewport(double distance) { return {-distance, 64 + distance}; }
  /// How far vertices in the window's middle half may be moved along an axis.
  double reach() const { return std::min(greatest - 64, 16 - least); }
};

/// Returns the point on the ray from `from` that lies on the square.
WindowPoint far_point(const WindowPoint& from, double along_u, double along_v,
                      const FarSquare& square) {
  const auto steps = [&square](double start, double along) {
    if (along == 0) return std::numeric_limits<double>::infinity();
    return ((along > 0 ? square.greatest : square.least) - start) / along;
  };
  const double t = std::min(steps(from.u, along_u), steps(from.v, along_v));
  return {from.u + t * along_u, from.v + t * along_v};
}

/// Adds a triangle with a long edge anywhere across the window.
void add_random_far(Draw& draw, cases::Case& c, const FarSquare& square) {
  const double x = draw.between(16, 47) + double{draw.unit()};
  const double y = draw.between(16, 47) + double{draw.unit()};
  const double along_u = double{draw.uniform(-1, 1)};
  const double along_v = double{draw.uniform(-1, 1)};
  const double side = draw.one_in(2) ? 1 : -1;
  const auto far = [&](double u, double v) {
    return at_window(c, far_point({x, y}, u, v, square), 0.5F, 1);
  };
  const cases::ClipVertex first = far(along_u, along_v);
  const cases::ClipVertex second = far(-along_u, -along_v);
  add_triangle(c, first, second, far(-side * along_v, side * along_u));
}

/// Adds a triangle with a long edge exactly through samples. Along at least one axis, the edge's
/// slope, such as 1/3 or 4/5, is not a binary fraction. If the triangle is cut, the new corner
/// therefore usually has to be rounded, and then the samples are no longer on the edge. Exact in
/// float32 up to kMostExact pixels.
void add_far_through_samples(const Subject& subject, Draw& draw, cases::Case& c,
                             const FarSquare& square) {
  const cases::PixelFraction& sample = subject.sample();
  const double x = draw.between(16, 47) + static_cast<double>(sample.x) / sample.parts;
  const double y = draw.between(16, 47) + static_cast<double>(sample.y) / sample.parts;
  const double run = draw.pick(std::array{3, 5, 7}) * (draw.one_in(2) ? 1 : -1);
  const double rise = draw.pick(std::array{1, 2, 4}) * (draw.one_in(2) ? 1 : -1);
  const bool is_steep = draw.one_in(2);
  const double side = draw.one_in(2) ? 1 : -1;
  const double steps = std::floor(square.reach() / std::max(std::abs(run), std::abs(rise)));
  if (steps == 0) return;  // too near for a long edge
  const double u = steps * (is_steep ? rise : run);
  const double v = steps * (is_steep ? run : rise);
  add_triangle(c, at_window(c, {x + u, y + v}, 0.5F, 1), at_window(c, {x - u, y - v}, 0.5F, 1),
               at_window(c, {x - side * v, y + side * u}, 0.5F, 1));
}

std::optional<DrawnCase> draw_far(Subject& subject, const FarSquare& square) {
  constexpr int kTriangles = 32;
  constexpr double kMostExact = 0x1p21;
  MeasureDraw draw(subject, "reach");
  cases::Case c = subject.base();
  for (int i = 0; i < kTriangles; ++i) {
    add_random_far(draw, c, square);
    if (square.greatest <= kMostExact) add_far_through_samples(subject, draw, c, square);
  }
  return subject.drawn(std::move(c));
}

class Reach {
 public:
  /// `square` makes the square of a distance, which is 2^nearest pixels at least.
  Reach(Subject& subject, FarSquare (*square)(double distance), int nearest)
      : subject_(&subject), square_(square), nearest_(nearest) {}

  /// Returns the greatest distance tried up to which all drawings hold; 0 if none does.
  double greatest(const cases::ContractTerms& terms) {
    is_refused_ = false;
    tried_ = 0;
    double good = 0;
    double bad = std::ldexp(1.0, kFarthest + 1);
    for (int e = nearest_; e <= kFarthest; ++e) {
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
    if (is_new) at->second = draw_far(*subject_, square_(distance));
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
  FarSquare (*square_)(double distance);
  int nearest_;
  bool is_refused_ = false;
  int tried_ = 0;
  std::map<double, std::optional<DrawnCase>> drawn_;
};

std::string reach_text(double pixels, int nearest = kNearest) {
  if (pixels == 0) return fmt::format("below {:g} pixels", std::ldexp(1.0, nearest));
  if (pixels >= std::ldexp(1.0, kFarthest)) return fmt::format("2^{} pixels or more", kFarthest);
  return fmt::format("{:.10g} pixels", pixels);
}

/// The terms without the guard band: nothing is clipped at the viewport's sides.
cases::ContractTerms unguarded(const Subject& subject, cases::ContractTerms terms) {
  constexpr float kEverything = std::numeric_limits<float>::max();
  terms.guard_band = kEverything;
  if (subject.contract(subject.base()).guard_beyond_viewport) {
    terms.guard_beyond_viewport = kEverything;
  }
  return terms;
}

std::string declared_reach(const cases::Contract& declared) {
  if (!declared.coverage) return kNotDeclared;
  if (declared.guard_beyond_viewport) {
    return fmt::format("{:g} pixels beyond the viewport", *declared.guard_beyond_viewport);
  }
  return fmt::format("{:g} pixels", declared.guard_band);
}

/// Measures a guard band about the viewport; 0 if all is clipped at the viewport's sides.
/// `breaks_other`: a declared guard band about the window's origin was found broken.
void measure_reach_beyond_viewport(Subject& subject, const cases::ContractTerms& strict,
                                   bool breaks_other) {
  Reach reach(subject, &FarSquare::beyond_viewport, kNearestBeyond);
  const cases::Contract declared = subject.declared();
  const double band = reach.greatest(strict);
  const std::string text = reach_text(band, kNearestBeyond);
  records::Measured& row =
      subject.add("guard band", declared_reach(declared), text + " beyond the viewport", "",
                  sure_of("distances", reach.tried()));
  if (declared.guard_beyond_viewport) {
    const double said = *declared.guard_beyond_viewport;
    row.contradicts = band < said && !reach.holds(said, strict);
  } else {
    row.contradicts = breaks_other;
  }
  subject.result.terms.guard_beyond_viewport = static_cast<float>(band);
}

}  // namespace

void measure_reach(Subject& subject) {
  const cases::Contract declared = subject.declared();
  Reach reach(subject, &FarSquare::about_origin, kNearest);
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
    cases::ContractTerms strict = unguarded(subject, placed);
    strict.clip_tolerance = 0.0F;
    const double band = declared.guard_beyond_viewport ? 0 : reach.greatest(strict);
    if (band == 0) {
      const bool is_about_origin = declared.coverage && !declared.guard_beyond_viewport;
      const bool is_broken =
          is_about_origin && declared.guard_band > 0 && !reach.holds(declared.guard_band, strict);
      measure_reach_beyond_viewport(subject, strict, is_broken);
    } else {
      add("guard band", declared_reach(declared), band).contradicts =
          declared.coverage && band < declared.guard_band &&
          !reach.holds(declared.guard_band, strict);
      terms.guard_band = static_cast<float>(band);
    }
    placed.guard_band = terms.guard_band;
    placed.guard_beyond_viewport = terms.guard_beyond_viewport;
  }
  add("greatest coordinate drawn right", kNotDeclared, reach.greatest(placed));
}

}  // namespace rastercheck::properties
