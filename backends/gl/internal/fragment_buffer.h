#pragma once

// A storage buffer that receives the fragments of a case.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/case_program.h"
#include "backends/gl/internal/objects.h"
#include "backends/gl/internal/varyings.h"
#include "backends/indexed_draw.h"
#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends::gl {

class FragmentBuffer {
 public:
  /// `has` and `programs` must belong to a context with `has.has_appending`, and must outlive the
  /// buffer.
  FragmentBuffer(const Capabilities& has, CasePrograms& programs);

  /// The most words of records that the buffer can hold.
  std::size_t most_words() const;

  /// Draws triangles of a case and returns how many fragments they have. Keeps up to `room`
  /// records, in the layout of Output::records.
  Result<std::size_t> draw(const cases::Case& c, std::span<const cases::Triangle> triangles,
                           const Pass& pass, std::size_t room);
  /// Likewise, a draw of indices.
  Result<std::size_t> draw(const cases::Case& c, const IndexedDraw& indexed, const Pass& pass,
                           std::size_t room);

  /// The records of the last draw, if all of them fitted into the buffer.
  std::span<const std::uint32_t> words() const { return words_; }

 private:
  void bind_target(const cases::FramebufferSize& size);
  /// Calls `draw()`, which draws the vertices handed over, and reads the records.
  template <typename Draw>
  Result<std::size_t> append(const cases::Case& c, GLuint program, std::size_t words_of_record,
                             std::size_t room, const Draw& draw);

  const Capabilities* has_;
  CasePrograms* programs_;
  Object vertex_array_;
  Object vertices_;
  Object indices_;
  Object records_;
  Object target_;  ///< a framebuffer without images
  std::size_t bytes_ = 0;
  std::vector<std::uint32_t> words_;
};

}  // namespace rastercheck::backends::gl
