// c: a program in one C file that draws the case through OpenGL or Vulkan and prints what is wrong,
// to be attached to a bug report. The code is the same for all cases (reports/exporters/programs/);
// before it stand the case, its shaders and what must be drawn.

#include <fmt/format.h>

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "cases/json.h"
#include "cases/sample_pattern.h"
#include "reports/exporter.h"
#include "reports/exporters/programs.h"
#include "reports/internal/case_shaders.h"
#include "reports/internal/sample_tests.h"

namespace rastercheck::reports::c_exporter {
namespace {

constexpr std::string_view kOpenglHead =
    "/* cc -o case case.c -lEGL -lOpenGL && ./case\n"
    "   Mesa's drivers are chosen by GALLIUM_DRIVER=llvmpipe LIBGL_ALWAYS_SOFTWARE=1. */\n"
    "#include <stdint.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n\n"
    "#include <EGL/egl.h>\n#include <EGL/eglext.h>\n"
    "#define GL_GLEXT_PROTOTYPES\n#include <GL/glcorearb.h>\n\n";
constexpr std::string_view kVulkanHead =
    "/* cc -o case case.c -lvulkan && ./case [part of the device's name]\n"
    "   Has glslangValidator compile its shaders, in this folder. */\n"
    "#include <stdint.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n\n"
    "#include <unistd.h>\n\n#include <vulkan/vulkan.h>\n\n";

/// A text within a comment: one line that ends no comment.
std::string comment_text(std::string_view text) {
  std::string line = cases::one_line(text);
  for (std::size_t at = line.find("*/"); at != std::string::npos; at = line.find("*/", at)) {
    line.insert(at + 1, " ");
  }
  return line;
}

/// A C string of one line: what is not printable ASCII becomes '?', so that no compiler asks for
/// its encoding.
std::string quoted(std::string_view text) {
  std::string literal = "\"";
  for (const char c : text) {
    const bool is_printable = c >= ' ' && c <= '~';
    // "??" would begin a trigraph.
    if (c == '"' || c == '\\' || c == '?' || !is_printable) literal += '\\';
    literal += is_printable ? c : '?';
  }
  return literal + '"';
}

/// A C string, a line of the text on each line. The text is ours.
std::string quoted_lines(std::string_view text) {
  std::string literal;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    literal += fmt::format("\n    \"{}\\n\"", text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return literal;
}

/// A float32 as C reads it without rounding.
std::string number(float value) {
  if (value == std::numeric_limits<float>::infinity()) return "HUGE_VALF";
  if (value == -std::numeric_limits<float>::infinity()) return "-HUGE_VALF";
  return fmt::format("{:a}F", value);
}

struct Program {
  const records::Exhibit* exhibit;
  const cases::Case* c;
  ShaderApi api;
  RecordedPart part;
  std::vector<records::JudgedPlace> places;
};

std::string sizes(const Program& program) {
  const cases::Case& c = *program.c;
  const auto samples = static_cast<std::size_t>(c.framebuffer.samples);
  std::string text = "enum {\n";
  const auto define = [&](std::string_view name, auto value) {
    text += fmt::format("  {} = {},\n", name, value);
  };
  define("WIDTH", c.framebuffer.width);
  define("HEIGHT", c.framebuffer.height);
  define("SAMPLES", samples);
  define("VECTORS", 1 + attribute_vectors(c) + clip_vectors(c));
  define("ATTRIBUTES", c.attributes.size());
  define("CLIP_DISTANCES", c.clip_distance_count);
  define("SUBPIXEL_BITS", program.exhibit->subpixel_bits.value_or(0));
  define("FIRST_TRIANGLE", program.places.front().place.triangle);
  define("END_TRIANGLE", program.places.back().place.triangle + 1);
  define("RECORDS", record_size(c) * program.part.width * program.part.height * samples);
  define("HAS_SCISSOR", c.scissor ? 1 : 0);
  define("CULLS_BACK", c.cull == cases::Cull::back ? 1 : 0);
  define("CULLS_FRONT", c.cull == cases::Cull::front ? 1 : 0);
  define("IS_FRONT_CCW", c.front_face == cases::FrontFace::ccw ? 1 : 0);
  define("CLAMPS_DEPTH", c.depth_clamp ? 1 : 0);
  return text + "};\n";
}

std::string state(const Program& program) {
  const cases::Case& c = *program.c;
  const cases::Viewport& v = c.viewport;
  const cases::Scissor scissor =
      c.scissor.value_or(cases::Scissor{0, 0, c.framebuffer.width, c.framebuffer.height});
  std::string text = fmt::format(
      "/* x, y, width, height, depths */\nstatic const float viewport[] = {{{}, {}, {}, {}, {}, "
      "{}}};\n",
      number(v.x), number(v.y), number(v.width), number(v.height), number(v.min_depth),
      number(v.max_depth));
  text += fmt::format("static const int scissor[] = {{{}, {}, {}, {}}};\n", scissor.x, scissor.y,
                      scissor.width, scissor.height);
  if (program.api == ShaderApi::vulkan) return text;
  // Vulkan has these positions by definition, and locations instead of names.
  text += "/* in sixteenths of a pixel */\nstatic const float positions[][2] = {";
  for (const cases::SamplePosition& p : cases::standard_pattern(c.framebuffer.samples)) {
    text += fmt::format("{{{}, {}}}, ", p.x, p.y);
  }
  text += "};\nstatic const char *const inputs[] = {\"position\"";
  for (std::size_t i = 0; i < attribute_vectors(c); ++i)
    text += fmt::format(", \"attributes{}\"", i);
  for (std::size_t i = 0; i < clip_vectors(c); ++i) text += fmt::format(", \"distances{}\"", i);
  return text + "};\n";
}

std::string vertices(const cases::Case& c) {
  std::string text =
      "/* of each corner of each triangle: the position, attributes in fours, clip distances in\n"
      "   fours */\nstatic const float vertices[] = {\n";
  for (const cases::Triangle& triangle : c.triangles) {
    for (const std::uint32_t vertex : triangle) {
      text += "    ";
      for (const float value : vertex_numbers(c, vertex)) text += number(value) + ", ";
      text += "\n";
    }
  }
  return text + "};\n";
}

std::string expectations(const Program& program) {
  const cases::Case& c = *program.c;
  std::string samples =
      "/* how often a sample must be drawn; `at` is the first word of its record */\n"
      "static const struct sample {\n  int triangle, x, y, sample;\n"
      "  uint32_t least, most, at, first_value, values;\n"
      "} samples[] = {\n";
  std::string values =
      "/* `word` is that of the sample's record */\n"
      "static const struct value {\n  uint32_t word;\n  const char *name;\n"
      "  float least, greatest;\n} values[] = {\n";
  std::size_t value_count = 0;
  for (const records::JudgedPlace& judged : program.places) {
    const auto& [triangle, y, x, index] = judged.place;
    samples +=
        fmt::format("    {{{}, {}, {}, {}, {}, {}, {}, {}, {}}},\n", triangle, x, y, index,
                    judged.verdict == records::Verdict::required ? 1 : 0,
                    judged.verdict == records::Verdict::forbidden ? 0 : 1,
                    record_at(c, program.part, x, y, index), value_count, judged.values.size());
    value_count += judged.values.size();
    for (const records::PermittedValue& value : judged.values) {
      const auto name =
          value.attribute ? "attribute " + c.attributes[*value.attribute].name : "depth";
      values += fmt::format("    {{{}, {}, {}, {}}},\n",
                            value.attribute ? kRecordHead + *value.attribute : 1, quoted(name),
                            number(value.numbers.least), number(value.numbers.greatest));
    }
  }
  // C has no arrays without elements.
  values += "    {0, \"\", 0, 0},\n";
  return samples + "};\n" + values + "};\n";
}

std::string text_of(const Program& program) {
  const bool is_vulkan_api = program.api == ShaderApi::vulkan;
  std::string text = "/*";
  for (const std::string& line : test_heading(*program.exhibit)) {
    text += fmt::format(" {}\n  ", comment_text(line));
  }
  text += " Prints what is wrong, and ends with exit code 1 if anything is. */\n\n";
  text += is_vulkan_api ? kVulkanHead : kOpenglHead;
  text.insert(text.find("#include <stdint.h>"), "#include <math.h>\n");
  text += sizes(program);
  if (!is_vulkan_api) {
    text +=
        fmt::format("#define IS_VULKAN {} /* depths from 0 to w, the first vertex provokes */\n",
                    program.c->rules == cases::Rules::vulkan ? 1 : 0);
  }
  text += "\n" + state(program);
  text += fmt::format("static const char vertex_shader[] ={};\n",
                      quoted_lines(vertex_shader(*program.c, program.api)));
  text += fmt::format("static const char fragment_shader[] ={};\n",
                      quoted_lines(fragment_shader(*program.c, program.part, program.api)));
  text += vertices(*program.c) + expectations(program) + "\n";
  text += kCheckProgram;
  text += "\n";
  return text.append(is_vulkan_api ? kVulkanProgram : kOpenglProgram);
}

/// OpenGL's drivers have Vulkan's depths by glClipControl, so that they draw cases of both rules;
/// all else is drawn by the API whose rules it has.
ShaderApi api_of(const records::Exhibit& exhibit) {
  const bool is_opengl =
      exhibit.source.rules == cases::Rules::opengl || exhibit.backend.starts_with("gl");
  return is_opengl ? ShaderApi::opengl : ShaderApi::vulkan;
}

Result<std::string> write(const records::Exhibit& exhibit) {
  const auto refuse = [&](std::string_view what) {
    return tl::unexpected(
        Error{exhibit.file, "", fmt::format("a C program cannot say it: {}", what)});
  };
  const cases::Case& c = exhibit.source;
  Program program{&exhibit, &c, api_of(exhibit), part_of(exhibit),
                  tested_places(exhibit, records_depth(c))};
  if (const std::string why = why_not_drawn(exhibit); !why.empty()) return refuse(why);
  if (program.api == ShaderApi::opengl && exhibit.backend.starts_with("vulkan")) {
    return refuse("a Vulkan program has no depths by OpenGL's rules");
  }
  if (c.viewport.width < 0) return refuse("its viewport has a negative width");
  if (c.viewport.height < 0 && program.api == ShaderApi::opengl) {
    return refuse("OpenGL has no viewports of negative height");
  }
  if (const auto why = why_not_shown(exhibit, program.places)) return refuse(*why);
  if (program.places.empty()) return refuse("nothing is promised");
  return text_of(program);
}

const ExporterRegistration kRegistration({"c", "a C program that draws it by OpenGL or Vulkan",
                                          &write});

}  // namespace
}  // namespace rastercheck::reports::c_exporter
