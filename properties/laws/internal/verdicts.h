#pragma once

// The oracle's answers, for laws that ask few questions.

#include <cstdint>
#include <memory>
#include <optional>

#include "oracle/triangle_truth.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {

/// Answers questions about one case under a contract. Sets up nothing before the first question,
/// and keeps only the last triangle in memory.
class Verdicts {
 public:
  Verdicts(const cases::Case& c, const cases::Contract& contract)
      : case_(&c), contract_(contract) {}

  const oracle::TriangleTruth& truth(std::uint32_t triangle) {
    if (!scene_) scene_ = std::make_unique<oracle::SceneTruth>(*case_, contract_);
    if (!truth_ || triangle_ != triangle) {
      truth_ = std::make_unique<oracle::TriangleTruth>(*scene_, triangle);
      triangle_ = triangle;
    }
    return *truth_;
  }

  /// Judges the pixel and sample of `place` for `triangle`, which may differ from place.triangle.
  records::SampleVerdict judge(std::uint32_t triangle, const cases::SamplePlace& place) {
    return truth(triangle).judge(static_cast<int>(place.x), static_cast<int>(place.y),
                                 static_cast<int>(place.sample));
  }

  /// True if the depth or the attribute has no value at the place. This is possible if values come
  /// from exact positions and a snapped triangle covers a sample with 1/w <= 0, or has area only
  /// because of snapping.
  bool is_undefined(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute) {
    const auto x = static_cast<int>(place.x);
    const auto y = static_cast<int>(place.y);
    const auto s = static_cast<int>(place.sample);
    const oracle::TriangleTruth& asked = truth(place.triangle);
    return attribute ? !asked.attribute(*attribute, x, y, s) : !asked.depth(x, y, s);
  }

 private:
  const cases::Case* case_;
  cases::Contract contract_;
  std::unique_ptr<oracle::SceneTruth> scene_;
  std::unique_ptr<oracle::TriangleTruth> truth_;
  std::uint32_t triangle_ = 0;
};

/// How far a contract may move a vertex along each axis, in pixels.
inline double placement_reach(const cases::Snapping& grid) {
  return (grid.rounding_reach() + double{grid.position_error}) / grid.steps();
}

}  // namespace rastercheck::properties
