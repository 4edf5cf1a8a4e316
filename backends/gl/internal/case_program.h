#pragma once

#include <map>
#include <vector>

#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/objects.h"
#include "backends/gl/internal/varyings.h"
#include "cases/error.h"

namespace rastercheck::backends::gl {

/// Colour target 0 of these programs has the triangle's number, from 1, in the draw; target 1 + i
/// the values of varying i. Vertex input 0 is the clip position, 1 + i varying i, and those after
/// them the clip distances, four each. Vertices come in threes, a triangle after the other.
class CasePrograms {
 public:
  /// `has` must outlive it.
  explicit CasePrograms(const Capabilities& has) : has_(&has) {}

  /// The one for a pass, made where it is asked for first. Fails where it does not compile.
  Result<GLuint> get(const Pass& pass, bool is_multisampled);

 private:
  struct Key {
    std::vector<VaryingClass> varyings;
    bool is_multisampled = false;
    auto operator<=>(const Key&) const = default;
  };

  const Capabilities* has_;
  std::map<Key, Object> made_;
};

/// "#version …" and what else a shader begins with.
std::string shader_head(const Capabilities& has);

}  // namespace rastercheck::backends::gl
