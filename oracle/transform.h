#pragma once

#include <string>

#include "cases/case.h"
#include "cases/clip_case.h"
#include "cases/error.h"

namespace rastercheck::oracle {

/// The clip case of a camera case: positions become projection · view · model · position, computed
/// exactly and rounded once to float32 (nearest, ties to even, subnormals kept), and the camera is
/// gone. A case without a camera stays as it is. Fails where a clip position overflows float32, at
/// that vertex; `file` is the name for the error.
Result<cases::ClipCase> to_clip_case(const cases::Case& c, const std::string& file);

}  // namespace rastercheck::oracle
