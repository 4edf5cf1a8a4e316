#pragma once

// Cases for laws about pictures: overlapping triangles in few pixels.

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
/// Why a law does not apply to a case of which a picture may have other fragments.
inline constexpr const char* kOtherFragments =
    "the contract does not promise pictures of the fragments that are drawn";

}  // namespace rastercheck::properties
