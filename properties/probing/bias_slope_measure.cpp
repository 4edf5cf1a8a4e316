// Measures the m of a depth bias, and on which sides its clamp limits the offset.
//
// Draws planes of depth that are steep in many directions, z_x and z_y known, without a bias and
// with slopes of either sign. The same plane has the same error in both drawings, so their
// difference is m · slope: max(|z_x|, |z_y|), sqrt(z_x² + z_y²), a number between these, or another
// one. Directions along an axis do not tell. The same planes with a clamp of either sign show which
// offsets it limits.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "cases/names.h"
#include "properties/probing/depth_planes.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

using cases::BiasSlope;

/// Derivatives are integers in this unit, from −4 to 4, and the bias' slope is 8 or −8: offsets are
/// multiples of 2^-6.
constexpr double kSteepness = 0x1p-9;
constexpr float kSlope = 8;
/// A clamp between the offsets of max(|z_x|, |z_y|) = 2 and 3 units.
constexpr float kClamp = 2.5F * 0x1p-6F;

/// A plane of depths, and how steep the formulas say it is.
struct SteepPlane {
  DepthTriangle triangle;
  double greatest = 0;  ///< max(|z_x|, |z_y|)
  double root = 0;      ///< sqrt(z_x² + z_y²)
  double sum = 0;       ///< |z_x| + |z_y|
};

std::vector<SteepPlane> steep_planes(Subject& subject) {
  MeasureDraw draw(subject, "slope of bias");
  std::vector<SteepPlane> all;
  while (all.size() < kDepthCells) {
    const double x = draw.between(-4, 4) * kSteepness;
    const double y = draw.between(-4, 4) * kSteepness;
    const double depth = draw.between(7, 9) / 16.0;
    SteepPlane plane{triangle_in_cell(all.size(), depth, x, y),
                     std::max(std::fabs(x), std::fabs(y)), std::hypot(x, y),
                     std::fabs(x) + std::fabs(y)};
    if (draw.one_in(2)) plane.triangle.w = {1, 2, 0.5F};
    all.push_back(plane);
  }
  return all;
}

/// The slopes of the drawn biases.
constexpr std::array kSlopes{kSlope, -kSlope};

/// The planes, and their fragments by bias.
class SteepDrawings {
 public:
  explicit SteepDrawings(Subject& subject) : subject_(&subject), planes_(steep_planes(subject)) {
    for (const SteepPlane& plane : planes_) triangles_.push_back(plane.triangle);
    without_ = draw_planes(subject, triangles_, {});
    for (std::size_t i = 0; i < kSlopes.size(); ++i) free_[i] = fragments(kSlopes[i], 0);
  }

  const SteepPlane& plane(const BiasedFragment& fragment) const {
    return planes_[fragment.triangle];
  }
  /// Without a clamp, by index into kSlopes.
  const std::vector<BiasedFragment>& free(std::size_t slope) const { return free_[slope]; }
  /// Empty if a drawing failed.
  std::vector<BiasedFragment> fragments(float slope, float clamp) const {
    const auto with = draw_planes(*subject_, triangles_, {.bias = {0, slope, clamp}});
    if (!without_ || !with) return {};
    return biased_fragments(*subject_, *without_, *with);
  }

 private:
  Subject* subject_;
  std::vector<SteepPlane> planes_;
  std::vector<DepthTriangle> triangles_;
  std::optional<cases::Fragments> without_;
  std::array<std::vector<BiasedFragment>, kSlopes.size()> free_;
};

/// Which m the fragments show.
struct SlopeReading {
  std::uint64_t greatest = 0;
  std::uint64_t root = 0;
  std::uint64_t sum = 0;
  std::uint64_t between = 0;  ///< including both ends
  std::uint64_t telling = 0;
  std::uint64_t undecided = 0;
  double least_factor = std::numeric_limits<double>::infinity();  ///< m / max(|z_x|, |z_y|)
  double most_factor = -std::numeric_limits<double>::infinity();

  void add(const SteepPlane& plane, double m, double error) {
    const auto is = [&](double expected) { return std::fabs(m - expected) <= error; };
    if (plane.root - plane.greatest <= 2 * error && is(plane.greatest)) {
      ++undecided;
      return;
    }
    ++telling;
    if (is(plane.greatest)) ++greatest;
    if (is(plane.root)) ++root;
    if (is(plane.sum)) ++sum;
    if (m >= plane.greatest - error && m <= plane.root + error) ++between;
    if (plane.greatest > 0) {
      least_factor = std::min(least_factor, m / plane.greatest);
      most_factor = std::max(most_factor, m / plane.greatest);
    }
  }
};

struct SeenSlope {
  BiasSlope slope = BiasSlope::between;
  std::string words;
  std::uint64_t in_favour = 0;
  bool is_permitted = true;  ///< by some contract
};

const char* slope_words(BiasSlope slope) {
  switch (slope) {
    case BiasSlope::greatest:
      return "the greater of |z_x|, |z_y|";
    case BiasSlope::root:
      return "the root of z_x² + z_y²";
    case BiasSlope::between:
      break;
  }
  return "from the greater to the root";
}

