#pragma once

// Cases and textures for laws about textures: attributes 0 and 1 are texture coordinates.

#include <cstddef>
#include <cstdint>

#include "cases/picture.h"
#include "properties/law.h"
#include "properties/laws/internal/choices.h"

namespace rastercheck::properties {

/// Gives a case two attributes at least, and those coordinates: on borders of texels at samples,
/// next to them, within and far beyond 0 to 1, or whatever they were.
void set_coordinates(Draw& draw, cases::Case& c);

/// A case by one of all generators, of corners on grids more often than of others.
Generated textured_case(Draw& draw);

/// The channel of a texel at column i of row j.
using TexelBytes = std::uint8_t (*)(int i, int j, std::size_t channel);

/// A texture of 1×1 to 64×64 texels and its wraps; nearest filtering.
cases::Texturing texturing_of(Choices& choices, TexelBytes bytes);

/// Texels that are alike nowhere: noise.
std::uint8_t noise_byte(int i, int j, std::size_t channel);

}  // namespace rastercheck::properties
