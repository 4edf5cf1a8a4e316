#pragma once

// The scenes whose whole frames are timed, by name.

#include <string_view>
#include <vector>

#include "cases/error.h"
#include "tests/bench/bench_scenes.h"

namespace rastercheck::bench {

/// The names of the scenes. The text after an @ is the target's size if it is not kTarget ×
/// kTarget.
const std::vector<std::string_view>& frame_scenes();

/// The scene with that name, made on first request. Fails if it does not exist, or if its mesh
/// cannot be read.
const Result<Scene>& frame_scene(std::string_view name);

}  // namespace rastercheck::bench
