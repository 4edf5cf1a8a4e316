#pragma once

// Shrinking: a failing case made as small as it gets while it fails in the same way.
//
// The search goes through a fixed list of passes, each of which offers changed cases:
//
//   fewer triangles and vertices, simple state, no camera, w = 1, positions on the grid of pixels,
//   fewer bits, small exponents, a small framebuffer and viewport
//
// and begins again until a whole round changes nothing. A change is taken only if the case gets
// smaller (internal/case_size.h) and still fails, so the search ends by itself; the limit on tries
// is for cases that take long. It depends on nothing but the case, and so ends with the same case
// everywhere. It works on Cases, not on what drew them: it is the same for random cases, the corpus
// and scenes, and an edit of a generator spoils nothing.

#include <cstdint>
#include <functional>
#include <optional>

#include "cases/case.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// The check of a case that fails as the first did; nothing of one that does not.
using FailsAlike = std::function<std::optional<Check>(const cases::Case&)>;

/// Asked often; true: to end soon, with what there is. Empty: never.
using IsToEnd = std::function<bool()>;

struct ShrinkLimits {
  std::uint64_t tries = 0;  ///< cases that may be checked
  IsToEnd is_to_end;        ///< asked before each
};

struct Shrunk {
  cases::Case source;
  Check check;              ///< of `source`
  std::uint64_t tries = 0;  ///< cases that were checked
  bool is_least = false;    ///< no pass makes it smaller; else the limits ended the search
};

/// `check` is what `failing` fails with. Where nothing smaller fails, these two come back.
Shrunk shrink(cases::Case failing, Check check, const FailsAlike& fails_alike,
              const ShrinkLimits& limits);

/// The case with some of its triangles, in this order, and no vertices but theirs; indices into
/// its triangles.
cases::Case with_triangles(const cases::Case& c, std::span<const std::size_t> triangles);

}  // namespace rastercheck::properties
