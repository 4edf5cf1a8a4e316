#pragma once

// A case's attributes as varyings. Programs are few, since drivers that compile for the processor
// take longer for one than for hundreds of cases: each has a vector of four floats for every way to
// vary that may come up together, whether a case has attributes of it or not. What has more
// attributes is drawn several times. Samples' own values are drawn apart from those of whole
// pixels, which would else be asked for at every sample as well.

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

/// Up to four attributes, or none.
struct Varying {
  VaryingClass varies;
  std::array<std::size_t, 4> attributes{};  ///< indices into the case's
  std::size_t count = 0;
  bool operator==(const Varying&) const = default;
};

/// What is drawn at once: the vectors of a program, some of them without attributes.
using Pass = std::vector<Varying>;

/// At least one pass, without noperspective where there is none.
std::vector<Pass> pack(const std::vector<cases::Attribute>& attributes, int samples,
                       bool has_noperspective);

}  // namespace rastercheck::backends::gl
