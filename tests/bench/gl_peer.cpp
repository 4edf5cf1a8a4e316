// rastercheck-bench-gl: draws the scenes of the benchmark through OpenGL for rastercheck-bench,
// which starts it anew for every configuration of a driver that is read from the environment. It
// takes a line and answers with one, "ok …" or "error …"; the first answer comes unasked.
//
//   (started)     ok RENDERER
//   scene NAME COLOR SAMPLES   ok    the scene is built, uploaded and drawn to warm up; COLOR is
//                                    rgba32f or rgba8
//   draw COUNT    ok SECONDS         that many frames, each finished before the next
//   summary       ok COVERED RED GREEN DEPTH    of the last frame (summary.h)

#include <chrono>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>

#include "backends/gl/context.h"
#include "backends/gl/draw.h"
#include "backends/gl/target.h"
#include "tests/bench/frame_scenes.h"
#include "tests/bench/summary.h"

namespace rastercheck::bench {
namespace {

namespace gl = backends::gl;

tl::unexpected<Error> failure(const std::string& reason) {
  return tl::unexpected(Error{"", "", reason});
}

class GlPeer {
 public:
  static Result<GlPeer> create(const gl::Context& context) {
    Result<gl::Program> program = gl::Program::build(context);
    if (!program) return tl::unexpected(program.error());
    return GlPeer(context, *std::move(program));
  }

  /// What comes after "ok ".
  Result<std::string> answer(const std::string& line) {
    std::istringstream words(line);
    std::string verb;
    words >> verb;
    if (verb == "scene") {
      std::string name;
      std::string color;
      int samples = 0;
      words >> name >> color >> samples;
      return take(name, color, samples).map([] { return std::string(); });
    }
    if (!mesh_) return failure("no scene yet");
    if (verb == "draw") {
      int count = 0;
      words >> count;
      return draw(count);
    }
    if (verb == "summary") return summary();
    return failure("not understood: " + line);
  }

 private:
  GlPeer(const gl::Context& context, gl::Program program)
      : context_(&context), program_(std::move(program)) {}

  Result<void> take(const std::string& name, const std::string& color, int samples) {
    mesh_.reset();
    target_.reset();
    const Result<Scene>& scene = frame_scene(name);
    if (!scene) return tl::unexpected(scene.error());
    const auto format = color == "rgba8" ? gl::ColorFormat::rgba8 : gl::ColorFormat::rgba32f;
    Result<gl::Target> target =
        gl::Target::create(*context_, {scene->size.x, scene->size.y, samples, format});
    if (!target) return tl::unexpected(target.error());
    target_ = *std::move(target);
    std::vector<cases::ClipVertex> positions;
    for (const glm::vec4& p : scene->positions) positions.push_back({p.x, p.y, p.z, p.w});
    std::vector<cases::Triangle> triangles;
    for (const glm::uvec3& t : scene->triangles) triangles.push_back({t.x, t.y, t.z});
    Result<gl::Mesh> mesh = gl::Mesh::upload(*context_, {positions, scene->attributes, triangles});
    if (!mesh) return tl::unexpected(mesh.error());
    mesh_ = *std::move(mesh);
    // The first frame compiles shaders, the second touches memory for the first time.
    return draw(2).map([](const std::string& /*seconds*/) {});
  }

  Result<std::string> draw(int count) const {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < count; ++i) {
      if (const Result<void> drawn = program_.draw_frame(*mesh_, *target_); !drawn) {
        return tl::unexpected(drawn.error());
      }
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return text(taken.count());
  }

  Result<std::string> summary() const {
    const Result<gl::Picture> picture = target_->read();
    if (!picture) return tl::unexpected(picture.error());
    const Summary s =
        summarize(picture->depth, {picture->color.front().data(), 4 * picture->color.size()}, 4);
    return text(s.covered, s.red, s.green, s.depth);
  }

  /// Numbers with all their digits.
  template <typename... Numbers>
  static std::string text(Numbers... numbers) {
    std::ostringstream out;
    out.precision(17);
    ((out << numbers << ' '), ...);
    return out.str();
  }

  const gl::Context* context_;
  gl::Program program_;
  std::optional<gl::Target> target_;
  std::optional<gl::Mesh> mesh_;
};

void say(const Result<std::string>& answer) {
  if (answer) {
    std::cout << "ok " << *answer << std::endl;
  } else {
    std::cout << "error " << to_string(answer.error()) << std::endl;
  }
}

int serve() {
  const Result<gl::Context> context = gl::Context::create();
  if (!context) {
    say(tl::unexpected(context.error()));
    return 0;
  }
  Result<GlPeer> peer = GlPeer::create(*context);
  say(peer.map([&](const GlPeer& /*made*/) { return context->renderer(); }));
  if (!peer) return 0;
  for (std::string line; std::getline(std::cin, line);) say(peer->answer(line));
  return 0;
}

}  // namespace
}  // namespace rastercheck::bench

int main() { return rastercheck::bench::serve(); }
