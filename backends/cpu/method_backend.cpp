#include "backends/cpu/method_backend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "backends/cpu/case_state.h"
#include "backends/cpu/fragments.h"
#include "backends/cpu/stage_trace.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

/// Half widths of the viewport that methods clip to (rasterizer/methods/internal/clip_polygon.h).
constexpr double kGuardBand = 0x1p10;

/// The magnitudes of the terms of x_a y_b − x_b y_a.
double minor_terms(float x_a, float y_a, float x_b, float y_b) {
  return std::abs(double{x_a} * double{y_b}) + std::abs(double{x_b} * double{y_a});
}

/// How much more than ordinary ones the numbers of clipped vertices of a triangle may be off. A
/// vertex that clipping makes has coordinates and w that come from the triangle's by cancellation,
/// and are off by a rounding of the largest of these, m, relative to its own w. That is at least
/// the least w > 0 of the triangle where all are positive. Otherwise new vertices lie as near the
/// eye as the triangle's plane does, at (x, y, w) = 0: their distance from it is at least |det| /
/// |N|, N the plane's normal with components that are sums of minors, and their w that over 2 G, as
/// the guard band leaves |x|, |y| <= G w:
///
///   A = m · 2 G |N| / |det|
///
/// where det itself is off by a share of its terms' magnitudes, of which a few roundings are taken
/// away; of what is then not positive nothing is certain.
double clip_amplification(const cases::ClipVertex& a, const cases::ClipVertex& b,
                          const cases::ClipVertex& c) {
  double largest = 0;
  double least_w = std::numeric_limits<double>::infinity();
  for (const cases::ClipVertex& p : {a, b, c}) {
    for (const float part : {p.x, p.y, p.z, p.w}) {
      largest = std::max(largest, std::abs(double{part}));
    }
    least_w = std::min(least_w, double{p.w});
  }
  if (least_w > 0) return std::max(largest / least_w, 1.0);

  double normal = 0;
  double determinant = 0;
  double terms = 0;
  const std::array<const cases::ClipVertex*, 3> p{&a, &b, &c};
  for (std::size_t i = 0; i < 3; ++i) {
    const cases::ClipVertex& q = *p[(i + 1) % 3];
    const cases::ClipVertex& r = *p[(i + 2) % 3];
    const double w = p[i]->w;
    determinant += w * (double{q.x} * double{r.y} - double{r.x} * double{q.y});
    terms += std::abs(w) * minor_terms(q.x, q.y, r.x, r.y);
    normal += minor_terms(q.x, q.y, r.x, r.y) + minor_terms(q.x, q.w, r.x, r.w) +
              minor_terms(q.y, q.w, r.y, r.w);
  }
  const double least = std::abs(determinant) - 0x1p-50 * terms;
  if (!(least > 0)) return std::numeric_limits<double>::infinity();
  return std::max(largest * (2 * kGuardBand * normal / least), 1.0);
}

/// The greatest of a case's triangles; infinite where a new w may have lost all of its digits, and
/// its sign with them: then nothing is certain of what is left of a triangle.
double clip_amplification(const cases::Case& c) {
  constexpr double kMost = 0x1p48;
  double greatest = 1;
  for (const cases::Triangle& triangle : c.triangles) {
    greatest =
        std::max(greatest, clip_amplification(c.positions[triangle[0]], c.positions[triangle[1]],
                                              c.positions[triangle[2]]));
  }
  return greatest < kMost ? greatest : std::numeric_limits<double>::infinity();
}

/// Whether a vertex in front of the eye is clipped by a method, which may be one that the
/// contract's band has in it: that is as wide along both axes, and about the window's origin.
bool has_vertex_beyond_band(const cases::Case& c) {
  return std::any_of(c.positions.begin(), c.positions.end(), [](const cases::ClipVertex& p) {
    const double side = kGuardBand * double{p.w};
    return p.w > 0 && (std::abs(double{p.x}) > side || std::abs(double{p.y}) > side);
  });
}

/// The least float that is not less: a bound that was derived is none any more if it is rounded
/// down.
float rounded_up(double bound) {
  const auto nearest = static_cast<float>(bound);
  return double{nearest} < bound ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
                                 : nearest;
}

/// `more` comes on top of the constant.
cases::ValueBound value_bound(const ras::MethodBound& bound, double more) {
  return {rounded_up(bound.constant + more), rounded_up(bound.per_horizon),
          rounded_up(bound.per_condition), rounded_up(bound.range_share)};
}

