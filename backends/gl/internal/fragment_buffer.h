#pragma once

// A storage buffer that the fragments of a case are appended to.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/case_program.h"
#include "backends/gl/internal/objects.h"
#include "backends/gl/internal/varyings.h"
#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends::gl {

class FragmentBuffer {
 public:
  /// `has` and `programs`, which outlive it, are those of a context that has_appending.
  FragmentBuffer(const Capabilities& has, CasePrograms& programs);

  /// Words of records that there may be room for.
  std::size_t most_words() const;

  /// Draws triangles of a case, and gives how many fragments they have. Up to `room` of these it
  /// has records of, as Output::records has them.
  Result<std::size_t> draw(const cases::Case& c, std::span<const cases::Triangle> triangles,
                           const Pass& pass, std::size_t room);

  /// The records of the last draw, if there was room for them all.
  std::span<const std::uint32_t> words() const { return words_; }

 private:
  void bind_target(const cases::FramebufferSize& size);

  const Capabilities* has_;
  CasePrograms* programs_;
  Object vertex_array_;
  Object vertices_;
  Object records_;
  Object target_;  ///< without images
  std::size_t bytes_ = 0;
  std::vector<std::uint32_t> words_;
};

}  // namespace rastercheck::backends::gl
