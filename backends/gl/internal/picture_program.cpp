#include "backends/gl/internal/picture_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "backends/gl/internal/case_program.h"

namespace rastercheck::backends::gl {
namespace {

/// An expression, and how it varies.
struct Value {
  std::string text;
  cases::Interpolation interpolation = cases::Interpolation::smooth;
};

/// The expression for an attribute; empty if the pass has no such attribute.
std::optional<Value> attribute_value(const Capabilities& has, const PictureShading& shading,
                                     std::size_t attribute) {
  for (std::size_t i = 0; i < shading.pass.size(); ++i) {
    const Varying& varying = shading.pass[i];
    for (std::size_t k = 0; k < varying.count; ++k) {
      if (varying.attributes[k] != attribute) continue;
      return Value{
          fmt::format("{}[{}]", value_of(has, varying.varies, i, shading.is_multisampled), k),
          varying.varies.interpolation};
    }
  }
  return std::nullopt;
}

/// The expression for a channel: an attribute, its difference across the quad, or what else the
/// shading shows.
std::string channel_of(const Capabilities& has, const PictureShading& shading,
                       std::size_t channel) {
  if (shading.shading == cases::Shading::window_coordinates) {
    return fmt::format("gl_FragCoord[{}]", channel);
  }
  if (shading.shading == cases::Shading::facing) {
    return channel < 3 ? "(gl_FrontFacing ? 1.0 : 0.0)" : "1.0";
  }
  const std::optional<Value> value = attribute_value(has, shading, channel);
  // Colours of three attributes have alpha 1; other channels without attributes are unused.
  if (!value) return shading.shading == cases::Shading::vertex_colors ? "1.0" : "0.0";
  const bool is_along_x = shading.shading == cases::Shading::differences_along_x;
  const bool is_along_y = shading.shading == cases::Shading::differences_along_y;
  if (!is_along_x && !is_along_y) return value->text;
  if (value->interpolation == cases::Interpolation::flat) return "0.0";
  return fmt::format("{}({})", is_along_x ? "dFdxFine" : "dFdyFine", value->text);
}

/// The statement that discards. Derivatives are undefined after it in the fragment's quad, so it
/// comes last.
std::string discarding(const Capabilities& has, const PictureShading& shading) {
  if (!shading.discards) return "";
  const std::string value = shading.is_textured
                                ? "out0.a"
                                : attribute_value(has, shading, shading.discarding_attribute)->text;
  return fmt::format("  if ({} < least_alpha) discard;\n", value);
}

/// Statements that look up the colour `out0`. Without levels, the level of detail is explicit, so
/// that no driver derives it.
std::string lookup(const Capabilities& has, const PictureShading& shading) {
  std::string text = fmt::format("  vec2 place = vec2({}, {});\n", channel_of(has, shading, 0),
                                 channel_of(has, shading, 1));
  text += shading.has_levels ? "  out0 = texture(image, place);\n"
                             : "  out0 = textureLod(image, place, 0.0);\n";
  return text;
}

}  // namespace

std::string picture_fragment_shader(const Capabilities& has, const PictureShading& shading) {
  std::string outside = shader_head(has);
  const bool has_differences = shading.shading == cases::Shading::differences_along_x ||
                               shading.shading == cases::Shading::differences_along_y;
  if (has_differences) outside += "#extension GL_ARB_derivative_control : require\n";
  for (std::size_t i = 0; i < shading.pass.size(); ++i) {
    outside += input_of(shading.pass[i].varies, i);
  }
  if (shading.is_textured) outside += "uniform highp sampler2D image;\n";
  if (shading.discards) outside += "uniform float least_alpha;\n";
  std::string inside;
  for (std::size_t i = 0; 4 * i < shading.channels; ++i) {
    outside += fmt::format("layout(location = {0}) out vec4 out{0};\n", i);
    if (shading.is_textured) continue;
    inside += fmt::format("  out{} = vec4(", i);
    for (std::size_t k = 0; k < 4; ++k) {
      inside += (k == 0 ? "" : ", ") + channel_of(has, shading, 4 * i + k);
    }
    inside += ");\n";
  }
  if (shading.is_textured) inside += lookup(has, shading);
  inside += discarding(has, shading);
  return outside + "void main() {\n" + inside + "}\n";
}

Result<PictureProgram> PicturePrograms::get(const PictureShading& shading) {
  // There are more shadings than programs that are worth keeping.
  constexpr std::size_t kMostKept = 64;
  std::vector<VaryingClass> varyings;
  for (const Varying& varying : shading.pass) varyings.push_back(varying.varies);
  const std::string vertices = case_vertex_shader(*has_, varyings, shading.is_of_points);
  const std::string fragments = picture_fragment_shader(*has_, shading);
  std::string source = vertices + fragments;
  auto found = made_.find(source);
  if (found == made_.end()) {
    Result<Object> made = make_program(vertices.c_str(), fragments.c_str());
    if (!made) return tl::unexpected(made.error());
    if (made_.size() == kMostKept) made_.clear();
    found = made_.emplace(std::move(source), *std::move(made)).first;
  }
  const GLuint name = found->second.name();
  return PictureProgram{name, glGetUniformLocation(name, "image"),
                        glGetUniformLocation(name, "least_alpha")};
}

}  // namespace rastercheck::backends::gl
