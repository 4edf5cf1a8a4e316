#pragma once

// A drawing as a picture of numbers (EXR, NPY): one sample in each column, so that a picture of a
// framebuffer is `width * samples` wide. Its channels are the index of the triangle seen there plus
// 1, or 0; its depth; and its attributes, in order. An EXR file names them `triangle`, `depth`,
// `value0`, `value1`…; an array has them in this order. The first row has the least window y.
//
// A picture shows one triangle at a sample. So it holds only drawings of cases with a depth test,
// or of one triangle.

#include <string>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "cases/picture_file.h"

namespace rastercheck::backends {

/// Takes the drawing of a case from a picture. Fails as `unsupported` for a case of several
/// triangles without a depth test; `file` is the name used in errors.
Result<cases::Fragments> fragments_of_picture(const cases::PictureFile& picture,
                                              const std::string& file, const cases::Case& c);

}  // namespace rastercheck::backends
