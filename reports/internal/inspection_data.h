#pragma once

// An inspection for the viewer of report.html (reports/viewer/inspection.js), as JSON that is much
// smaller than that of run.json. Numbers have only their certain digits, and samples are arrays.
//
//   {"rules": "vulkan", "attributes": [["u", "smooth"]], "pattern": [[0.5, 0.5]],
//    "triangle": 0, "x": 3, "y": 5, "sample": 0, "value": 1, "q": [["1/2", "0", "-3/4"], …],
//    "outlines": [[[0.5, 1.25], …]], "left": 0, "top": 0, "width": 8, "height": 8,
//    "shortened": true,
//    "samples": [[x, y, sample, "required", "inside", 1, distance, [e_0, e_1, e_2, D],
//                 [[attribute or -1, exact, nearest, actual, scale error, local error, excess,
//                   κ, κ_D], …]], …]}
//
// "value" is the inspected attribute, -1 for depth, null for coverage. "q" is null if there is no
// q-matrix. "shortened" tells whether digits of fractions were left out here. In samples, null
// stands for a missing value. Their x and y count from "left" and "top".

#include <cstddef>
#include <string>
#include <vector>

#include "records/inspection.h"

namespace rastercheck::reports {

/// Returns each inspection as text that may stand in an HTML script element: ASCII, without "<".
/// Together the texts have at most `most` bytes plus one inspection. To fit, digits of exact
/// fractions are left out, except for those of the inspected sample; then pixels more than 8 away
/// from that sample. If that is not enough, the last texts are empty.
std::vector<std::string> inspection_data(const std::vector<records::Inspection>& inspections,
                                         std::size_t most);

}  // namespace rastercheck::reports
