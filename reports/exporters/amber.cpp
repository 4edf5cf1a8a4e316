// amber: a script for Amber, Google's runner of Vulkan tests, with the same records and comparisons
// as a shader_test. Written after Amber's documentation; no Amber has run one.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/json.h"
#include "reports/exporter.h"
#include "reports/internal/case_shaders.h"
#include "reports/internal/sample_tests.h"

namespace rastercheck::reports::amber_exporter {
namespace {

/// The reason why no script can draw the case; empty if one can.
std::string why_not_said(const records::Exhibit& exhibit) {
  const cases::Case& c = exhibit.source;
  if (const std::string why = why_not_drawn(exhibit); !why.empty()) return why;
  if (c.rules != cases::Rules::vulkan) return "it is not drawn by Vulkan's rules";
  if (c.framebuffer.samples > 1) return "it has several samples";
  if (c.scissor) return "Amber has no scissor";
  if (c.cull != cases::Cull::none) return "Amber does not cull";
  if (c.viewport.width < 0) return "its viewport has a negative width";
  return "";
}

/// A float32 as Amber reads it back: it takes a number without a point for an integer.
std::string number(float value) { return fmt::format("{:.9e}", value); }

/// One buffer for each vector of a vertex: [triangle][corner][4].
std::string vertex_buffers(const cases::Case& c, std::size_t vectors) {
  std::string text;
  for (std::size_t i = 0; i < vectors; ++i) {
    text += fmt::format("BUFFER vertices{} DATA_TYPE vec4<float> DATA\n", i);
    for (const cases::Triangle& triangle : c.triangles) {
      for (const std::uint32_t vertex : triangle) {
        const std::vector<float> numbers = vertex_numbers(c, vertex);
        text += fmt::format("{} {} {} {}\n", number(numbers[4 * i]), number(numbers[4 * i + 1]),
                            number(numbers[4 * i + 2]), number(numbers[4 * i + 3]));
      }
    }
    text += "END\n";
  }
  return text;
}

/// Where a value's word stands in the records.
std::size_t word_of(const records::JudgedPlace& judged, const records::PermittedValue& value,
                    const cases::Case& c, const RecordedPart& part) {
  return record_at(c, part, judged.place.x, judged.place.y, 0) +
         (value.attribute ? kRecordHead + *value.attribute : 1);
}

/// The records before a triangle is drawn: 0, but permitted values at samples that may be left out.
std::string first_records(std::span<const records::JudgedPlace> places, const cases::Case& c,
                          const RecordedPart& part) {
  std::vector<std::string> words(record_size(c) * part.width * part.height, number(0));
  for (const records::JudgedPlace& judged : places) {
    if (judged.verdict != records::Verdict::permitted) continue;
    for (const records::PermittedValue& value : judged.values) {
      words[word_of(judged, value, c, part)] =
          number(std::clamp(0.0F, value.numbers.least, value.numbers.greatest));
    }
  }
  return fmt::format(
      "BUFFER records{0} DATA_TYPE float DATA\n{1}\nEND\n"
      "BUFFER counts{0} DATA_TYPE uint32 SIZE {2} FILL 0\n",
      places.front().place.triangle, fmt::join(words, " "), part.width * part.height);
}

/// A pipeline for each triangle, with records of its own.
std::string pipeline(const cases::Case& c, std::uint32_t triangle, std::size_t vectors) {
  const cases::Viewport& v = c.viewport;
  std::string text = fmt::format(
      "PIPELINE graphics pipeline{0}\n"
      "  ATTACH vertex_shader\n  ATTACH fragment_shader\n"
      "  FRAMEBUFFER_SIZE {1} {2}\n"
      "  VIEWPORT {3} {4} SIZE {5} {6} MIN_DEPTH {7} MAX_DEPTH {8}\n"
      "  BIND BUFFER target AS color LOCATION 0\n"
      "  BIND BUFFER records{0} AS storage DESCRIPTOR_SET 0 BINDING 0\n"
      "  BIND BUFFER counts{0} AS storage DESCRIPTOR_SET 0 BINDING 1\n",
      triangle, c.framebuffer.width, c.framebuffer.height, number(v.x), number(v.y),
      number(v.width), number(v.height), number(v.min_depth), number(v.max_depth));
  for (std::size_t i = 0; i < vectors; ++i) {
    text += fmt::format("  VERTEX_DATA vertices{0} LOCATION {0}\n", i);
  }
  if (c.depth_clamp) text += "  DEPTH\n    CLAMP on\n  END\n";
  return text +
         fmt::format("END\nRUN pipeline{0} DRAW_ARRAY AS TRIANGLE_LIST START_IDX {1} COUNT 3\n",
                     triangle, 3 * triangle);
}

/// The lines that compare a record with what is permitted.
std::string expectations(const records::JudgedPlace& judged, const cases::Case& c,
                         const RecordedPart& part) {
  const std::uint32_t triangle = judged.place.triangle;
  const std::size_t record = record_at(c, part, judged.place.x, judged.place.y, 0);
  std::string text = fmt::format("# {}\nEXPECT counts{} IDX {} {} {}\n", place_text(judged, c),
                                 triangle, sizeof(std::uint32_t) * (record / record_size(c)),
                                 judged.verdict == records::Verdict::permitted ? "LE" : "EQ",
                                 judged.verdict == records::Verdict::forbidden ? 0 : 1);
  const auto expect = [&](std::size_t word, std::string_view comparator, float value) {
    if (!std::isfinite(value)) return;
    text += fmt::format("EXPECT records{} IDX {} {} {}\n", triangle, sizeof(float) * word,
                        comparator, number(value));
  };
  for (const records::PermittedValue& value : judged.values) {
    text += fmt::format("# {}\n",
                        value.attribute
                            ? "attribute " + cases::one_line(c.attributes[*value.attribute].name)
                            : "depth");
    const std::size_t word = word_of(judged, value, c, part);
    expect(word, "GE", value.numbers.least);
    expect(word, "LE", value.numbers.greatest);
  }
  return text;
}

Result<std::string> write(const records::Exhibit& exhibit) {
  const auto refuse = [&](std::string_view what) {
    return tl::unexpected(Error{exhibit.file, "", fmt::format("amber cannot say it: {}", what)});
  };
  const cases::Case& c = exhibit.source;
  if (const std::string why = why_not_said(exhibit); !why.empty()) return refuse(why);
  const std::vector<records::JudgedPlace> places =
      tested_places(exhibit, records_depth(exhibit.source));
  if (const auto why = why_not_shown(exhibit, places)) return refuse(*why);
  if (places.empty()) return refuse("nothing is promised");
  const RecordedPart part = part_of(exhibit);
  const std::size_t vectors = 1 + attribute_vectors(c) + clip_vectors(c);
  std::string text = "#!amber\n";
  for (const std::string& line : test_heading(exhibit)) text += fmt::format("# {}\n", line);
  text +=
      "# Written after Amber's documentation, and not tried with Amber.\n\n"
      "DEVICE_FEATURE fragmentStoresAndAtomics\n";
  if (c.clip_distance_count > 0) text += "DEVICE_FEATURE shaderClipDistance\n";
  if (c.depth_clamp) text += "DEVICE_FEATURE depthClamp\n";
  text += fmt::format("\nSHADER vertex vertex_shader GLSL\n{}END\n",
                      vertex_shader(c, ShaderApi::vulkan_floats));
  text += fmt::format("\nSHADER fragment fragment_shader GLSL\n{}END\n\n",
                      fragment_shader(c, part, ShaderApi::vulkan_floats));
  text += "BUFFER target FORMAT R8G8B8A8_UNORM\n" + vertex_buffers(c, vectors);
  for (const auto& of_triangle : by_triangle(places)) {
    text += "\n" + first_records(of_triangle, c, part);
    text += pipeline(c, of_triangle.front().place.triangle, vectors);
    for (const records::JudgedPlace& judged : of_triangle) text += expectations(judged, c, part);
  }
  return text;
}

const ExporterRegistration kRegistration({"amber",
                                          "a script for Amber, which has not been tried with it",
                                          &write});

}  // namespace
}  // namespace rastercheck::reports::amber_exporter
