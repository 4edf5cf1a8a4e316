#include "backends/gl/internal/fragment_buffer.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "backends/appended_drawing.h"
#include "backends/gl/internal/case_state.h"

namespace rastercheck::backends::gl {
namespace {

/// The most bytes of records that are read back at once.
constexpr std::size_t kMostBytes = std::size_t{64} << 20U;
constexpr std::size_t kWord = sizeof(std::uint32_t);

}  // namespace

FragmentBuffer::FragmentBuffer(const Capabilities& has, CasePrograms& programs)
    : has_(&has),
      programs_(&programs),
      vertex_array_(generate_vertex_array()),
      vertices_(generate_buffer()),
      indices_(generate_buffer()),
      records_(generate_buffer()),
      target_(generate_framebuffer()) {}

std::size_t FragmentBuffer::most_words() const {
  return std::min(has_->max_storage, kMostBytes) / kWord - 1;
}

void FragmentBuffer::bind_target(const cases::FramebufferSize& size) {
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH, size.width);
  glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT, size.height);
}

Result<std::size_t> FragmentBuffer::draw(const cases::Case& c,
                                         std::span<const cases::Triangle> triangles,
                                         const Pass& pass, std::size_t room) {
  const Result<GLuint> program = programs_->get(c, pass, Output::records);
  if (!program) return tl::unexpected(program.error());
  hand_over_vertices(*has_, pass, vertices_of(*has_, c, triangles, pass), vertex_array_.name(),
                     vertices_.name());
  return append(c, *program, kRecordHead + 4 * pass.size(), room,
                [&] { draw_primitives(c, 0, triangles.size()); });
}

Result<std::size_t> FragmentBuffer::draw(const cases::Case& c, const IndexedDraw& indexed,
                                         const Pass& pass, std::size_t room) {
  const Result<GLuint> program = programs_->get(c, pass, Output::records);
  if (!program) return tl::unexpected(program.error());
  hand_over_vertices(*has_, pass, vertices_of(*has_, c, indexed, pass), vertex_array_.name(),
                     vertices_.name());
  return append(c, *program, kRecordHead + 4 * pass.size(), room,
                [&] { draw_indices(*has_, c, indexed, indices_.name()); });
}

template <typename Draw>
Result<std::size_t> FragmentBuffer::append(const cases::Case& c, GLuint program,
                                           std::size_t words_of_record, std::size_t room,
                                           const Draw& draw) {
  const std::size_t bytes = (1 + room * words_of_record) * kWord;
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, records_.name());
  if (bytes > bytes_) {
    glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr,
                 GL_DYNAMIC_READ);
    bytes_ = bytes;
  }
  constexpr std::uint32_t kNone = 0;
  glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, kWord, &kNone);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, records_.name());

  bind_target(c.framebuffer);
  use_program(program, c);
  glUniform1ui(glGetUniformLocation(program, "room"), static_cast<GLuint>(room));
  set_case_state(*has_, c);
  // A depth test that runs before the shader would discard fragments.
  glDisable(GL_DEPTH_TEST);
  set_scissor(c);
  draw();
  reset_case_state(*has_);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::uint32_t count = 0;
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, kWord, &count);
  if (count <= room) {
    words_.resize(count * words_of_record);
    glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, kWord,
                       static_cast<GLsizeiptr>(words_.size() * kWord), words_.data());
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  const Result<void> done = check("appending fragments");
  if (!done) {
    bytes_ = 0;  // memory may have run out
    return tl::unexpected(done.error());
  }
  return std::size_t{count};
}

}  // namespace rastercheck::backends::gl
