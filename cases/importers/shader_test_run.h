#pragma once

// Runs the vertex shader of a piglit test for one vertex, on numbers. It may compute with vertex
// attributes and constants by + - * /, choose components, and multiply by the projection at the
// end. A value that comes from anything else has a Refusal in its place, and only those who ask for
// the value get it. So a texture coordinate that is computed by a function refuses a test only if
// the coordinate is wanted.

#include <array>
#include <map>
#include <string>

#include "cases/importers/shader_test_shader.h"

namespace rastercheck::cases::shader_test_importer {

/// A scalar or vector.
struct Value {
  std::array<float, 4> numbers{};
  int count = 1;
  unsigned defined = 0;       ///< bit i: component i was assigned
  bool is_integer = false;    ///< a literal such as 1, whose division is another one
  bool is_rounded = false;    ///< some operation was not exact
  bool is_projected = false;  ///< to be multiplied by the projection
};

/// Values of vertex attributes by name, or by the slot as text.
using Inputs = std::map<std::string, std::array<float, 4>, std::less<>>;

/// What main() of a vertex shader assigned for one vertex.
class VertexRun {
 public:
  /// With a projection, values multiplied by it are marked and cannot be computed with further.
  VertexRun(const Shader& shader, const Inputs& inputs, bool has_projection);

  bool is_assigned(const std::string& name) const;
  /// The value of a variable ("color") or of an array's element ("gl_ClipDistance[1]").
  Expected<Value> value(const std::string& name) const;

 private:
  friend class Interpreter;
  std::map<std::string, Value, std::less<>> values_;
  std::map<std::string, Refusal, std::less<>> refused_;  ///< by name, without an index
};

}  // namespace rastercheck::cases::shader_test_importer