SeenSlope seen_slope(const SlopeReading& reading) {
  const auto named = [&](BiasSlope slope, std::uint64_t count) {
    return SeenSlope{slope, slope_words(slope), count};
  };
  if (reading.greatest == reading.telling) return named(BiasSlope::greatest, reading.greatest);
  if (reading.root == reading.telling) return named(BiasSlope::root, reading.root);
  if (reading.between == reading.telling) return named(BiasSlope::between, reading.between);
  if (reading.sum == reading.telling) {
    return {BiasSlope::between, "|z_x| + |z_y|", reading.sum, false};
  }
  return {BiasSlope::between,
          fmt::format("{:.4g} to {:.4g} times the greater of |z_x|, |z_y|", reading.least_factor,
                      reading.most_factor),
          reading.between, false};
}

void measure_formula(Subject& subject, const SteepDrawings& drawings, BiasSight& sight) {
  constexpr const char* kWhat = "slope of bias";
  const BiasSlope declared = subject.declared().depth_bias.slope;
  SlopeReading reading;
  for (std::size_t i = 0; i < kSlopes.size(); ++i) {
    for (const BiasedFragment& fragment : drawings.free(i)) {
      reading.add(drawings.plane(fragment), fragment.offset() / double{kSlopes[i]},
                  kPlaneError / double{kSlope});
    }
  }
  if (reading.telling == 0) {
    subject.add(kWhat, slope_words(declared), "not drawn");
    return;
  }
  const SeenSlope seen = seen_slope(reading);
  const bool is_allowed =
      seen.is_permitted && (declared == seen.slope || declared == BiasSlope::between);
  subject
      .add(kWhat, slope_words(declared), seen.words, "",
           sure_of("samples", seen.in_favour, reading.telling - seen.in_favour, reading.undecided))
      .contradicts = !is_allowed;
  sight.found.slope = seen.slope;
  if (seen.slope != declared) sight.differs = true;
}

/// Counts how offsets beyond a clamp were drawn, on one side of it.
struct ClampReading {
  std::uint64_t limited = 0;  ///< ±clamp is left of the offset
  std::uint64_t untouched = 0;
  std::uint64_t other = 0;
  std::uint64_t undecided = 0;  ///< offsets within the clamp
  std::uint64_t telling() const { return limited + untouched + other; }
};

ClampReading read_clamp(const SteepDrawings& drawings, std::size_t slope, float clamp) {
  ClampReading reading;
  const double limit = std::copysign(double{kClamp}, double{kSlopes[slope]});
  const std::vector<BiasedFragment>& free = drawings.free(slope);
  const std::vector<BiasedFragment> clamped = drawings.fragments(kSlopes[slope], clamp);
  if (free.size() != clamped.size()) return reading;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const double offset = free[i].offset();
    const auto is = [&](double expected) {
      return std::fabs(clamped[i].offset() - expected) <= kPlaneError;
    };
    if (std::fabs(offset) <= double{kClamp} + 2 * kPlaneError) {
      ++(is(offset) ? reading.undecided : reading.other);
    } else {
      ++(is(limit) ? reading.limited : is(offset) ? reading.untouched : reading.other);
    }
  }
  return reading;
}

void measure_clamp(Subject& subject, const SteepDrawings& drawings) {
  constexpr const char* kWhat = "clamp of bias";
  constexpr const char* kAsAsked = "limits on its own side";
  // On the clamp's own side, and on the other one.
  std::array<ClampReading, 2> sides;
  for (std::size_t slope = 0; slope < kSlopes.size(); ++slope) {
    for (const float clamp : {kClamp, -kClamp}) {
      ClampReading& side = sides[kSlopes[slope] * clamp > 0 ? 0 : 1];
      const ClampReading one = read_clamp(drawings, slope, clamp);
      side = {side.limited + one.limited, side.untouched + one.untouched, side.other + one.other,
              side.undecided + one.undecided};
    }
  }
  const auto& [own, across] = sides;
  const std::uint64_t all = own.telling() + across.telling();
  if (all == 0) {
    subject.add(kWhat, kAsAsked, "not drawn");
    return;
  }
  struct Kind {
    const char* words;
    std::uint64_t in_favour;
  };
  const std::array kinds{Kind{kAsAsked, own.limited + across.untouched},
                         Kind{"limits on both sides", own.limited + across.limited},
                         Kind{"limits nothing", own.untouched + across.untouched},
                         Kind{"limits on the other side", own.untouched + across.limited}};
  const auto best = std::max_element(kinds.begin(), kinds.end(), [](const Kind& a, const Kind& b) {
    return a.in_favour < b.in_favour;
  });
  subject
      .add(kWhat, kAsAsked, best->in_favour == all ? best->words : "of another kind", "",
           sure_of("samples", best->in_favour, all - best->in_favour,
                   own.undecided + across.undecided))
      .contradicts = best->in_favour != all || best != kinds.begin();
}

}  // namespace

void measure_bias_slope(Subject& subject, BiasSight& sight) {
  const SteepDrawings drawings(subject);
  measure_formula(subject, drawings, sight);
  measure_clamp(subject, drawings);
}

}  // namespace rastercheck::properties
