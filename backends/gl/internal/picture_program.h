#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/objects.h"
#include "backends/gl/internal/varyings.h"
#include "cases/error.h"
#include "cases/picture.h"

namespace rastercheck::backends::gl {

/// Everything that the shaders of a picture depend on.
struct PictureShading {
  Pass pass;
  cases::Shading shading = cases::Shading::attributes;
  bool is_textured = false;
  bool has_levels = false;  ///< the texture is filtered trilinearly
  bool discards = false;
  /// The attribute that discarding depends on, if there is no texture.
  std::size_t discarding_attribute = 0;
  bool is_multisampled = false;
  bool is_of_points = false;
  std::size_t channels = 0;
};

/// A program that draws pictures. Its vertex inputs are those of CasePrograms. Colour target i
/// receives channels 4 i to 4 i + 3.
struct PictureProgram {
  GLuint name = 0;
  GLint image = -1;        ///< location of the uniform with the texture's unit
  GLint least_alpha = -1;  ///< location of the uniform with the least alpha or value that is drawn
};

/// The programs of the most recent pictures.
class PicturePrograms {
 public:
  /// `has` must outlive this object.
  explicit PicturePrograms(const Capabilities& has) : has_(&has) {}

  /// Returns the program, made on first request. Fails if the program does not compile.
  Result<PictureProgram> get(const PictureShading& shading);

 private:
  const Capabilities* has_;
  std::map<std::string, Object> made_;  ///< by the source of both shaders
};

/// The fragment shader. Attributes are numbered as in the pass.
std::string picture_fragment_shader(const Capabilities& has, const PictureShading& shading);

}  // namespace rastercheck::backends::gl
