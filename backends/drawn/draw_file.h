#pragma once

// A case as a file of little-endian 32-bit numbers, for programs that do not read JSON: the members
// and arrays of rastercheck_draw (plugin.h), one after the other.
//
//   8 bytes   "RCDRAW1\n"
//   28 words  rules, width, height, samples; viewport_x, viewport_y, viewport_width,
//             viewport_height, min_depth, max_depth (floats); scissor_x, scissor_y, scissor_width,
//             scissor_height (signed); cull, front_face, depth_test, depth_clamp; coverage,
//             subpixel_bits, rounding, tie_rule, basis; vertex_count V, attribute_count A,
//             clip_distance_count D, triangle_count T; depth_clear (float)
//             A case with a depth bias or a unorm format begins with "RCDRAW2\n" instead, one of
//             lines or points with "RCDRAW3\n". Both go on with
//   4 words   bias_constant, bias_slope, bias_clamp (floats), depth_bits
//             and "RCDRAW3\n" with
//   4 words   primitive, line_mode, line_width, point_size (floats)
//   arrays    sample_positions [samples][2], positions [V][4] (floats), attributes [A][2],
//             attribute_values [V][A], clip_distances [V][D] (floats), indices [T][3]
//
// The file has all triangles of the case. Without a depth test, each triangle is drawn alone.

#include <string>

#include "cases/case.h"
#include "cases/contract.h"

namespace rastercheck::backends {

/// Returns the file's bytes for a case without a camera. `promised` is what the backend that will
/// draw the case promises about it.
std::string draw_file(const cases::Case& c, const cases::Contract& promised);

}  // namespace rastercheck::backends
