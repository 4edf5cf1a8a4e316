#pragma once

// Measures the limits of a machine, for comparison with the time of filled frames.
//
// For each pixel, a frame filled with perspective triangles has to
//   - store 12 bytes, depth and two floats, into a tile that stays in the first cache;
//   - evaluate four planes in double (depth, the denominator and two numerators), each by a
//     multiplication and an addition, and multiply both numerators by the reciprocal: ten
//     operations. Multiplication and addition are not fused, as the promised bits forbid that;
//   - divide once, in double.
// A processor does these in parallel, in separate units, so no frame can be filled faster than the
// slowest of the three takes alone. Clearing and the work for triangles and tiles take additional
// time.

namespace rastercheck::bench {

/// Rates per second, of all threads together.
struct MachineLimits {
  double stored_bytes = 0;  ///< again and again to the same 48 KiB per thread: 64 × 64 pixels
  double operations = 0;    ///< multiplications and additions in double, as many of each
  double divisions = 0;     ///< in double
};

/// Measures with that many threads at the same time, using the vectors that Highway chooses. Takes
/// a few hundredths of a second.
MachineLimits measure_machine_limits(unsigned threads);

/// The least number of seconds in which that many pixels can be filled.
double least_fill_seconds(const MachineLimits& limits, double pixels);

}  // namespace rastercheck::bench
