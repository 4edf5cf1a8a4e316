#pragma once

#include <array>
#include <span>
#include <vector>

#include "cases/case.h"
#include "oracle/judged_number.h"

namespace rastercheck::oracle {

/// The judged coordinates of a clip position: x, y, z, w.
using JudgedPosition = std::array<JudgedNumber, 4>;

/// Judges the computed clip positions, one per vertex of the case, against exact ones. The
/// allowance is Contract::transform_bound (>= 0). Without a camera the case's own positions are
/// exact.
std::vector<JudgedPosition> judge_transform(const cases::Case& c,
                                            std::span<const cases::ClipVertex> computed,
                                            float transform_bound);

}  // namespace rastercheck::oracle
