#pragma once

// Packs a case's attributes into varyings. Drivers that compile shaders for the processor take
// longer to compile one program than to draw hundreds of cases, so there must be few programs. So
// each program has one vector of four floats for every class of varying that may occur together,
// whether or not a case uses it. A case with more attributes is drawn several times. Attributes at
// samples are drawn separately from attributes of whole pixels, which would otherwise be evaluated
// at every sample too.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "cases/case.h"

namespace rastercheck::backends::gl {

/// How the attributes of a vector vary. The location is `center` for flat attributes, which have
/// none, and for all attributes if pixels have a single sample.
struct VaryingClass {
  cases::Interpolation interpolation = cases::Interpolation::smooth;
  cases::Location location = cases::Location::center;
  auto operator<=>(const VaryingClass&) const = default;
};

/// A varying that holds up to four attributes, or none.
struct Varying {
  VaryingClass varies;
  std::array<std::size_t, 4> attributes{};  ///< indices into the case's attributes
  std::size_t count = 0;
  bool operator==(const Varying&) const = default;
};

/// The varyings that one draw outputs, one for each vector of the program. Some may hold no
/// attributes.
using Pass = std::vector<Varying>;

/// Returns at least one pass. The passes have noperspective vectors only if `has_noperspective`.
std::vector<Pass> pack(const std::vector<cases::Attribute>& attributes, int samples,
                       bool has_noperspective);

/// Returns a single pass with all of the attributes, for drawings that cannot be split. It has only
/// the vectors that these attributes need.
Pass pack_together(std::span<const cases::Attribute> attributes, int samples);

}  // namespace rastercheck::backends::gl
