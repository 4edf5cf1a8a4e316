#pragma once

// What benchmarks of whole frames have in common.

#include <benchmark/benchmark.h>

#include <string>

#include "tests/bench/driver_peer.h"

namespace rastercheck::bench {

/// drawn_area() of a frame_scene() that can be had.
double scene_area(const std::string& name);

/// Triangles and pixels per second of a benchmark whose iterations have each drawn the scene.
void set_rates(benchmark::State& bench, const std::string& name);

/// A benchmark whose iterations are frames of what the peer has taken, by the peer's own clock.
void time_frames_of(DriverPeer& peer, benchmark::State& bench, const std::string& name);

}  // namespace rastercheck::bench
