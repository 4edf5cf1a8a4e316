// A loop like that of a viewer. viewer MESH [THREADS] draws 100 frames of a bunny that turns once
// every ten frames, and checks that all of them need no more memory than the first ten.
//
// Everything that outlives a frame is allocated once: clip positions, the framebuffer, the picture.
// Frames i and i + 10 draw the same pose. So the first turn contains every pose, with all the
// memory that drawing it takes and gives back.
#include <malloc.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <glm/ext.hpp>
#include <iostream>
#include <string>

#include "files.h"
#include "rasterizer/texture.h"
#include "rasterizer/vertex_stage.h"

using namespace rastercheck::rasterizer;

namespace {

constexpr int kFrames = 100;
constexpr int kFramesPerTurn = 10;
constexpr int kSide = 256;

/// How many more bytes may be resident after the first turn. The heap may get holes, because
/// threads take and give back memory in a random order. Forgetting only one tile in every frame (64
/// × 64 pixels, 128 KiB with four samples of depth and colour) would add 11 MiB.
constexpr long kSlack = 4L << 20;

/// The number of bytes of this process that are in memory.
long resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  long all = 0;
  long resident = 0;
  statm >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

struct Viewer {
  Model model;
  std::vector<float> attributes;
  Texture texture;
  State state;
  std::vector<glm::vec4> clip;
  Picture frame;
  Picture picture;
  unsigned threads = 0;  ///< 0 means as many as the machine has

  bool set_up(const char* file);
  bool draw_frame(float angle);
  /// The addresses of all data that outlives a frame.
  std::array<const void*, 5> buffers() const {
    return {clip.data(), frame.depth.data(), frame.bytes.data(), picture.depth.data(),
            picture.bytes.data()};
  }
};

bool Viewer::set_up(const char* file) {
  std::optional<Model> read = read_model(file);
  if (!read) return false;
  model = std::move(*read);
  for (const glm::vec3& p : model.positions) {
    attributes.insert(attributes.end(), {4 * p.x, 4 * p.y});
  }
  state.viewport = {{0, kSide}, {kSide, -kSide}};
  state.depth_test = DepthTest::less;
  state.cull = Cull::back;
  state.attributes.resize(2);
  frame.format = ColorFormat::rgba8;
  return !Texture::make(256, 256, checkerboard(256), texture);
}

bool Viewer::draw_frame(float angle) {
  const Camera camera{glm::rotate(glm::mat4(1), angle, {0, 1, 0}),
                      glm::lookAt(glm::vec3(0, 1, 5), {0, 0, 0}, {0, 1, 0}),
                      glm::perspectiveRH_ZO(0.5F, 1.0F, 1.0F, 10.0F)};
  clip.clear();
  if (transform(camera, model.positions, clip)) return false;
  const Mesh mesh{clip, attributes, {}, model.triangles};
  const TexturedShader shader{&texture, {}, 0, 1, {}};
  const TargetSize size{kSide, kSide, 4};
  return !clear_and_draw(state, mesh, shader, size, 1, frame, threads).error &&
         !resolve(frame, picture);
}

}  // namespace

int main(int count, char** arguments) {
  // All threads share one heap. Otherwise each thread would have its own heap, which keeps the
  // memory that it once held, and it would be chance when the last heap has grown to its full size.
  mallopt(M_ARENA_MAX, 1);
  Viewer viewer;
  if (count < 2 || !viewer.set_up(arguments[1])) return 2;
  if (count > 2) viewer.threads = static_cast<unsigned>(std::stoul(arguments[2]));

  std::array<const void*, 5> buffers{};
  long after_turn = 0;
  for (int i = 1; i <= kFrames; ++i) {
    const auto part = static_cast<float>(i % kFramesPerTurn) / static_cast<float>(kFramesPerTurn);
    if (!viewer.draw_frame(part * glm::two_pi<float>())) return 2;
    if (i == 1) buffers = viewer.buffers();
    if (viewer.buffers() != buffers) {
      std::cout << "frame " << i << ": a buffer was allocated anew\n";
      return 1;
    }
    if (i == kFramesPerTurn) after_turn = resident_bytes();
  }

  const long more = resident_bytes() - after_turn;
  std::cout << "resident after frame " << kFramesPerTurn << ": " << after_turn / 1024
            << " KiB, after frame " << kFrames << ": " << (after_turn + more) / 1024
            << " KiB; at most " << kSlack / 1024 << " KiB more are allowed\n";
  return more <= kSlack ? 0 : 1;
}
