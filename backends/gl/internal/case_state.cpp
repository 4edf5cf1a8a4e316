#include "backends/gl/internal/case_state.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "backends/primitive_vertices.h"

namespace rastercheck::backends::gl {
namespace {

/// The distance that is used for clip planes that the case does not have.
constexpr float kInside = 1;

/// The number of four-float vectors per vertex.
std::size_t vectors_of(const Capabilities& has, const Pass& pass) {
  return 1 + pass.size() + has.clip_vectors();
}

void set(GLenum what, bool is_on) { (is_on ? glEnable : glDisable)(what); }

void set_viewport(const Capabilities& has, const cases::Viewport& v) {
  if (has.has_viewport_fractions) {
    glViewportIndexedf(0, v.x, v.y, v.width, v.height);
  } else {
    glViewport(static_cast<GLint>(v.x), static_cast<GLint>(v.y), static_cast<GLsizei>(v.width),
               static_cast<GLsizei>(v.height));
  }
  if (has.is_es) {
    glDepthRangef(v.min_depth, v.max_depth);
  } else {
    glDepthRange(v.min_depth, v.max_depth);
  }
}

/// Whether a triangle is front- or back-facing is defined by how it appears on the display. In
/// Vulkan, window y points down, so the framebuffer is displayed the other way up.
void set_faces(const cases::Case& c) {
  set(GL_CULL_FACE, c.cull != cases::Cull::none);
  glCullFace(c.cull == cases::Cull::front ? GL_FRONT : GL_BACK);
  const bool is_turned = c.rules == cases::Rules::vulkan;
  const bool is_ccw = (c.front_face == cases::FrontFace::ccw) != is_turned;
  glFrontFace(is_ccw ? GL_CCW : GL_CW);
}

/// Vulkan's NDC y and window y both point down, OpenGL's both up. With the origin at the lower
/// left, the formulas and the order of rows that are read back are the same for both.
void set_conventions(const Capabilities& has, const cases::Case& c) {
  const bool is_vulkan = c.rules == cases::Rules::vulkan;
  if (has.has_clip_control && has.is_es) {
    glClipControlEXT(GL_LOWER_LEFT_EXT,
                     is_vulkan ? GL_ZERO_TO_ONE_EXT : GL_NEGATIVE_ONE_TO_ONE_EXT);
  } else if (has.has_clip_control) {
    glClipControl(GL_LOWER_LEFT, is_vulkan ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  }
  if (has.has_provoking_vertex) {
    glProvokingVertex(is_vulkan ? GL_FIRST_VERTEX_CONVENTION : GL_LAST_VERTEX_CONVENTION);
  }
}

/// OpenGL's factor is the slope, its units are the constant.
void set_depth_bias(const Capabilities& has, const cases::DepthBias& bias) {
  set(GL_POLYGON_OFFSET_FILL, !bias.is_none());
  if (bias.is_none()) return;
  if (has.has_bias_clamp) {
    glPolygonOffsetClamp(bias.slope, bias.constant, bias.clamp);
  } else {
    glPolygonOffset(bias.slope, bias.constant);
  }
}

GLenum mode_of(cases::Primitive primitive, cases::Topology topology) {
  const bool is_of_lines = primitive == cases::Primitive::lines;
  if (topology == cases::Topology::strip) return is_of_lines ? GL_LINE_STRIP : GL_TRIANGLE_STRIP;
  if (topology == cases::Topology::fan) return GL_TRIANGLE_FAN;
  switch (primitive) {
    case cases::Primitive::triangles:
      return GL_TRIANGLES;
    case cases::Primitive::lines:
      return GL_LINES;
    case cases::Primitive::points:
      break;
  }
  return GL_POINTS;
}

/// Sets the width of lines. Points get their size from the program (use_program()).
void set_primitive(const Capabilities& has, const cases::Case& c) {
  if (c.primitive == cases::Primitive::lines) glLineWidth(c.line_width);
  if (c.primitive == cases::Primitive::points && !has.is_es) glEnable(GL_PROGRAM_POINT_SIZE);
}

/// Collects the vertices of a pass, as vertices_of() returns them.
class VertexData {
 public:
  VertexData(const Capabilities& has, const cases::Case& c, const Pass& pass, std::size_t count)
      : has_(&has), case_(&c), pass_(&pass), values_(count * stride()), to_(values_.data()) {}

  /// Adds the next vertex. No more may be added than were announced.
  void add(std::uint32_t vertex, float number) {
    const cases::ClipVertex& p = case_->positions[vertex];
    std::copy_n(std::array{p.x, p.y, p.z, p.w}.data(), 4, to_);
    const auto attributes = case_->attributes_of(vertex);
    for (std::size_t i = 0; i < pass_->size(); ++i) {
      for (std::size_t k = 0; k < (*pass_)[i].count; ++k) {
        to_[4 * (1 + i) + k] = attributes[(*pass_)[i].attributes[k]];
      }
    }
    const auto distances = case_->clip_distances_of(vertex);
    float* const clip = to_ + 4 * (1 + pass_->size());
    std::copy(distances.begin(), distances.end(), clip);
    std::fill(clip + distances.size(), clip + 4 * has_->clip_vectors(), kInside);
    to_[stride() - 1] = number;
    to_ += stride();
  }

  std::vector<float> take() { return std::move(values_); }

 private:
  std::size_t stride() const { return 4 * vectors_of(*has_, *pass_) + 1; }

  const Capabilities* has_;
  const cases::Case* case_;
  const Pass* pass_;
  std::vector<float> values_;
  float* to_;
};

}  // namespace

std::size_t inputs_of(const Capabilities& has, const Pass& pass) {
  return vectors_of(has, pass) + 1;
}

std::vector<float> vertices_of(const Capabilities& has, const cases::Case& c,
                               std::span<const cases::Triangle> triangles, const Pass& pass) {
  VertexData data(has, c, pass, vertices_per(c.primitive) * triangles.size());
  float number = 0;
  for (const cases::Triangle& triangle : triangles) {
    ++number;
    for (const std::uint32_t vertex : backends::vertices_of(c.primitive, triangle)) {
      data.add(vertex, number);
    }
  }
  return data.take();
}

std::vector<float> vertices_of(const Capabilities& has, const cases::Case& c,
                               const IndexedDraw& indexed, const Pass& pass) {
  VertexData data(has, c, pass, indexed.vertices.size());
  for (std::size_t place = 0; place < indexed.vertices.size(); ++place) {
    data.add(indexed.vertices[place], indexed.numbers[place]);
  }
  return data.take();
}

void hand_over_vertices(const Capabilities& has, const Pass& pass, std::span<const float> vertices,
                        GLuint vertex_array, GLuint buffer) {
  glBindVertexArray(vertex_array);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(),
               GL_STREAM_DRAW);
  const auto vectors = static_cast<GLuint>(vectors_of(has, pass));
  const auto stride = static_cast<GLsizei>((4 * vectors + 1) * sizeof(float));
  for (GLuint i = 0; i < kMostInputs; ++i) {
    if (i > vectors) {
      glDisableVertexAttribArray(i);
      continue;
    }
    glEnableVertexAttribArray(i);
    constexpr std::uintptr_t kVector = 4 * sizeof(float);
    // GL expects the offset as a pointer.
    glVertexAttribPointer(i, i < vectors ? 4 : 1, GL_FLOAT, GL_FALSE, stride,
                          std::bit_cast<const void*>(i * kVector));
  }
}

void draw_primitives(const cases::Case& c, std::size_t first, std::size_t count) {
  const std::size_t vertices = vertices_per(c.primitive);
  glDrawArrays(mode_of(c.primitive, cases::Topology::triangles),
               static_cast<GLint>(first * vertices), static_cast<GLsizei>(count * vertices));
}

void draw_indices(const Capabilities& has, const cases::Case& c, const IndexedDraw& indexed,
                  GLuint buffer) {
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(indexed.order.size() * sizeof(std::uint32_t)),
               indexed.order.data(), GL_STREAM_DRAW);
  // Every version that cases are drawn with has one of the two.
  const bool has_fixed = has.version >= 43 || has.is_es;
  const GLenum restart = has_fixed ? GL_PRIMITIVE_RESTART_FIXED_INDEX : GL_PRIMITIVE_RESTART;
  if (!has_fixed) glPrimitiveRestartIndex(cases::kRestart);
  glEnable(restart);
  glDrawElements(mode_of(c.primitive, indexed.topology), static_cast<GLsizei>(indexed.order.size()),
                 GL_UNSIGNED_INT, nullptr);
  glDisable(restart);
}

