#pragma once

// A case's attributes as varyings: scalars of one qualifier and location are packed into vectors of
// four, so that few kinds of shader are needed, and what has more vectors than a draw has targets
// is drawn several times.

#include <array>
#include <cstddef>
#include <vector>

#include "cases/case.h"

namespace rastercheck::backends::gl {

/// How the attributes of a vector vary. Flat ones have no location, and nor do those of one sample
/// for each pixel: theirs is `center`.
struct VaryingClass {
  cases::Interpolation interpolation = cases::Interpolation::smooth;
  cases::Location location = cases::Location::center;
  auto operator<=>(const VaryingClass&) const = default;
};

/// Up to four attributes.
struct Varying {
  VaryingClass varies;
  std::array<std::size_t, 4> attributes{};  ///< indices into the case's
  std::size_t count = 0;
  bool operator==(const Varying&) const = default;
};

/// What is drawn at once.
using Pass = std::vector<Varying>;

/// Passes of at most `most` vectors; at least one, which is empty where there are no attributes.
std::vector<Pass> pack(const std::vector<cases::Attribute>& attributes, int samples,
                       std::size_t most);

}  // namespace rastercheck::backends::gl
