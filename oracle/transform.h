#pragma once

#include <string>

#include "cases/case.h"
#include "cases/clip_case.h"
#include "cases/error.h"

namespace rastercheck::oracle {

/// Converts a case with a camera to clip space. Positions become projection · view · model ·
/// position, computed exactly and rounded once to float32 (nearest, ties to even, subnormals kept);
/// the camera is removed. Returns a case without a camera unchanged. Fails at the first vertex
/// whose clip position overflows float32; `file` is the name used in the error.
Result<cases::ClipCase> to_clip_case(const cases::Case& c, const std::string& file);

}  // namespace rastercheck::oracle
