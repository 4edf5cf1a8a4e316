#pragma once

// A drawing as a picture of numbers (EXR, NPY). Each column is one sample, so there are `width *
// samples` columns. The channels are the index plus 1 of the triangle seen at the sample, or 0; the
// depth; and the attributes in order. An EXR file names them `triangle`, `depth`, `value0`,
// `value1`…; an array has them in this order. The first row has the least window y.
//
// A picture shows one triangle per sample. So it can only hold drawings of cases with a depth test
// or with a single triangle.

#include <string>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "cases/picture_file.h"

namespace rastercheck::backends {

/// Reads the drawing of a case from a picture. Fails as `unsupported` for a case of several
/// triangles without a depth test; `file` is the name used in errors.
Result<cases::Fragments> fragments_of_picture(const cases::PictureFile& picture,
                                              const std::string& file, const cases::Case& c);

}  // namespace rastercheck::backends