void use_program(GLuint program, const cases::Case& c) {
  glUseProgram(program);
  if (c.primitive != cases::Primitive::points) return;
  glUniform1f(glGetUniformLocation(program, "point_size"), c.point_size);
}

void set_case_state(const Capabilities& has, const cases::Case& c) {
  set_primitive(has, c);
  set_conventions(has, c);
  set_viewport(has, c.viewport);
  set_faces(c);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(c.depth_test == cases::DepthTest::less ? GL_LESS : GL_ALWAYS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_DITHER);
  if (has.has_depth_clamp) set(GL_DEPTH_CLAMP, c.depth_clamp);
  set_depth_bias(has, c.depth_bias);
  for (GLenum i = 0; i < static_cast<GLenum>(has.max_clip_distances); ++i) {
    set(GL_CLIP_DISTANCE0 + i, c.clip_distance_count > 0);
  }
}

void set_scissor(const cases::Case& c) {
  set(GL_SCISSOR_TEST, c.scissor.has_value());
  if (c.scissor) glScissor(c.scissor->x, c.scissor->y, c.scissor->width, c.scissor->height);
}

void reset_case_state(const Capabilities& has) {
  glDisable(GL_SCISSOR_TEST);
  for (GLenum i = 0; i < static_cast<GLenum>(has.max_clip_distances); ++i) {
    glDisable(GL_CLIP_DISTANCE0 + i);
  }
  if (has.has_depth_clamp) glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

}  // namespace rastercheck::backends::gl
