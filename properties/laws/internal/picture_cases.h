#pragma once

// Cases for laws about pictures: overlapping triangles in few pixels.

#include <cstdint>

#include "properties/law.h"

namespace rastercheck::properties {

/// A case of at most 32×32 pixels with one sample, or fewer pixels with several. In most cases,
/// four attributes are colours in and beyond [0, 1], and depths are often equal.
Generated overlapping_case(Draw& draw);

/// True if a backend draws pictures, as laws about pictures require (Law::is_promised).
bool draws_pictures(backends::Backend& backend);

/// True if, besides, a picture's fragments are those that the backend draws (cases::PictureBounds).
bool keeps_fragments_in_pictures(backends::Backend& backend);
bool keeps_fragments_in_pictures(const cases::Contract& contract);
/// True if a backend draws pictures with differences across quads, and promises a bound or those of
/// the values that it draws.
bool draws_differences(backends::Backend& backend);
/// True if it promises those of the values that it draws.
bool draws_differences_of_values(backends::Backend& backend);

/// True if a vertex of the triangle is outside the view volume or a clip plane. A driver may draw
/// such a triangle in pieces with planes of their own.
bool may_be_cut(const cases::Case& c, std::uint32_t triangle);

/// Why a law does not apply to a case of which a picture may have other fragments.
inline constexpr const char* kOtherFragments =
    "the contract does not promise pictures of the fragments that are drawn";

}  // namespace rastercheck::properties
