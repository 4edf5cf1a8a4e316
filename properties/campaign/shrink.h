#pragma once

// Shrinks a failing case as far as possible while it still fails in the same way.
//
// The search runs a fixed list of passes, each of which proposes changed cases:
//
//   fewer triangles and vertices, simple state, no camera, w = 1, positions on the grid of pixels,
//   fewer bits, small exponents, a small framebuffer and viewport
//
// and repeats until a whole round changes nothing. A change is accepted only if the case gets
// smaller (internal/case_size.h) and still fails, so the search terminates; the limit on tries is
// only for slow cases. The search depends on the case alone, so the result is the same everywhere.
// Shrinking works on Cases, not on generators: it treats random cases, the corpus and scenes alike,
// and still works after a generator is edited.

#include <cstdint>
#include <functional>
#include <optional>

#include "cases/case.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Returns the check of a case if the case fails like the original; else empty.
using FailsAlike = std::function<std::optional<Check>(const cases::Case&)>;

/// Called often; returns true to end soon with the results so far. An empty function never asks to
/// end.
using IsToEnd = std::function<bool()>;

struct ShrinkLimits {
  std::uint64_t tries = 0;  ///< cases that may be checked
  IsToEnd is_to_end;        ///< called before each check
};

struct Shrunk {
  cases::Case source;
  Check check;              ///< of `source`
  std::uint64_t tries = 0;  ///< cases that were checked
  /// True if no pass makes the case smaller; false if the limits ended the search.
  bool is_least = false;
};

/// Shrinks `failing`, whose check is `check`. Returns both unchanged if nothing smaller fails.
Shrunk shrink(cases::Case failing, Check check, const FailsAlike& fails_alike,
              const ShrinkLimits& limits);

/// Returns the case with only these triangles (indices), in this order, and only their vertices.
cases::Case with_triangles(const cases::Case& c, std::span<const std::size_t> triangles);

}  // namespace rastercheck::properties
