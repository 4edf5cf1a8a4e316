// rastercheck-bench-gl: draws the benchmark's scenes through OpenGL for rastercheck-bench. A new
// process is started for every configuration of a driver, because drivers read it from the
// environment. The process reads lines and answers each with one line, "ok …" or "error …". The
// first answer comes unasked.
//
//   (started)     ok RENDERER
//   scene NAME COLOR SAMPLES [KIND]
//                 ok                 the scene is built, uploaded and drawn to warm up; COLOR is
//                                    rgba32f or rgba8; KIND is a kind of draw (draw_kinds.h); the
//                                    default draws attributes as colours, with the depth test
//                                    `less`
//   draw COUNT    ok SECONDS         that many frames, each finished before the next
//   summary       ok COVERED RED GREEN DEPTH    of the last frame (summary.h)
//   probes        ok PROBES          of the last frame, one sample per pixel (probes.h)

#include <chrono>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "backends/gl/context.h"
#include "tests/bench/draw_kinds.h"
#include "tests/bench/frame_scenes.h"
#include "tests/bench/gl/draw.h"
#include "tests/bench/gl/target.h"
#include "tests/bench/gl/texture.h"
#include "tests/bench/peer_answers.h"
#include "tests/bench/probes.h"
#include "tests/bench/summary.h"
#include "tests/bench/texture_scenes.h"

namespace rastercheck::bench {
namespace {

namespace gl = backends::gl;
namespace frames = backends::gl::bench;

tl::unexpected<Error> failure(const std::string& reason) {
  return tl::unexpected(Error{"", "", reason});
}

class GlPeer {
 public:
  explicit GlPeer(const gl::Context& context) : context_(&context) {}

  /// Returns the text that follows "ok ".
  Result<std::string> answer(const std::string& line) {
    std::istringstream words(line);
    std::string verb;
    words >> verb;
    if (verb == "scene") {
      std::string name;
      std::string color;
      std::string kind;
      int samples = 0;
      words >> name >> color >> samples >> kind;
      return take(name, color, samples, kind).map([] { return std::string(); });
    }
    if (!mesh_) return failure("no scene yet");
    if (verb == "draw") {
      int count = 0;
      words >> count;
      return draw(count);
    }
    if (verb == "summary") return summary();
    if (verb == "probes") return probes();
    return failure("not understood: " + line);
  }

 private:
  Result<void> take(const std::string& name, const std::string& color, int samples,
                    const std::string& kind_name) {
    mesh_.reset();
    target_.reset();
    program_.reset();
    const DrawKind* const kind = draw_kind(kind_name);
    if (!kind_name.empty() && kind == nullptr) return failure("no kind of draw: " + kind_name);
    const Result<Scene>& scene = kind == nullptr ? frame_scene(name) : shaded_scene(name, *kind);
    if (!scene) return tl::unexpected(scene.error());
    Result<frames::Program> program =
        (kind == nullptr ? Result<frames::DrawState>{} : state_of(*kind))
            .and_then([&](const frames::DrawState& state) {
              return frames::Program::build(*context_, state);
            });
    if (!program) return tl::unexpected(program.error());
    program_ = *std::move(program);
    const auto format = color == "rgba8" ? cases::ColorFormat::rgba8 : cases::ColorFormat::float32;
    Result<frames::Target> target =
        frames::Target::create(*context_, {scene->size.x, scene->size.y, samples, format});
    if (!target) return tl::unexpected(target.error());
    target_ = *std::move(target);
    std::vector<cases::ClipVertex> positions;
    for (const glm::vec4& p : scene->positions) positions.push_back({p.x, p.y, p.z, p.w});
    std::vector<cases::Triangle> triangles;
    for (const glm::uvec3& t : scene->triangles) triangles.push_back({t.x, t.y, t.z});
    Result<frames::Mesh> mesh =
        frames::Mesh::upload(*context_, {positions, scene->attributes, triangles});
    if (!mesh) return tl::unexpected(mesh.error());
    mesh_ = *std::move(mesh);
    // The first frame compiles shaders, and the second touches memory for the first time.
    return draw(2).map([](const std::string& /*seconds*/) {});
  }

  Result<frames::DrawState> state_of(const DrawKind& kind) {
    frames::DrawState state;
    state.depth_function = kind.depth_function;
    state.writes_depth = kind.writes_depth;
    state.clear_depth = kind.clear_depth;
    state.blend = kind.blend;
    state.alpha = kind.alpha;
    if (!kind.filter) return state;
    if (!texture_) {
      Result<frames::Texture> uploaded = upload_texture();
      if (!uploaded) return tl::unexpected(uploaded.error());
      texture_ = *std::move(uploaded);
    }
    state.texturing = frames::Texturing{
        .texture = &*texture_, .filter = *kind.filter, .discard_below = kind.discard_below};
    return state;
  }

  Result<frames::Texture> upload_texture() const {
    const Result<rasterizer::Texture>& texture = bench_texture();
    if (!texture) return tl::unexpected(texture.error());
    std::vector<frames::TextureLevel> levels;
    for (std::size_t i = 0; i < texture->level_count(); ++i) {
      levels.push_back({texture->width(i), texture->height(i), texture->texels(i)});
    }
    return frames::Texture::upload(*context_, levels);
  }

  Result<std::string> draw(int count) const {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < count; ++i) {
      if (const Result<void> drawn = program_->draw_frame(*mesh_, *target_); !drawn) {
        return tl::unexpected(drawn.error());
      }
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return text(taken.count());
  }

  Result<std::string> summary() const {
    const Result<frames::Picture> picture = target_->read();
    if (!picture) return tl::unexpected(picture.error());
    const Summary s =
        summarize(picture->depth, {picture->color.front().data(), 4 * picture->color.size()}, 4);
    return text(s.covered, s.red, s.green, s.depth);
  }

  Result<std::string> probes() const {
    const Result<frames::Picture> picture = target_->read();
    if (!picture) return tl::unexpected(picture.error());
    if (picture->shape.samples != 1) return failure("probes are of one sample per pixel");
    return to_word(take_probes({picture->shape.width, picture->shape.height}, picture->depth,
                               [&](std::size_t pixel) { return picture->color[pixel]; }));
  }

  const gl::Context* context_;
  std::optional<frames::Texture> texture_;
  std::optional<frames::Program> program_;
  std::optional<frames::Target> target_;
  std::optional<frames::Mesh> mesh_;
};

int serve_context() {
  const Result<gl::Context> context = gl::Context::create();
  if (!context) {
    say(tl::unexpected(context.error()));
    return 0;
  }
  say(context->renderer());
  GlPeer peer(*context);
  serve([&peer](const std::string& line) { return peer.answer(line); });
  return 0;
}

}  // namespace
}  // namespace rastercheck::bench

int main() { return rastercheck::bench::serve_context(); }
