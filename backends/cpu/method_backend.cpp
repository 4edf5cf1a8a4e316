#include "backends/cpu/method_backend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "backends/cpu/case_state.h"
#include "backends/cpu/fragments.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

/// How much more than ordinary ones the numbers of clipped vertices may be off: a vertex that
/// clipping makes has coordinates and w that come from the triangle's by cancellation, and are off
/// by a rounding of the largest of these, relative to a w that may be as small as the least. With
/// some w <= 0 the new w is at least what the guard band leaves of x and y, which this leaves out.
double clip_amplification(const cases::Case& c) {
  double largest = 0;
  double least_w = std::numeric_limits<double>::infinity();
  for (const cases::ClipVertex& p : c.positions) {
    for (const float part : {p.x, p.y, p.z, p.w}) {
      largest = std::max(largest, std::abs(double{part}));
    }
    if (p.w > 0) least_w = std::min(least_w, double{p.w});
  }
  return std::max(largest / least_w, 1.0);
}

/// What is promised of every method: that it clips, transforms and interpolates in double and
/// rounds nothing to a grid. The figures are those of rational-linear, derived in
/// rasterizer/methods/rational_linear.cpp.
///
/// Positions. Vertices are off by a few roundings of a double, and crossings with rows by
/// 11 · 2^-53 of the edge's farthest coordinate, which lies within 2^10 half widths around the
/// viewport's middle. The position error granted, 2^-24 pixels, takes that in for viewports up to
/// 2^14; the grid of 2^-16 pixels is only how the contract says where vertices may be. What
/// clipping adds grows with the amplification A of the triangle's numbers, 2^-50 A half widths for
/// a new vertex: the clip tolerance. An edge carries its values along, so what its errors do to
/// values lies within the range that moving the vertices leaves open.
///
/// Values. Besides one rounding to float32, half an ULP, means of s = r/w and of 1/w are off by
/// 11 · 2^-53 of the greatest; for r that is 23 · 2^-53 max|r_i| g, g the horizon ratio, or, with
/// ulp(m) >= 2^-24 m, less than 2^-24 g scale ULP. Depth and noperspective divide nothing: g is 1.
/// A clipped vertex has r w and z off by 2^-60 A of themselves, the guard band being 2^10, so that
/// A 2^-34 scale ULP come on top.
cases::Contract double_precision_contract(const cases::Case& c) {
  cases::Contract contract;
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
  contract.clip_tolerance = static_cast<float>(
      std::clamp(0x1p-50 * amplification * double{half_width} * kGridUnits, 1.0, 0x1p60));
  const auto clipped = static_cast<float>(std::min(0x1p-34 * amplification, 0x1p60));
  constexpr float kInterpolation = 0x1p-24F;
  contract.bounds.smooth = {0.5F + kInterpolation + clipped, kInterpolation};
  contract.bounds.noperspective = {0.5F + kInterpolation + clipped, 0};
  contract.bounds.depth = {0.5F + kInterpolation + clipped, 0};
  return contract;
}

class MethodBackend : public Backend {
 public:
  explicit MethodBackend(std::string name) : name_(std::move(name)) {}

  cases::Contract contract(const cases::Case& c) const override {
    return double_precision_contract(c);
  }
  Result<cases::Framebuffer> draw(const cases::Case& c) override {
    const CaseMesh memory(c);
    ras::Fragments fragments;
    const ras::DrawResult drawn =
        ras::draw_fragments_by(name_, state_of(c), memory.mesh(), target_size(c), fragments);
    return drawn_fragments(c, drawn, fragments);
  }

 private:
  std::string name_;
};

}  // namespace

std::unique_ptr<Backend> make_method_backend(const std::string& name) {
  return std::make_unique<MethodBackend>(name);
}

}  // namespace rastercheck::backends
