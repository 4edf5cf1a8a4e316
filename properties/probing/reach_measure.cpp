// How far out vertices may lie: the guard band, and the greatest window coordinate that draws
// right.
//
// Triangles with w = 1 and two vertices D pixels away, on opposite sides, so that long edges cross
// the window. With no clip tolerance at all they keep to the contract as far as the guard band
// goes: beyond it a clipper makes new vertices. With the tolerance that was measured they do as far
// as they are drawn right. D is doubled until it fails, and the last step then halved.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "properties/internal/float_numbers.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

/// Exponents of D in pixels, both inclusive.
constexpr int kNearest = 7;
constexpr int kFarthest = 96;
/// Halvings of the last step.
constexpr int kHalvings = 3;

std::optional<Drawn> draw_far(Subject& subject, double distance) {
  constexpr int kTriangles = 40;
  MeasureDraw draw(subject, "reach");
  cases::Case c = subject.base();
  for (int i = 0; i < kTriangles; ++i) {
    const double x = draw.between(16, 47) + double{draw.unit()};
    const double y = draw.between(16, 47) + double{draw.unit()};
    double along_x = double{draw.uniform(-1, 1)};
    double along_y = double{draw.uniform(-1, 1)};
    // The greater of the two is D.
    const double scale = distance / std::max(std::abs(along_x), std::abs(along_y));
    along_x *= scale;
    along_y *= scale;
    const double side = draw.one_in(2) ? 1 : -1;
    const WindowPoint third{x - side * along_y, y + side * along_x};
    const cases::ClipVertex first = at_window(c, {x + along_x, y + along_y}, 0.5F, 1);
    const cases::ClipVertex second = at_window(c, {x - along_x, y - along_y}, 0.5F, 1);
    add_triangle(c, first, second, at_window(c, third, 0.5F, 1));
  }
  return subject.drawn(std::move(c));
}

class Reach {
 public:
  explicit Reach(Subject& subject) : subject_(&subject) {}

  /// The greatest distance, of those tried, up to which all hold; 0 where none does.
  double greatest(const cases::ContractTerms& terms) {
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

 private:
  bool holds(double distance, const cases::ContractTerms& terms) {
    const auto [at, is_new] = drawn_.try_emplace(distance);
    if (is_new) at->second = draw_far(*subject_, distance);
    return at->second && subject_->tally({*at->second}, terms).holds();
  }

  Subject* subject_;
  std::map<double, std::optional<Drawn>> drawn_;
};

std::string text_of(double pixels) {
  if (pixels == 0) return fmt::format("below {:g} pixels", std::ldexp(1.0, kNearest));
  if (pixels >= std::ldexp(1.0, kFarthest)) return fmt::format("2^{} pixels or more", kFarthest);
  return fmt::format("{:.10g} pixels", pixels);
}

}  // namespace

void measure_reach(Subject& subject) {
  constexpr float kEverything = std::numeric_limits<float>::max();
  const cases::Contract declared = subject.backend().contract(subject.base());
  Reach reach(subject);
  cases::ContractTerms& terms = subject.result.terms;
  cases::ContractTerms strict = terms;
  strict.guard_band = kEverything;
  strict.clip_tolerance = 0.0F;
  const double band = reach.greatest(strict);
  const bool is_snapped = subject.contract(subject.base()).coverage.has_value();
  if (is_snapped) {
    const std::string says =
        declared.coverage ? fmt::format("{:g} pixels", declared.guard_band) : kNotDeclared;
    subject.add("guard band", says, text_of(band));
    terms.guard_band = static_cast<float>(band);
  }
  subject.add("greatest coordinate drawn right", kNotDeclared, text_of(reach.greatest(terms)),
              is_snapped ? "within the clip tolerance" : "");
}

}  // namespace rastercheck::properties
