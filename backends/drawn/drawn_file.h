#pragma once

// A drawing as a file of little-endian 32-bit numbers. It answers a draw file (draw_file.h):
//
//   8 bytes   "RCDRAWN1"
//   1 word    number of draws: one for each triangle or, with a depth test, one for all
//   for each draw:
//     6 words   status: RASTERCHECK_OK, _UNSUPPORTED or _FAILED; min_x, min_y, max_x, max_y: the
//               rectangle of pixels that may be covered; length of a message, bytes
//     message   says why the status is not RASTERCHECK_OK; padded with zeros to whole words
//     arrays    only for RASTERCHECK_OK, for the n samples of the rectangle, in the order
//               [y][x][sample]: shown [n]: 0, or the index of the triangle seen there plus 1, in
//               this draw; depth [n]; attributes [n][attribute_count] (floats)
//
// Where `shown` is 0, depth and attributes are ignored. Row 0 has the least window y.

#include <string>
#include <string_view>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::backends {

/// Reads the drawing of a case. Fails as `unsupported` if a draw's status is
/// RASTERCHECK_UNSUPPORTED; `file` is the name used in errors.
Result<cases::Fragments> parse_drawn(std::string_view bytes, const std::string& file,
                                     const cases::Case& c);

}  // namespace rastercheck::backends
