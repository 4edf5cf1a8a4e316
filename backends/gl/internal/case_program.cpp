#include "backends/gl/internal/case_program.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "backends/appended_drawing.h"

namespace rastercheck::backends::gl {
namespace {

std::string qualifiers(const VaryingClass& varies) {
  if (varies.interpolation == cases::Interpolation::flat) return "flat";
  std::string words =
      varies.interpolation == cases::Interpolation::smooth ? "smooth" : "noperspective";
  if (varies.location == cases::Location::sample) words += " sample";
  if (varies.location == cases::Location::centroid) words += " centroid";
  return words;
}

/// A fragment shader that appends a record of each fragment. It writes nothing else, because some
/// of Mesa's drivers lose records of fragments that also write colours.
std::string appending_shader(const Capabilities& has, const std::vector<VaryingClass>& varyings) {
  std::string outside = shader_head(has) +
                        "#extension GL_ARB_shader_storage_buffer_object : require\n"
                        "flat in float number;\nuniform uint room;\n"
                        "layout(std430) buffer Records { uint count; uint words[]; };\n";
  std::string inside = fmt::format(
      "  uint at = atomicAdd(count, 1u);\n  if (at >= room) return;\n  at *= {}u;\n"
      "  words[at] = floatBitsToUint(number);\n"
      "  words[at + 1u] = uint(gl_FragCoord.x) | uint(gl_FragCoord.y) << 16u;\n"
      "  words[at + 2u] = floatBitsToUint(gl_FragCoord.z);\n",
      kRecordHead + 4 * varyings.size());
  for (std::size_t i = 0; i < varyings.size(); ++i) {
    outside += input_of(varyings[i], i);
    for (std::size_t k = 0; k < 4; ++k) {
      inside += fmt::format("  words[at + {}u] = floatBitsToUint(value{}[{}]);\n",
                            kRecordHead + 4 * i + k, i, k);
    }
  }
  return outside + "void main() {\n" + inside + "}\n";
}

/// True if the shader must request the centre: with several samples, an input without a location
/// qualifier may be interpolated anywhere in the pixel.
bool asks_for_centre(const VaryingClass& varies, bool is_multisampled) {
  return is_multisampled && varies.interpolation != cases::Interpolation::flat &&
         varies.location == cases::Location::center;
}

std::string fragment_shader(const Capabilities& has, const std::vector<VaryingClass>& varyings,
                            bool is_multisampled) {
  std::string outside =
      shader_head(has) + "flat in float number;\nlayout(location = 0) out float number_out;\n";
  std::string inside = "  number_out = number;\n";
  for (std::size_t i = 0; i < varyings.size(); ++i) {
    outside +=
        input_of(varyings[i], i) + fmt::format("layout(location = {}) out vec4 out{};\n", i + 1, i);
    inside += fmt::format("  out{} = {};\n", i, value_of(has, varyings[i], i, is_multisampled));
  }
  return outside + "void main() {\n" + inside + "}\n";
}

}  // namespace

std::string shader_head(const Capabilities& has) {
  if (!has.is_es) {
    const bool is_extended = has.has_sample_qualifier && has.version < 40;
    return fmt::format("#version {} core\n{}", has.version >= 40 ? 400 : 330,
                       is_extended ? "#extension GL_ARB_gpu_shader5 : require\n" : "");
  }
  std::string head = has.version >= 32 ? "#version 320 es\n" : "#version 300 es\n";
  if (has.max_clip_distances > 0) head += "#extension GL_EXT_clip_cull_distance : require\n";
  if (has.has_noperspective) {
    head += "#extension GL_NV_shader_noperspective_interpolation : require\n";
  }
  head += "precision highp float;\nprecision highp int;\nprecision highp sampler2DArray;\n";
  if (has.has_sample_targets) head += "precision highp sampler2DMSArray;\n";
  return head;
}

std::string case_vertex_shader(const Capabilities& has, const std::vector<VaryingClass>& varyings,
                               bool is_of_points) {
  const std::size_t clip_vectors = has.clip_vectors();
  std::string outside = shader_head(has) + "layout(location = 0) in vec4 position;\n";
  std::string inside = "  gl_Position = position;\n  number = number_in;\n";
  outside += "flat out float number;\n";
  if (is_of_points) {
    outside += "uniform float point_size;\n";
    inside += "  gl_PointSize = point_size;\n";
  }
  for (std::size_t i = 0; i < varyings.size(); ++i) {
    outside += fmt::format("layout(location = {}) in vec4 in{};\n{} out vec4 value{};\n", i + 1, i,
                           qualifiers(varyings[i]), i);
    inside += fmt::format("  value{0} = in{0};\n", i);
  }
  if (clip_vectors > 0)
    outside += fmt::format("out float gl_ClipDistance[{}];\n", 4 * clip_vectors);
  for (std::size_t i = 0; i < clip_vectors; ++i) {
    outside +=
        fmt::format("layout(location = {}) in vec4 distances{};\n", varyings.size() + 1 + i, i);
    for (std::size_t k = 0; k < 4; ++k) {
      inside += fmt::format("  gl_ClipDistance[{}] = distances{}[{}];\n", 4 * i + k, i, k);
    }
  }
  outside += fmt::format("layout(location = {}) in float number_in;\n",
                         varyings.size() + 1 + clip_vectors);
  return outside + "void main() {\n" + inside + "}\n";
}

std::string input_of(const VaryingClass& varies, std::size_t i) {
  return fmt::format("{} in vec4 value{};\n", qualifiers(varies), i);
}

std::string value_of(const Capabilities& has, const VaryingClass& varies, std::size_t i,
                     bool is_multisampled) {
  const bool asks = asks_for_centre(varies, is_multisampled) && has.has_sample_qualifier;
  return asks ? fmt::format("interpolateAtOffset(value{}, vec2(0))", i) : fmt::format("value{}", i);
}

Result<GLuint> CasePrograms::get(const cases::Case& c, const Pass& pass, Output output) {
  const bool is_multisampled = c.framebuffer.samples > 1;
  Key key{{}, is_multisampled, c.primitive == cases::Primitive::points, output};
  for (const Varying& varying : pass) key.varyings.push_back(varying.varies);
  if (const auto found = made_.find(key); found != made_.end()) return found->second.name();
  const std::string fragments = output == Output::colors
                                    ? fragment_shader(*has_, key.varyings, is_multisampled)
                                    : appending_shader(*has_, key.varyings);
  Result<Object> program = make_program(
      case_vertex_shader(*has_, key.varyings, key.is_of_points).c_str(), fragments.c_str());
  if (!program) return tl::unexpected(program.error());
  const GLuint name = program->name();
  made_.emplace(std::move(key), *std::move(program));
  return name;
}

}  // namespace rastercheck::backends::gl
