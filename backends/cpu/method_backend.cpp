#include "backends/cpu/method_backend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "backends/cpu/case_state.h"
#include "backends/cpu/fragments.h"
#include "backends/cpu/stage_trace.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

/// Size, in half widths of the viewport, of the guard band to which methods clip
/// (rasterizer/methods/internal/clip_polygon.h).
constexpr double kGuardBand = 0x1p10;

/// The sum of the magnitudes of the two terms of x_a y_b − x_b y_a.
double minor_terms(float x_a, float y_a, float x_b, float y_b) {
  return std::abs(double{x_a} * double{y_b}) + std::abs(double{x_b} * double{y_a});
}

/// How much larger than usual the errors of a triangle's clipped vertices may be. Clipping computes
/// the coordinates and w of a new vertex from the triangle's vertices, with cancellation. So a new
/// vertex is off by about one rounding of m, the triangle's largest number, divided by the vertex's
/// own w. If all w of the triangle are positive, the new w is at least the least of them.
///
/// Otherwise new vertices may lie as near the eye, (x, y, w) = 0, as the triangle's plane does.
/// Their distance from the eye is at least |det| / |N|, where N is the plane's normal, whose
/// components are sums of minors. The new w is at least that distance over 2 G, because the guard
/// band leaves only |x|, |y| <= G w. So the amplification is
///
///   A = m · 2 G |N| / |det|.
///
/// Here det itself is off by a share of its terms' magnitudes, so a few roundings are subtracted.
/// If the result is not positive, nothing is certain.
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

/// The greatest amplification over a case's triangles. Infinite if a new w may have lost all its
/// digits and even its sign, so that nothing is certain about the clipped triangle.
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

/// True if a vertex in front of the eye lies beyond the methods' guard band, so that they clip it.
/// The contract's guard band may contain such a vertex, because that band is as wide along the
/// shorter axis as along the longer one and is centred on the window's origin.
bool has_vertex_beyond_band(const cases::Case& c) {
  return std::any_of(c.positions.begin(), c.positions.end(), [](const cases::ClipVertex& p) {
    const double side = kGuardBand * double{p.w};
    return p.w > 0 && (std::abs(double{p.x}) > side || std::abs(double{p.y}) > side);
  });
}

/// The bound as a float, rounded up because rounding down would break a derived bound.
float rounded_up(double bound) {
  const auto nearest = static_cast<float>(bound);
  return double{nearest} < bound ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
                                 : nearest;
}

/// Converts a bound; `more` is added to its constant.
cases::ValueBound value_bound(const ras::MethodBound& bound, double more) {
  return {rounded_up(bound.constant + more), rounded_up(bound.per_horizon),
          rounded_up(bound.per_condition), rounded_up(bound.range_share)};
}

/// Adds the promises of methods that clip polygons and scan-convert them in double.
///
/// Positions. Vertices are off by a few roundings of a double. Crossings with rows are off by
/// 11 · 2^-53 of the edge's farthest coordinate (rasterizer/methods/internal/convex_scan.h), which
/// lies within 2^10 half widths of the viewport's middle. The granted position error, 2^-24 pixels,
/// covers both errors for viewports up to 2^14 pixels; the grid of 2^-16 pixels is only the
/// contract's way to say where vertices may be. Clipping adds an error that grows with the
/// amplification A of the triangle: 2^-50 A half widths for a new vertex, which is the clip
/// tolerance. A method interpolates along an edge with its own, slightly wrong end points. So an
/// error of an edge changes values no more than moving the vertices by that error.
///
/// Values. The products r w and the z of a clipped vertex have a relative error of 2^-60 A, the
/// 2^-50 A half widths divided by the band's 2^10 half widths. That is at most 2^-36 A scale ULP,
/// as a scale ULP is at least 2^-24 of the scale; four times as much is added to the other errors.
/// For depth, the other errors are the rounding to float32 (half a scale ULP) and less than 2^-24
/// scale ULP from the computation in double. A vertex that only the method clips has the clip
/// tolerance as its position error.
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
  // More grid units than any window coordinate has: coordinates are below 2^277 half widths, and
  // half widths below 2^127 pixels.
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

/// Adds the method's promises for smooth values, and the rasterizer's promises for everything else,
/// coverage included.
void add_exact_coverage(const cases::Case& c, const ras::Promise& promise,
                        cases::Contract& contract) {
  constexpr float kBound = 0.51F;
  static_assert(kBound >= ras::kValueBound);
  contract.tie_rule = c.fill_rule;
  contract.bounds.smooth = value_bound(promise.smooth, 0);
  contract.bounds.noperspective = {kBound};
  promise_depths(c, contract);
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
  explicit MethodBackend(const ras::Method& method) : method_(&method) {
    if (scans()) capabilities_.lacks = {cases::Feature::depth_bias, cases::Feature::unorm_depth};
  }

  About about() const override { return {.capabilities = capabilities_}; }
  cases::Contract promise(const cases::Case& c) const override {
    const CaseMesh memory(c);
    return contract_of(c, method_->promise(state_of(c), memory.mesh(), target_size(c)));
  }
  Tracer* tracer() override { return this; }

 private:
  /// True if the method scan-converts polygons, depths included: as float32, without bias.
  bool scans() const {
    return method_->promise(ras::State(), ras::Mesh(), {1, 1, 1}).scan == ras::ScanKind::scanned;
  }

  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    if (const std::string what = cases::lacked_by(capabilities_, c); !what.empty()) {
      return tl::unexpected(Error{"", "", "the method has no " + what, Failure::unsupported});
    }
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
  cases::Capabilities capabilities_;
};

}  // namespace

std::unique_ptr<Backend> make_method_backend(const ras::Method& method) {
  return std::make_unique<MethodBackend>(method);
}

}  // namespace rastercheck::backends
