#pragma once

#include <array>
#include <span>
#include <vector>

#include "cases/case.h"
#include "oracle/judged_number.h"

namespace rastercheck::oracle {

/// Of a clip position, x to w.
using JudgedPosition = std::array<JudgedNumber, 4>;

/// Judges clip positions, one for each vertex of a case, by Contract::transform_bound, which is not
/// negative. Without a camera the positions themselves are the exact ones.
std::vector<JudgedPosition> judge_transform(const cases::Case& c,
                                            std::span<const cases::ClipVertex> computed,
                                            float transform_bound);

}  // namespace rastercheck::oracle
