#pragma once

#include "cases/fragments.h"
#include "cases/picture_file.h"
#include "cases/picture_view.h"

namespace rastercheck::cases {

/// Makes a picture of a drawing, as a plain program stores one. Each sample shows the fragment that
/// was drawn last or, with blending, all its fragments over each other. Numbers are computed in
/// float64 and rounded to nearest, and samples are averaged. `layout` is the picture file from
/// which the view was made; everything but its values is copied. NaN is stored as 0 in integers.
PictureFile picture_of(const PictureView& view, const PictureFile& layout, const Fragments& drawn);

}  // namespace rastercheck::cases
