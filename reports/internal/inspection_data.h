#pragma once

// An inspection as the viewer of report.html reads it (reports/viewer/inspection.js): JSON that is
// a fraction of run.json's, with numbers as their certain digits and samples as arrays.
//
//   {"rules": "vulkan", "attributes": [["u", "smooth"]], "pattern": [[0.5, 0.5]],
//    "triangle": 0, "x": 3, "y": 5, "sample": 0, "value": 1, "q": [["1/2", "0", "-3/4"], …],
//    "outlines": [[[0.5, 1.25], …]], "left": 0, "top": 0, "width": 8, "height": 8,
//    "shortened": true,
//    "samples": [[x, y, sample, "required", "inside", 1, distance, [e_0, e_1, e_2, D],
//                 [[attribute or -1, exact, nearest, actual, scale error, local error, excess,
//                   κ, κ_D], …]], …]}
//
// "value" is the attribute looked for, -1 for depth, null for coverage; "q" null where there is no
// such matrix, "shortened" whether digits of fractions were left out here. In samples null stands
// for what there is not. Places of samples are those of the part.

#include <cstddef>
#include <string>
#include <vector>

#include "records/inspection.h"

namespace rastercheck::reports {

/// Each inspection as text that may stand in an HTML script element: ASCII, without "<". All
/// together have `most` bytes and one inspection more, at most: as many digits of exact fractions
/// are left out as that takes, but for those of the sample that was looked for, then the pixels
/// farther from it than 8. Where that is not enough the last texts are empty.
std::vector<std::string> inspection_data(const std::vector<records::Inspection>& inspections,
                                         std::size_t most);

}  // namespace rastercheck::reports
