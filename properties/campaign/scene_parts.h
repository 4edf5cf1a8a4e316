#pragma once

// A scene in parts that are drawn and judged one after the other, so that memory does not grow with
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

/// How much a part may hold.
struct PartLimits {
  /// Samples in the bounding boxes of its triangles, unless one triangle alone has more.
  std::uint64_t samples = std::uint64_t{1} << 21U;
  std::size_t triangles = std::size_t{1} << 15U;
};

/// The next part of a case without a camera, from that triangle on. With a depth test triangles
/// hide each other, and all are one part.
ScenePart next_part(const cases::Case& scene, std::size_t first, const PartLimits& limits);

/// The fragments of a picture: of each pixel the nearest one of the first sample that has one. Of
/// two at the same depth the one that was added first; any number is nearer than none.
class ShownFragments {
 public:
  ShownFragments(const cases::FramebufferSize& size, std::size_t attributes);

  /// Adds fragments of a part whose first triangle has that index in the scene. Those outside the
  /// framebuffer are ignored. Derivatives are not kept.
  void add(const cases::Fragments& drawn, std::size_t first_triangle);

  cases::Fragments take() { return std::move(shown_); }

 private:
  bool goes_before(const cases::Fragments& drawn, std::size_t i, std::size_t shown) const;

  cases::FramebufferSize size_;
  cases::Fragments shown_;
  std::vector<std::size_t> slots_;  ///< [y][x]: index into shown_, or kNone
};

}  // namespace rastercheck::properties
