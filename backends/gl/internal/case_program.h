#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/objects.h"
#include "backends/gl/internal/varyings.h"
#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends::gl {

/// How a program outputs the fragments of a triangle.
enum class Output : std::uint8_t {
  /// Colour target 0 receives the triangle's number, target 1 + i the values of varying i.
  colors,
  /// Each fragment appends a record (backends/appended_drawing.h) to storage buffer 0, whose first
  /// word counts the records. The values of varying i begin at word kRecordHead + 4 i of a record.
  /// The uniform `room` is the number of records that fit.
  records,
};

/// Programs that draw cases. Vertex input 0 is the clip position and input 1 + i is varying i. Then
/// follow the clip distances, four per input, and last the triangle's number, a float.
class CasePrograms {
 public:
  /// `has` must outlive this object.
  explicit CasePrograms(const Capabilities& has) : has_(&has) {}

  /// Returns the program for a pass of a case, made on first request. Fails if the program does not
  /// compile.
  Result<GLuint> get(const cases::Case& c, const Pass& pass, Output output = Output::colors);

 private:
  struct Key {
    std::vector<VaryingClass> varyings;
    bool is_multisampled = false;
    bool is_of_points = false;
    Output output = Output::colors;
    auto operator<=>(const Key&) const = default;
  };

  const Capabilities* has_;
  std::map<Key, Object> made_;
};

/// Returns "#version …" and the other lines at the start of a shader.
std::string shader_head(const Capabilities& has);

/// A vertex shader with the inputs of CasePrograms. It hands on varying i as `value`i, and the
/// number as `number`. With `is_of_points`, the uniform `point_size` is the size of points.
std::string case_vertex_shader(const Capabilities& has, const std::vector<VaryingClass>& varyings,
                               bool is_of_points);

/// The declaration of varying i as a fragment shader's input, and the expression for its value.
std::string input_of(const VaryingClass& varies, std::size_t i);
std::string value_of(const Capabilities& has, const VaryingClass& varies, std::size_t i,
                     bool is_multisampled);

}  // namespace rastercheck::backends::gl
