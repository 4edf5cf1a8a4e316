#include "reports/internal/case_shaders.h"

#include <fmt/format.h>

#include <algorithm>

namespace rastercheck::reports {
namespace {

constexpr std::size_t kVector = 4;

std::size_t vectors_for(std::size_t numbers) { return (numbers + kVector - 1) / kVector; }

bool is_multisampled(const cases::Case& c) { return c.framebuffer.samples > 1; }

/// True if some attribute is evaluated at each sample, so that each has a fragment of its own.
bool shades_samples(const cases::Case& c) {
  return is_multisampled(c) &&
         std::any_of(c.attributes.begin(), c.attributes.end(), [](const cases::Attribute& a) {
           return a.interpolation != cases::Interpolation::flat &&
                  a.location == cases::Location::sample;
         });
}

std::string qualifiers(const cases::Case& c, const cases::Attribute& attribute) {
  if (attribute.interpolation == cases::Interpolation::flat) return "flat";
  std::string words =
      attribute.interpolation == cases::Interpolation::smooth ? "smooth" : "noperspective";
  if (!is_multisampled(c)) return words;
  if (attribute.location == cases::Location::sample) words += " sample";
  if (attribute.location == cases::Location::centroid) words += " centroid";
  return words;
}

/// With several samples, an input without a location qualifier may be evaluated anywhere in the
/// pixel, so that the centre has to be asked for.
bool asks_for_center(const cases::Case& c, const cases::Attribute& attribute) {
  return is_multisampled(c) && attribute.interpolation != cases::Interpolation::flat &&
         attribute.location == cases::Location::center;
}

std::string layout(std::size_t location, ShaderApi api) {
  return api == ShaderApi::opengl ? "" : fmt::format("layout(location = {}) ", location);
}

std::string head(const cases::Case& c, ShaderApi api, bool is_fragment) {
  if (api != ShaderApi::opengl) return "#version 450\n";
  std::string text = "#version 330 core\n";
  if (is_fragment) text += "#extension GL_ARB_shader_storage_buffer_object : require\n";
  if (is_multisampled(c)) text += "#extension GL_ARB_gpu_shader5 : require\n";
  if (is_fragment && shades_samples(c)) text += "#extension GL_ARB_sample_shading : require\n";
  return text;
}

}  // namespace

std::size_t attribute_vectors(const cases::Case& c) { return vectors_for(c.attributes.size()); }

std::size_t clip_vectors(const cases::Case& c) { return vectors_for(c.clip_distance_count); }

std::vector<float> vertex_numbers(const cases::Case& c, std::size_t vertex) {
  const cases::ClipVertex& p = c.positions[vertex];
  std::vector<float> numbers{p.x, p.y, p.z, p.w};
  const auto attributes = c.attributes_of(vertex);
  numbers.insert(numbers.end(), attributes.begin(), attributes.end());
  numbers.resize(kVector * (1 + attribute_vectors(c)), 0);
  const auto distances = c.clip_distances_of(vertex);
  numbers.insert(numbers.end(), distances.begin(), distances.end());
  numbers.resize(kVector * (1 + attribute_vectors(c) + clip_vectors(c)), 1);
  return numbers;
}

std::string vertex_shader(const cases::Case& c, ShaderApi api) {
  std::string outside = head(c, api, false) + layout(0, api) + "in vec4 position;\n";
  std::string inside = "  gl_Position = position;\n";
  std::size_t location = 1;
  for (std::size_t i = 0; i < attribute_vectors(c); ++i) {
    outside += fmt::format("{}in vec4 attributes{};\n", layout(location++, api), i);
  }
  for (std::size_t i = 0; i < clip_vectors(c); ++i) {
    outside += fmt::format("{}in vec4 distances{};\n", layout(location++, api), i);
  }
  for (std::size_t i = 0; i < c.attributes.size(); ++i) {
    outside +=
        fmt::format("{}{} out float value{};\n", layout(i, api), qualifiers(c, c.attributes[i]), i);
    inside += fmt::format("  value{} = attributes{}[{}];\n", i, i / kVector, i % kVector);
  }
  if (c.clip_distance_count > 0) {
    outside += fmt::format("out float gl_ClipDistance[{}];\n", c.clip_distance_count);
  }
  for (std::size_t i = 0; i < c.clip_distance_count; ++i) {
    inside +=
        fmt::format("  gl_ClipDistance[{}] = distances{}[{}];\n", i, i / kVector, i % kVector);
  }
  return outside + "void main() {\n" + inside + "}\n";
}

std::string fragment_shader(const cases::Case& c, const RecordedPart& part, ShaderApi api) {
  const bool has_floats = api == ShaderApi::vulkan_floats;
  const auto word = [&](const std::string& value) {
    return has_floats ? value : "floatBitsToUint(" + value + ")";
  };
  std::string outside = head(c, api, true);
  std::string values;
  for (std::size_t i = 0; i < c.attributes.size(); ++i) {
    outside +=
        fmt::format("{}{} in float value{};\n", layout(i, api), qualifiers(c, c.attributes[i]), i);
    const std::string value = fmt::format("value{}", i);
    const bool asks = asks_for_center(c, c.attributes[i]);
    if (has_floats)
      values += fmt::format("  if (isnan({})) atomicAdd(counts[index], 99u);\n", value);
    values += fmt::format("  words[at + {}] = {};\n", kRecordHead + i,
                          word(asks ? "interpolateAtOffset(" + value + ", vec2(0))" : value));
  }
  outside += api == ShaderApi::opengl ? "layout(std430) " : "layout(std430, set = 0, binding = 0) ";
  outside += fmt::format("buffer Records {{ {} words[]; }};\n", has_floats ? "float" : "uint");
  if (has_floats) {
    outside += "layout(std430, set = 0, binding = 1) buffer Counts { uint counts[]; };\n";
  }
  outside += fmt::format(
      "void record(int sample_number) {{\n"
      "  ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2({}, {});\n"
      "  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2({}, {})))) "
      "return;\n"
      "  int index = (pixel.y * {} + pixel.x) * {} + sample_number;\n"
      "  int at = index * {};\n"
      "  atomicAdd({}, 1u);\n"
      "  words[at + 1] = {};\n"
      "{}}}\n",
      part.left, part.top, part.width, part.height, part.width, c.framebuffer.samples,
      record_size(c), has_floats ? "counts[index]" : "words[at]", word("gl_FragCoord.z"), values);
  std::string main = "  record(0);\n";
  if (shades_samples(c)) {
    main = "  record(gl_SampleID);\n";
  } else if (is_multisampled(c)) {
    main = fmt::format(
        "  for (int i = 0; i < {}; ++i) {{\n"
        "    if ((gl_SampleMaskIn[0] >> i & 1) != 0) record(i);\n"
        "  }}\n",
        c.framebuffer.samples);
  }
  return outside + "void main() {\n" + main + "}\n";
}

std::size_t record_size(const cases::Case& c) { return kRecordHead + c.attributes.size(); }

std::size_t record_at(const cases::Case& c, const RecordedPart& part, std::uint32_t x,
                      std::uint32_t y, std::uint32_t sample) {
  const std::size_t pixel = std::size_t{y - part.top} * part.width + (x - part.left);
  return (pixel * static_cast<std::size_t>(c.framebuffer.samples) + sample) * record_size(c);
}

bool records_depth(const cases::Case& c) { return !is_multisampled(c) && !c.depth_clamp; }

}  // namespace rastercheck::reports
