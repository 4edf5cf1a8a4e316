#pragma once

// Functions that the benchmarks of whole frames share.

#include <benchmark/benchmark.h>

#include <string>

#include "tests/bench/driver_peer.h"

namespace rastercheck::bench {

/// The drawn_area() of a frame_scene(), which must exist.
double scene_area(const std::string& name);

/// Sets triangles and pixels per second for a benchmark that drew the scene once in each iteration.
void set_rates(benchmark::State& bench, const std::string& name);

/// Runs a benchmark whose iterations are frames of the scene that the peer has taken, timed by the
/// peer's own clock.
void time_frames_of(DriverPeer& peer, benchmark::State& bench, const std::string& name);

}  // namespace rastercheck::bench
