#pragma once

// Cases and textures for laws about textures: attributes 0 and 1 are texture coordinates.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "cases/picture.h"
#include "properties/choices.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Ensures that the case has at least two attributes, and makes attributes 0 and 1 texture
/// coordinates. Their values put texel borders on or next to samples, lie within or far beyond 0 to
/// 1, or stay as they were.
void set_coordinates(Draw& draw, cases::Case& c);

/// A case from any generator; at least half of the cases are from on-grid.
Generated textured_case(Draw& draw);

/// The value of a channel of the texel at column i, row j.
using TexelBytes = std::uint8_t (*)(int i, int j, std::size_t channel);

/// A texture of 1×1 to 64×64 texels with wrap modes; nearest filtering.
cases::Texturing texturing_of(Choices& choices, TexelBytes bytes);

/// The word for a wrap mode, as in labels.
std::string_view to_word(cases::Wrap wrap);
/// The wrap modes along s and t, such as "repeat and clamp".
std::string wrap_words(const cases::Texturing& texturing);

/// Noise: a pseudorandom byte for each texel and channel.
std::uint8_t noise_byte(int i, int j, std::size_t channel);

}  // namespace rastercheck::properties
