#pragma once

#include "cases/fragments.h"
#include "cases/picture_file.h"
#include "cases/picture_view.h"

namespace rastercheck::cases {

/// Makes a picture of a drawing, as a plain program stores one: at each sample the fragment that
/// was drawn last or, blended, all of them over each other, numbers computed in float64 and rounded
/// to nearest, samples averaged.
/// `layout` is the file that the view was made of; its values are ignored. NaN is stored as 0 in
/// integers.
PictureFile picture_of(const PictureView& view, const PictureFile& layout, const Fragments& drawn);

}  // namespace rastercheck::cases
