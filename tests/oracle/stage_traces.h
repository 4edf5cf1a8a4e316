#pragma once

// Hand-made traces of the triangle with window corners (0,0), (4,0), (0,4). All numbers are exact
// in double, so that a trace has only the errors that a test puts in.

#include <array>

#include "records/stage_trace.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle {

/// The case, on 4×4 pixels: e = (1 − (u + v)/4, u/(4 w1), v/4). Attribute 0 is 0, 1, 0 at the
/// vertices.
inline cases::Case traced_case(float w1 = 1, cases::Rules rules = cases::Rules::vulkan) {
  const float top = rules == cases::Rules::vulkan ? -1.0F : 1.0F;
  return small_case(rules, 4, 4, {{{-1, top, 0, 1}, {w1, top * w1, w1 / 2, w1}, {-1, -top, 0, 1}}},
                    {{{0}, {1}, {0}}});
}

/// U = 2 (2u − 4) and V = 2v, so that u = U/4 + 2 and v = V/2; T = 4.
inline constexpr records::TracedFrame kFrame{{2, 4}, {1, 0}, 4};

/// The case's e_i in that frame.
inline std::array<records::TracedLine, 3> lines(double w1 = 1) {
  return {{{-1.0 / 16, -1.0 / 8, 1.0 / 8}, {1 / (16 * w1), 0, 1 / (8 * w1)}, {0, 1.0 / 8, 0}}};
}
/// The plane of u/4.
inline constexpr records::TracedPlane kQuarterU{1.0 / 16, 0, 1.0 / 2};
inline constexpr records::TracedPlane kOne{0, 0, 1};

/// The window corners.
inline std::array<records::TracedCorner, 3> window_corners() {
  return {{{0, 0, 0, 1, false, {1, 0, 0}},
           {4, 0, 0.5, 1, false, {0, 1, 0}},
           {0, 4, 0, 1, false, {0, 0, 1}}}};
}

/// A trace of a case's first triangle with nothing but its positions and a place.
inline records::SampleTrace bare_trace(const cases::Case& c, double u, double v) {
  records::SampleTrace trace;
  for (std::size_t i = 0; i < 3; ++i) {
    const cases::ClipVertex& p = c.positions[c.triangles[0][i]];
    trace.positions[i] = {p.x, p.y, p.z, p.w};
  }
  trace.u = u;
  trace.v = v;
  trace.depth.u = u;
  trace.depth.v = v;
  trace.attributes = {trace.depth};
  return trace;
}

}  // namespace rastercheck::oracle
