#pragma once

// Meshes of Debian packages as scenes, with attributes mapped to 0…1. If a file is missing, the
// error names its package.
//
//   bunny      glmark2-data          69,666 triangles, many about one or two pixels in size
//   armadillo  libcgal-demo          52,000
//   engine     assimp-testmodels    121,496, many of them slivers, many hidden
//   human      assimp-testmodels     28,796, with texture coordinates
//   castle     openarena-081-maps    41,167, with texture coordinates; the eye is inside
//
// scripts/setup installs all packages but the last, which has 40 MB that nothing else here needs.
// CMake unpacks archives when it configures the project, so the packages must be installed before.
// Systems without documentation lack libcgal-demo's archive, which lies in /usr/share/doc.

#include <glm/vec2.hpp>

#include "cases/error.h"
#include "cases/mesh.h"
#include "tests/bench/bench_scenes.h"

namespace rastercheck::bench {

/// The view in which all of this program's meshes are drawn, and have been since its first figures:
/// from the front, a little from above and from the right, as close as a sphere around the mesh's
/// box allows.
cases::MeshOptions seen_from_the_front(const cases::Mesh& mesh, const glm::ivec2& size);

/// These meshes are seen from outside and fill the target.
Result<Scene> bunny(const glm::ivec2& size);
Result<Scene> armadillo(const glm::ivec2& size);
Result<Scene> engine(const glm::ivec2& size);
Result<Scene> human(const glm::ivec2& size);

/// A level of a game, drawn completely from inside: much is hidden, and triangles cross the near
/// plane and the plane of the eye.
Result<Scene> castle(const glm::ivec2& size);

}  // namespace rastercheck::bench
