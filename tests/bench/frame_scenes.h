#pragma once

// The scenes whose whole frames are timed, by name.

#include <string_view>
#include <vector>

#include "cases/error.h"
#include "tests/bench/bench_scenes.h"

namespace rastercheck::bench {

/// Their names; what comes after an @ is the target's size where it is not kTarget × kTarget.
const std::vector<std::string_view>& frame_scenes();

/// The scene of that name, made when it is asked for first. Fails where there is none, or its mesh
/// cannot be read.
const Result<Scene>& frame_scene(std::string_view name);

}  // namespace rastercheck::bench
