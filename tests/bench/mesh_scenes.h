#pragma once

// Meshes of Debian packages as scenes, attributes mapped to 0…1. A file that is not there is an
// error that names its package.
//
//   bunny      glmark2-data          69,666 triangles, some of a pixel, some of two
//   armadillo  libcgal-demo          52,000
//   engine     assimp-testmodels    121,496, many of them slivers, many hidden
//   human      assimp-testmodels     28,796, with texture coordinates
//   castle     openarena-081-maps    41,167, with texture coordinates; the eye is inside
//
// scripts/setup installs all but the last, 40 MB that nothing else here needs. CMake unpacks what
// comes in archives when it configures the project: after the packages are there, that is. Systems
// without documentation leave out libcgal-demo's archive, which lies in /usr/share/doc.

#include <glm/vec2.hpp>

#include "cases/error.h"
#include "tests/bench/bench_scenes.h"

namespace rastercheck::bench {

/// Framed from outside.
Result<Scene> bunny(const glm::ivec2& size);
Result<Scene> armadillo(const glm::ivec2& size);
Result<Scene> engine(const glm::ivec2& size);
Result<Scene> human(const glm::ivec2& size);

/// A level of a game, all of it drawn from inside: much is hidden, and triangles go through the
/// near plane and the eye's plane.
Result<Scene> castle(const glm::ivec2& size);

}  // namespace rastercheck::bench
