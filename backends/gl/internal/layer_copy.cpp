#include "backends/gl/internal/layer_copy.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "backends/gl/internal/case_program.h"

namespace rastercheck::backends::gl {
namespace {

/// Draws one triangle that covers the whole target.
constexpr const char* kLayerVertexShader = R"(
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);
}
)";

/// Writes the samples of a pixel side by side. The first output holds the number and the depth.
std::string layer_fragment_shader(const Capabilities& has, int samples, std::size_t varyings) {
  const char* const sampler = samples > 1 ? "sampler2DMSArray" : "sampler2DArray";
  std::string outside =
      shader_head(has) +
      fmt::format("uniform {} image[{}];\nuniform int layer;\n", sampler, varyings + 2);
  outside += "layout(location = 0) out vec4 copy0;\n";
  std::string inside = fmt::format(
      "  ivec2 pixel = ivec2(gl_FragCoord.xy);\n  int s = pixel.x % {0};\n"
      "  ivec3 at = ivec3(pixel.x / {0}, pixel.y, layer);\n",
      samples);
  const char* const which = samples > 1 ? "s" : "0";
  inside += fmt::format(
      "  copy0 = vec4(texelFetch(image[0], at, {0}).r, texelFetch(image[1], at, {0}).r, 0, 0);\n",
      which);
  for (std::size_t i = 0; i < varyings; ++i) {
    outside += fmt::format("layout(location = {0}) out vec4 copy{0};\n", i + 1);
    inside += fmt::format("  copy{} = texelFetch(image[{}], at, {});\n", i + 1, i + 2, which);
  }
  return outside + "void main() {\n" + inside + "}\n";
}

}  // namespace

Result<CopyProgram> CopyPrograms::get(int samples, std::size_t varyings) {
  Object& program = made_[{samples, varyings}];
  if (program.name() == 0) {
    Result<Object> made = make_program((shader_head(*has_) + kLayerVertexShader).c_str(),
                                       layer_fragment_shader(*has_, samples, varyings).c_str());
    if (!made) return tl::unexpected(made.error());
    program = *std::move(made);
    glUseProgram(program.name());
    for (std::size_t i = 0; i < varyings + 2; ++i) {
      const std::string image = fmt::format("image[{}]", i);
      glUniform1i(glGetUniformLocation(program.name(), image.c_str()), static_cast<GLint>(i));
    }
  }
  return CopyProgram{program.name(), glGetUniformLocation(program.name(), "layer")};
}

Result<LayerCopy> LayerCopy::create(const CopyProgram& program, const LayerShape& shape) {
  LayerCopy copy;
  copy.shape_ = shape;
  copy.program_ = program;
  copy.vertex_array_ = generate_vertex_array();
  copy.framebuffer_ = generate_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, copy.framebuffer_.name());
  std::vector<GLenum> buffers;
  for (GLenum i = 0; i <= shape.varyings; ++i) {
    copy.copies_.push_back(generate_texture());
    const GLuint image = copy.copies_.back().name();
    glBindTexture(GL_TEXTURE_2D, image);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, copy.width(), shape.size.height, 0, GL_RGBA,
                 GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    buffers.push_back(GL_COLOR_ATTACHMENT0 + i);
    glFramebufferTexture2D(GL_FRAMEBUFFER, buffers.back(), GL_TEXTURE_2D, image, 0);
  }
  glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  return check("making a copy of a layer").map([&] { return std::move(copy); });
}

Result<void> LayerCopy::read(std::span<const GLuint> images, GLint layer,
                             const std::vector<bool>& varyings, LayerContent& content) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width(), shape_.size.height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  const GLenum target =
      shape_.size.samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE_ARRAY : GL_TEXTURE_2D_ARRAY;
  for (GLenum i = 0; i < images.size(); ++i) {
    glActiveTexture(GL_TEXTURE0 + i);
    glBindTexture(target, images[i]);
  }
  glUseProgram(program_.name);
  glBindVertexArray(vertex_array_.name());
  glUniform1i(program_.layer, layer);
  glDrawArrays(GL_TRIANGLES, 0, 3);

  std::vector<std::array<float, 4>> pixels(shape_.samples());
  const auto read_copy = [&](GLenum copy) {
    glReadBuffer(GL_COLOR_ATTACHMENT0 + copy);
    glReadPixels(0, 0, width(), shape_.size.height, GL_RGBA, GL_FLOAT, pixels.data());
  };
  read_copy(0);
  content.numbers.resize(pixels.size());
  content.depth.resize(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    content.numbers[i] = pixels[i][0];
    content.depth[i] = pixels[i][1];
  }
  if (!shape_.has_numbers) content.numbers.clear();
  content.is_empty =
      shape_.has_numbers && std::all_of(content.numbers.begin(), content.numbers.end(),
                                        [](float number) { return number == 0; });
  for (GLenum i = 0; i < shape_.varyings && !content.is_empty; ++i) {
    if (!varyings[i]) continue;
    read_copy(i + 1);
    content.values[i] = pixels;
  }
  // Textures that stay bound would not be freed together with the layers.
  for (GLenum i = 0; i < images.size(); ++i) {
    glActiveTexture(GL_TEXTURE0 + i);
    glBindTexture(target, 0);
  }
  glActiveTexture(GL_TEXTURE0);
  return check("reading a layer");
}

}  // namespace rastercheck::backends::gl
