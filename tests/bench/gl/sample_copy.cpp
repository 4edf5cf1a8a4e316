#include "tests/bench/gl/sample_copy.h"

#include "backends/gl/internal/objects.h"

namespace rastercheck::backends::gl::bench {
namespace {

/// Draws one triangle that covers the whole target.
constexpr const char* kSampleVertexShader = R"(#version 450 core
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);
}
)";

constexpr const char* kFragmentShader = R"(#version 450 core
layout(binding = 0) uniform sampler2DMS colors;
layout(binding = 1) uniform sampler2DMS depths;
layout(location = 0) uniform int index;
layout(location = 0) out vec4 color;
layout(location = 1) out float depth;
void main() {
  color = texelFetch(colors, ivec2(gl_FragCoord.xy), index);
  depth = texelFetch(depths, ivec2(gl_FragCoord.xy), index).r;
}
)";

Object make_image(const TargetShape& shape, GLenum format) {
  Object image = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(image.name(), 1, format, shape.width, shape.height);
  return image;
}

}  // namespace

Result<Picture> read_samples(const TargetShape& shape, GLuint color, GLuint depth) {
  const Result<Object> program = make_program(kSampleVertexShader, kFragmentShader);
  if (!program) return tl::unexpected(program.error());
  // Depth is copied as a colour, which no depth range or clamp affects.
  const Object colors = make_image(shape, GL_RGBA32F);
  const Object depths = make_image(shape, GL_R32F);
  const Object framebuffer = make_framebuffer();
  const Object vertex_array = make_vertex_array();
  constexpr GLenum kBuffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glNamedFramebufferTexture(framebuffer.name(), kBuffers[0], colors.name(), 0);
  glNamedFramebufferTexture(framebuffer.name(), kBuffers[1], depths.name(), 0);
  glNamedFramebufferDrawBuffers(framebuffer.name(), 2, kBuffers);

  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glViewport(0, 0, shape.width, shape.height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glUseProgram(program->name());
  glBindVertexArray(vertex_array.name());
  glBindTextureUnit(0, color);
  glBindTextureUnit(1, depth);

  const auto samples = static_cast<std::size_t>(shape.samples);
  const std::size_t pixels =
      static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(shape.height);
  Picture picture{shape, {}, {}};
  picture.color.resize(pixels * samples);
  picture.depth.resize(pixels * samples);
  std::vector<Color> color_plane(pixels);
  std::vector<float> depth_plane(pixels);
  for (std::size_t sample = 0; sample < samples; ++sample) {
    glUniform1i(0, static_cast<GLint>(sample));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glReadBuffer(kBuffers[0]);
    glReadPixels(0, 0, shape.width, shape.height, GL_RGBA, GL_FLOAT, color_plane.data());
    glReadBuffer(kBuffers[1]);
    glReadPixels(0, 0, shape.width, shape.height, GL_RED, GL_FLOAT, depth_plane.data());
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
      picture.color[pixel * samples + sample] = color_plane[pixel];
      picture.depth[pixel * samples + sample] = depth_plane[pixel];
    }
  }
  return check("reading the samples of a target").map([&] { return std::move(picture); });
}

}  // namespace rastercheck::backends::gl::bench
