#pragma once

// What a machine can do at most, measured: the yardstick of filled frames.
//
// A frame filled with perspective triangles has for each pixel to
//   - store 12 bytes, depth and two floats, into a tile that stays in the first cache;
//   - evaluate four planes in double, depth, the denominator and two numerators, each by a
//     multiplication and an addition (a product and a sum: what is promised of the bits forbids
//     fusing them), and multiply both numerators by the reciprocal: ten operations;
//   - divide once, in double.
// A processor does these side by side, in units of their own, so that no frame is filled faster
// than the slowest of the three alone. Clearing and what is left to do for triangles and tiles
// comes on top.

namespace rastercheck::bench {

/// Per second, all threads together.
struct MachineLimits {
  double stored_bytes = 0;  ///< over and over into 48 KiB of each thread: 64 × 64 pixels
  double operations = 0;    ///< multiplications and additions in double, as many of each
  double divisions = 0;     ///< in double
};

/// Measured with that many threads at a time, by the vectors that Highway chooses; a few hundredths
/// of a second.
MachineLimits measure_machine_limits(unsigned threads);

/// The least seconds in which that many pixels are filled.
double least_fill_seconds(const MachineLimits& limits, double pixels);

}  // namespace rastercheck::bench
