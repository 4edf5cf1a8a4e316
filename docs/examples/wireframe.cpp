// A bunny in grey, the edges of its triangles as lines, and some of its vertices as points:
//   wireframe MESH PICTURE.png

#include <array>
#include <cstdint>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/glm.hpp>
#include <vector>

#include "files.h"
#include "rasterizer/rasterizer.h"
#include "rasterizer/vertex_stage.h"

using namespace rastercheck::rasterizer;

namespace {

constexpr int kSide = 1024;

/// Draws the mesh's vertices, joined as the state says, in one colour.
bool draw_in(const glm::vec4& color, const State& state, const std::vector<glm::vec4>& clip,
             const std::vector<glm::uvec3>& corners, Picture& frame) {
  std::vector<float> attributes;
  for (std::size_t i = 0; i < clip.size(); ++i) {
    attributes.insert(attributes.end(), {color.r, color.g, color.b, color.a});
  }
  return !draw(state, {clip, attributes, {}, corners}, frame, 0).error;
}

}  // namespace

int main(int count, char** files) {
  const std::optional<Model> bunny = count == 3 ? read_model(files[1]) : std::nullopt;
  if (!bunny) return 1;
  const Camera camera{glm::rotate(glm::mat4(1), 0.35F, {0, 1, 0}),
                      glm::lookAt(glm::vec3(0, 1, 5), {0, 0, 0}, {0, 1, 0}),
                      glm::perspectiveRH_ZO(0.5F, 1.0F, 1.0F, 10.0F)};
  std::vector<glm::vec4> clip;
  if (transform(camera, bunny->positions, clip)) return 1;
  // A line has the vertices a, b, b, a point a, a, a.
  std::vector<glm::uvec3> lines;
  for (const glm::uvec3& t : bunny->triangles) {
    for (const auto& [a, b] : {std::array{t.x, t.y}, std::array{t.y, t.z}, std::array{t.z, t.x}}) {
      if (a < b) lines.emplace_back(a, b, b);  // the neighbour has the edge the other way round
    }
  }
  std::vector<glm::uvec3> points;
  for (std::uint32_t i = 0; i < clip.size(); i += 150) points.emplace_back(i, i, i);

  State state;
  state.viewport = {{0, kSide}, {kSide, -kSide}};  // y up, rows from above: as with Vulkan
  state.depth_test = DepthTest::less;
  state.attributes.resize(4);
  Picture frame;
  Picture picture;
  frame.format = ColorFormat::rgba8;
  if (clear(frame, {kSide, kSide, 4}, 4, 1)) return 1;
  // Moves the surface back a little, so that the lines on it are seen.
  State filled = state;
  filled.depth_bias = {64, 4, 0};
  if (!draw_in({0.85F, 0.85F, 0.82F, 1}, filled, clip, bunny->triangles, frame)) return 1;
  state.primitive = Primitive::lines;
  state.line_width = 0.5F;
  if (!draw_in({0.15F, 0.3F, 0.55F, 1}, state, clip, lines, frame)) return 1;
  state.primitive = Primitive::points;
  state.point_size = 5;
  if (!draw_in({0.8F, 0.3F, 0.1F, 1}, state, clip, points, frame)) return 1;
  return resolve(frame, picture) || !write_png(files[2], kSide, kSide, picture.bytes) ? 1 : 0;
}