/// What scan conversion in double of clipped polygons makes of a contract.
///
/// Positions. Vertices are off by a few roundings of a double, and crossings with rows by
/// 11 · 2^-53 of the edge's farthest coordinate (rasterizer/methods/internal/convex_scan.h), which
/// lies within 2^10 half widths around the viewport's middle. The position error granted, 2^-24
/// pixels, takes that in for viewports up to 2^14; the grid of 2^-16 pixels is only how the
/// contract says where vertices may be. What clipping adds grows with the amplification A of the
/// triangle's numbers, 2^-50 A half widths for a new vertex: the clip tolerance. An edge carries
/// its values along, so what its errors do to values lies within the range that moving the vertices
/// leaves open.
///
/// Values. A clipped vertex has r w and z off by 2^-60 A of themselves, the guard band being 2^10,
/// so that A 2^-34 scale ULP come on top of what is off anyhow; of depth that is, besides the
/// rounding to float32, less than 2^-24. A vertex that only the method clips has the clip tolerance
/// for its position error.
void add_scan_conversion(const cases::Case& c, const ras::Promise& promise,
                         cases::Contract& contract) {
  contract.coverage = cases::Snapping{16, cases::Rounding::unspecified, 0x1p-8F};
  contract.is_on_grid = false;
  contract.basis = cases::Basis::unspecified;
  contract.tie_rule = cases::TieRule::unspecified;
  const cases::Viewport& viewport = c.viewport;
  const float half_width = std::max(std::abs(viewport.width), std::abs(viewport.height)) / 2;
  const float middle = std::max(std::abs(viewport.x), std::abs(viewport.y)) + half_width;
  contract.guard_band = std::max(contract.guard_band, 1024 * half_width + middle);

  const double amplification = clip_amplification(c);
  constexpr double kGridUnits = 0x1p16;
  // More than any window coordinate is: below 2^277 half widths, which are below 2^127.
  constexpr double kMostTolerance = 0x1p480;
  contract.clip_tolerance =
      std::isinf(amplification)
          ? kMostTolerance
          : std::clamp(0x1p-50 * amplification * double{half_width} * kGridUnits, 1.0,
                       kMostTolerance);
  if (has_vertex_beyond_band(c)) {
    contract.coverage->position_error =
        static_cast<float>(std::min(contract.clip_tolerance, double{cases::kMaxPositionError}));
    contract.clip_tolerance =
        std::max(contract.clip_tolerance - double{contract.coverage->position_error}, 0.0);
  }
  const double clipped = std::min(0x1p-34 * amplification, 0x1p60);
  contract.bounds.smooth = value_bound(promise.smooth, clipped);
  contract.bounds.noperspective = value_bound(promise.noperspective, clipped);
  contract.bounds.depth = {rounded_up(0.5 + 0x1p-24 + clipped)};
}

/// What the rasterizer promises of coverage and of all but smooth values, and the method of these.
void add_exact_coverage(const cases::Case& c, const ras::Promise& promise,
                        cases::Contract& contract) {
  constexpr float kBound = 0.51F;
  static_assert(kBound >= ras::kValueBound);
  contract.tie_rule = c.fill_rule;
  contract.bounds.smooth = value_bound(promise.smooth, 0);
  contract.bounds.noperspective = {kBound};
  contract.bounds.depth = {kBound};
  contract.keeps_equal_depth = true;
}

cases::Contract contract_of(const cases::Case& c, const ras::Promise& promise) {
  cases::Contract contract;
  contract.claims =
      promise.claims == ras::Claim::affine ? cases::Claim::affine : cases::Claim::perspective;
  if (promise.scan == ras::ScanKind::scanned) {
    add_scan_conversion(c, promise, contract);
  } else {
    add_exact_coverage(c, promise, contract);
  }
  return contract;
}

class MethodBackend : public Backend, private Tracer {
 public:
  explicit MethodBackend(const ras::Method& method) : method_(&method) {}

  cases::Contract promise(const cases::Case& c) const override {
    const CaseMesh memory(c);
    return contract_of(c, method_->promise(state_of(c), memory.mesh(), target_size(c)));
  }
  Tracer* tracer() override { return this; }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    const CaseMesh memory(c);
    ras::Fragments fragments;
    const ras::DrawResult drawn = ras::draw_fragments_by(method_->name, state_of(c), memory.mesh(),
                                                         target_size(c), fragments);
    return drawn_fragments(c, drawn, fragments);
  }
  Result<std::optional<records::SampleTrace>> trace(const cases::Case& c,
                                                    const cases::SamplePlace& at) override {
    const CaseMesh memory(c);
    const ras::TraceResult traced = ras::trace_sample_by(method_->name, state_of(c), memory.mesh(),
                                                         target_size(c), sample_place(at));
    return traced_sample(traced);
  }

  const ras::Method* method_;
};

}  // namespace

std::unique_ptr<Backend> make_method_backend(const ras::Method& method) {
  return std::make_unique<MethodBackend>(method);
}

}  // namespace rastercheck::backends
