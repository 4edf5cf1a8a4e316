#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/objects.h"
#include "backends/gl/internal/varyings.h"
#include "cases/error.h"

namespace rastercheck::backends::gl {

/// How a program hands over a triangle's fragments.
enum class Output : std::uint8_t {
  /// Colour target 0 has the triangle's number, target 1 + i the values of varying i.
  colors,
  /// Each fragment appends a record (backends/appended_drawing.h) to storage buffer 0, which counts
  /// them in its first word; varying i's values begin kRecordHead + 4 i words into it. The uniform
  /// `room` is how many there is room for.
  records,
};

/// Programs that draw cases. Vertex input 0 is the clip position, 1 + i varying i, those after them
/// the clip distances, four each, and the last the triangle's number, a float.
class CasePrograms {
 public:
  /// `has` must outlive it.
  explicit CasePrograms(const Capabilities& has) : has_(&has) {}

  /// The one for a pass, made where it is asked for first. Fails where it does not compile.
  Result<GLuint> get(const Pass& pass, bool is_multisampled, Output output = Output::colors);

 private:
  struct Key {
    std::vector<VaryingClass> varyings;
    bool is_multisampled = false;
    Output output = Output::colors;
    auto operator<=>(const Key&) const = default;
  };

  const Capabilities* has_;
  std::map<Key, Object> made_;
};

/// "#version …" and what else a shader begins with.
std::string shader_head(const Capabilities& has);

}  // namespace rastercheck::backends::gl
