#pragma once

// Cuts a scene into parts to draw and judge one after the other, so that memory does not grow with
// the number of fragments.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cases/case.h"
#include "cases/fragments.h"

namespace rastercheck::properties {

/// Consecutive triangles of a scene.
struct ScenePart {
  std::size_t first = 0;  ///< index into the scene's triangles
  std::size_t count = 0;
  bool operator==(const ScenePart&) const = default;
};

/// The size limits of a part.
struct PartLimits {
  /// Maximum samples in the bounding boxes of the part's triangles; a single triangle may have
  /// more.
  std::uint64_t samples = std::uint64_t{1} << 21U;
  std::size_t triangles = std::size_t{1} << 15U;
};

/// Returns the next part of a case without a camera, starting at triangle `first`. With a depth
/// test triangles hide each other, so all form one part.
ScenePart next_part(const cases::Case& scene, std::size_t first, const PartLimits& limits);

/// Collects the fragments of a picture: for each pixel the nearest fragment of the first sample
/// that has one. At equal depth the fragment added first wins; any number is nearer than NaN.
class ShownFragments {
 public:
  ShownFragments(const cases::FramebufferSize& size, std::size_t attributes);

  /// Adds the fragments of a part that begins at the scene's triangle `first_triangle`. Ignores
  /// fragments outside the framebuffer, and drops derivatives.
  void add(const cases::Fragments& drawn, std::size_t first_triangle);

  cases::Fragments take() { return std::move(shown_); }

 private:
  bool goes_before(const cases::Fragments& drawn, std::size_t i, std::size_t shown) const;

  cases::FramebufferSize size_;
  cases::Fragments shown_;
  std::vector<std::size_t> slots_;  ///< [y][x]: index into shown_, or kNone
};

}  // namespace rastercheck::properties
