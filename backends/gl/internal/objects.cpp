#include "backends/gl/internal/objects.h"

#include <fmt/format.h>

#include <array>

namespace rastercheck::backends::gl {
namespace {

/// The first line of the log that has text; error messages have only one line.
std::string first_line(const std::string& log) {
  const std::size_t begin = log.find_first_not_of(" \r\n");
  if (begin == std::string::npos) return "no reason given";
  return log.substr(begin, log.find_first_of("\r\n", begin) - begin);
}

using GetParameter = void (*)(GLuint name, GLenum parameter, GLint* value);
using GetLog = void (*)(GLuint name, GLsizei size, GLsizei* length, char* log);

Result<void> check_status(GLuint name, GLenum status, const char* what, GetParameter get,
                          GetLog get_log) {
  GLint is_good = 0;
  get(name, status, &is_good);
  if (is_good != 0) return {};
  std::array<char, 4096> log{};
  get_log(name, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return failure(what + (": " + first_line(log.data())));
}

Result<Object> make_shader(GLenum stage, const char* source) {
  Object shader(glCreateShader(stage), [](GLuint name) noexcept { glDeleteShader(name); });
  glShaderSource(shader.name(), 1, &source, nullptr);
  glCompileShader(shader.name());
  return check_status(shader.name(), GL_COMPILE_STATUS, "a shader does not compile", glGetShaderiv,
                      glGetShaderInfoLog)
      .map([&] { return std::move(shader); });
}

}  // namespace

Object make_buffer() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  return {name, [](GLuint old) noexcept { glDeleteBuffers(1, &old); }};
}

Object make_framebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return {name, [](GLuint old) noexcept { glDeleteFramebuffers(1, &old); }};
}

Object make_sampler() {
  GLuint name = 0;
  glCreateSamplers(1, &name);
  return {name, [](GLuint old) noexcept { glDeleteSamplers(1, &old); }};
}

Object make_texture(GLenum target) {
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  return {name, [](GLuint old) noexcept { glDeleteTextures(1, &old); }};
}

Object make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return {name, [](GLuint old) noexcept { glDeleteVertexArrays(1, &old); }};
}

Object generate_buffer() {
  GLuint name = 0;
  glGenBuffers(1, &name);
  return {name, [](GLuint old) noexcept { glDeleteBuffers(1, &old); }};
}

Object generate_framebuffer() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  return {name, [](GLuint old) noexcept { glDeleteFramebuffers(1, &old); }};
}

Object generate_texture() {
  GLuint name = 0;
  glGenTextures(1, &name);
  return {name, [](GLuint old) noexcept { glDeleteTextures(1, &old); }};
}

Object generate_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return {name, [](GLuint old) noexcept { glDeleteVertexArrays(1, &old); }};
}

Result<Object> make_program(const char* vertex_shader, const char* fragment_shader) {
  const Result<Object> vertex = make_shader(GL_VERTEX_SHADER, vertex_shader);
  if (!vertex) return tl::unexpected(vertex.error());
  const Result<Object> fragment = make_shader(GL_FRAGMENT_SHADER, fragment_shader);
  if (!fragment) return tl::unexpected(fragment.error());
  Object program(glCreateProgram(), [](GLuint name) noexcept { glDeleteProgram(name); });
  glAttachShader(program.name(), vertex->name());
  glAttachShader(program.name(), fragment->name());
  glLinkProgram(program.name());
  return check_status(program.name(), GL_LINK_STATUS, "a program does not link", glGetProgramiv,
                      glGetProgramInfoLog)
      .map([&] { return std::move(program); });
}

tl::unexpected<Error> failure(std::string reason) {
  return tl::unexpected(Error{"gl", "", std::move(reason)});
}

tl::unexpected<Error> unsupported(std::string reason) {
  return tl::unexpected(Error{"gl", "", std::move(reason), Failure::unsupported});
}

Result<void> check(const std::string& what) {
  const GLenum first = glGetError();
  if (first == GL_NO_ERROR) return {};
  // GL keeps one flag per kind of error. Clear the other flags, so that the next check does not
  // find them. The loop is limited, because a lost context reports its error forever.
  for (int flags = 0; flags < 16 && glGetError() != GL_NO_ERROR; ++flags) {
  }
  return failure(what + " failed (GL error " + hexadecimal(first) + ")");
}

std::string hexadecimal(GLenum code) { return fmt::format("{:#x}", code); }

}  // namespace rastercheck::backends::gl
