#include "tests/bench/gl/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "backends/gl/internal/objects.h"
#include "tests/bench/gl/draw_state.h"

namespace rastercheck::backends::gl::bench {
namespace {

constexpr const char* kMeshVertexShader = R"(#version 450 core
layout(location = 0) in vec4 position;
layout(location = 1) in vec2 attributes;
smooth out vec2 interpolated;
void main() {
  gl_Position = position;
  interpolated = attributes;
}
)";

std::string mesh_fragment_shader(const DrawState& state) {
  std::string head = R"(#version 450 core
smooth in vec2 interpolated;
layout(location = 0) out vec4 color;
)";
  if (!state.texturing) {
    return head +
           fmt::format("void main() {{ color = vec4(interpolated, 0, {}); }}\n", state.alpha);
  }
  head += "layout(binding = 0) uniform sampler2D image;\n";
  std::string body = "  color = texture(image, interpolated);\n";
  if (const std::optional<float>& least = state.texturing->discard_below) {
    body += fmt::format("  if (color.a < {}) discard;\n", *least);
  }
  return head + "void main() {\n" + body + "}\n";
}

template <typename T>
Object upload_buffer(std::span<const T> values) {
  Object buffer = make_buffer();
  // GL has no empty buffer storage.
  const T none{};
  const auto bytes = static_cast<GLsizeiptr>(values.empty() ? sizeof none : values.size_bytes());
  glNamedBufferStorage(buffer.name(), bytes, values.empty() ? &none : values.data(), 0);
  return buffer;
}

/// Makes vertex input `location` read `count` floats from each element of the buffer.
void bind_floats(const Object& vertex_array, GLuint location, const Object& buffer, GLint count) {
  const GLuint name = vertex_array.name();
  glVertexArrayVertexBuffer(name, location, buffer.name(), 0,
                            count * static_cast<GLsizei>(sizeof(float)));
  glVertexArrayAttribFormat(name, location, count, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(name, location, location);
  glEnableVertexArrayAttrib(name, location);
}

Result<void> validate_view(const MeshView& view) {
  if (view.attributes.size() != kAttributes * view.positions.size()) {
    return failure("not two attributes for every vertex");
  }
  for (const cases::Triangle& triangle : view.triangles) {
    if (*std::max_element(triangle.begin(), triangle.end()) >= view.positions.size()) {
      return failure("a vertex index beyond the positions");
    }
  }
  if (view.triangles.size() > std::numeric_limits<GLsizei>::max() / 3) {
    return failure("more indices than one draw takes");
  }
  return {};
}

}  // namespace

struct Mesh::Impl {
  Object positions;
  Object attributes;
  Object indices;
  Object vertex_array;
  GLsizei index_count = 0;
};

Mesh::Mesh(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Mesh::Mesh(Mesh&& other) noexcept = default;
Mesh& Mesh::operator=(Mesh&& other) noexcept = default;
Mesh::~Mesh() = default;

Result<Mesh> Mesh::upload(const Context& /*context*/, const MeshView& view) {
  if (const Result<void> valid = validate_view(view); !valid) return tl::unexpected(valid.error());
  auto impl = std::make_unique<Impl>();
  impl->positions = upload_buffer(view.positions);
  impl->attributes = upload_buffer(view.attributes);
  impl->indices = upload_buffer(view.triangles);
  impl->vertex_array = make_vertex_array();
  impl->index_count = static_cast<GLsizei>(3 * view.triangles.size());
  static_assert(sizeof(cases::ClipVertex) == 4 * sizeof(float));
  bind_floats(impl->vertex_array, 0, impl->positions, 4);
  bind_floats(impl->vertex_array, 1, impl->attributes, static_cast<GLint>(kAttributes));
  glVertexArrayElementBuffer(impl->vertex_array.name(), impl->indices.name());
  return check("uploading a mesh").map([&] { return Mesh(std::move(impl)); });
}

struct Program::Impl {
  DrawState state;
  Object program;
  Object sampler;  ///< its name is 0 if there is no texture
};

Program::Program(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Program::Program(Program&& other) noexcept = default;
Program& Program::operator=(Program&& other) noexcept = default;
Program::~Program() = default;

Result<Program> Program::build(const Context& /*context*/, const DrawState& state) {
  Result<Object> program = make_program(kMeshVertexShader, mesh_fragment_shader(state).c_str());
  if (!program) return tl::unexpected(program.error());
  auto impl = std::make_unique<Impl>();
  impl->state = state;
  impl->program = *std::move(program);
  if (state.texturing) impl->sampler = make_sampler(*state.texturing);
  return check("making a sampler").map([&] { return Program(std::move(impl)); });
}

Result<void> Program::draw_frame(const Mesh& mesh, const Target& target) const {
  const DrawState& state = impl_->state;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer());
  glViewport(0, 0, target.shape().width, target.shape().height);
  // With the origin at the lower left, window y and the rows that are read back point the same way
  // as NDC y. With the origin at the upper left, both would be upside down.
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthRangef(0, 1);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DITHER);
  glDisable(GL_SCISSOR_TEST);

  constexpr std::array<GLfloat, 4> kClearColor = {0, 0, 0, 0};
  // The depth mask also affects clearing.
  glDepthMask(GL_TRUE);
  glClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 0, kClearColor.data());
  glClearNamedFramebufferfv(target.framebuffer(), GL_DEPTH, 0, &state.clear_depth);
  set_depth_state(state);
  set_blend_state(state.blend);
  if (state.texturing) {
    glBindTextureUnit(0, state.texturing->texture->name());
    glBindSampler(0, impl_->sampler.name());
  }
  glUseProgram(impl_->program.name());
  glBindVertexArray(mesh.impl_->vertex_array.name());
  glDrawElements(GL_TRIANGLES, mesh.impl_->index_count, GL_UNSIGNED_INT, nullptr);
  glFinish();
  return check("drawing a frame");
}

}  // namespace rastercheck::backends::gl::bench
