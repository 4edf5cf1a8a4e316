// A checkered bunny in the sun: bunny MESH PICTURE
#include <glm/ext.hpp>
#include <glm/glm.hpp>

#include "files.h"
#include "rasterizer/texture.h"
#include "rasterizer/vertex_stage.h"

using namespace rastercheck::rasterizer;

// Attributes 0 and 1 are texture coordinates, 2 to 4 the normal.
struct Sunlit {
  Texture texture;

  std::size_t outputs() const { return 4; }
  bool uses_derivatives() const { return true; }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const {
    sample(texture, {}, in, 0, 1, out.color.first<4>());
    for (std::size_t lane = 0; lane < in.lanes; ++lane) {
      const glm::vec3 normal(in.values[2][lane], in.values[3][lane], in.values[4][lane]);
      const float sun = glm::dot(glm::normalize(normal), {0.48F, 0.6F, 0.64F});
      for (float* c : out.color.first<3>()) c[lane] *= 0.25F + 0.75F * std::max(sun, 0.0F);
    }
  }
};

int main(int count, char** files) {
  const std::optional<Model> bunny = count == 3 ? read_model(files[1]) : std::nullopt;
  if (!bunny) return 1;

  // From object space to clip space, and normals to world space.
  const Camera camera{glm::rotate(glm::mat4(1), 0.35F, {0, 1, 0}),
                      glm::lookAt(glm::vec3(0, 1, 5), {0, 0, 0}, {0, 1, 0}),
                      glm::perspectiveRH_ZO(0.5F, 1.0F, 1.0F, 10.0F)};
  std::vector<glm::vec4> clip;
  std::vector<glm::vec3> normals;
  if (transform(camera, bunny->positions, clip)) return 1;
  if (transform_normals(camera.model, bunny->normals, normals)) return 1;
  std::vector<float> attributes;
  for (std::size_t i = 0; i < clip.size(); ++i) {
    const glm::vec3 p = 4.0F * bunny->positions[i];
    attributes.insert(attributes.end(), {p.x, p.y, normals[i].x, normals[i].y, normals[i].z});
  }

  Sunlit shader;
  if (Texture::make(256, 256, checkerboard(256), shader.texture)) return 1;
  State state;
  state.viewport = {{0, 512}, {512, -512}};  // y up, rows from above: as with Vulkan
  state.depth_test = DepthTest::less;
  state.attributes.resize(5);
  const Mesh mesh{clip, attributes, {}, bunny->triangles};
  Picture frame, picture;
  frame.format = ColorFormat::rgba8;
  if (clear_and_draw(state, mesh, shader, {512, 512, 4}, 1, frame, 0).error) return 1;
  return resolve(frame, picture) || !write_png(files[2], 512, 512, picture.bytes) ? 1 : 0;
}
