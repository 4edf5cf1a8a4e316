// shader_test: a test for piglit's shader_runner, whose probes the right drawing meets and the
// wrong one does not. The fragment shader counts and records its fragments in a buffer; probes
// compare with the ends of what is permitted. Numbers in [vertex data] are bits, so that none is
// rounded.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/json.h"
#include "reports/exporter.h"
#include "reports/internal/case_shaders.h"
#include "reports/internal/sample_tests.h"

namespace rastercheck::reports::shader_test_exporter {
namespace {

constexpr std::size_t kWord = sizeof(std::uint32_t);

/// 2 z − w, by which OpenGL's depth range −w to w is Vulkan's 0 to w; empty if a float32 cannot
/// hold it.
std::optional<float> opengl_z(const cases::ClipVertex& p) {
  const double doubled = 2 * double{p.z};
  const double z = doubled - double{p.w};
  // The rounding error of that difference (Knuth 1997, 4.2.2, theorem B).
  const double back = z - doubled;
  const double error = (doubled - (z - back)) + (-double{p.w} - back);
  const auto rounded = static_cast<float>(z);
  return error == 0 && double{rounded} == z ? std::optional(rounded) : std::nullopt;
}

/// The case by OpenGL's rules. Window coordinates stay the same: rows count from the bottom there.
Result<cases::Case> as_opengl(const records::Exhibit& exhibit) {
  const auto refuse = [&](std::string_view what) {
    return tl::unexpected(
        Error{exhibit.file, "", fmt::format("shader_test cannot say it: {}", what)});
  };
  cases::Case c = exhibit.source;
  if (const std::string why = why_not_drawn(exhibit); !why.empty()) return refuse(why);
  if (c.scissor) return refuse("shader_runner has no scissor");
  if (c.cull != cases::Cull::none) return refuse("shader_runner does not cull");
  if (c.viewport.width < 0 || c.viewport.height < 0)
    return refuse("OpenGL has no viewports of negative size");
  if (!exhibit.inspection) return refuse("nothing could be drawn");
  if (c.rules == cases::Rules::opengl) return c;
  for (cases::ClipVertex& p : c.positions) {
    const std::optional<float> z = opengl_z(p);
    if (!z) return refuse("of Vulkan's z, OpenGL's 2 z − w has more digits than a float32");
    p.z = *z;
  }
  return c;
}

bool has_whole_depth_range(const cases::Case& c) {
  return c.viewport.min_depth == 0 && c.viewport.max_depth == 1;
}

std::string requirements(const cases::Case& c) {
  std::string text =
      "[require]\nGL >= 3.3\nGLSL >= 3.30\nGL_ARB_shader_storage_buffer_object\n"
      "GL_ARB_viewport_array\n";
  if (c.framebuffer.samples > 1) text += "GL_ARB_gpu_shader5\nGL_ARB_sample_shading\n";
  return text + "\n";
}

std::string vertex_data(const cases::Case& c) {
  std::string text = "[vertex data]\nposition/float/4";
  for (std::size_t i = 0; i < attribute_vectors(c); ++i)
    text += fmt::format(" attributes{}/float/4", i);
  for (std::size_t i = 0; i < clip_vectors(c); ++i) text += fmt::format(" distances{}/float/4", i);
  for (const cases::Triangle& triangle : c.triangles) {
    for (const std::uint32_t vertex : triangle) {
      std::vector<std::string> bits;
      for (const float number : vertex_numbers(c, vertex)) {
        bits.push_back(fmt::format("0x{:08x}", std::bit_cast<std::uint32_t>(number)));
      }
      text += fmt::format("\n{}", fmt::join(bits, " "));
    }
  }
  return text + "\n\n";
}

std::string state(const cases::Case& c, bool is_vulkan) {
  const cases::FramebufferSize& size = c.framebuffer;
  const cases::Viewport& v = c.viewport;
  std::string text = fmt::format("fb ms GL_RGBA8 {} {} {}\n", size.width, size.height,
                                 size.samples > 1 ? size.samples : 0);
  text += fmt::format("viewport indexed 0 {} {} {} {}\n", v.x, v.y, v.width, v.height);
  text += is_vulkan ? "provoking vertex first\n" : "provoking vertex last\n";
  if (c.depth_clamp) text += "enable GL_DEPTH_CLAMP\n";
  for (std::size_t i = 0; i < c.clip_distance_count; ++i) {
    text += fmt::format("enable GL_CLIP_PLANE{}\n", i);
  }
  return text;
}

/// Where a place's record begins in the buffer, in bytes.
std::size_t byte_of(const records::JudgedPlace& judged, const cases::Case& c,
                    const RecordedPart& part) {
  return kWord * record_at(c, part, judged.place.x, judged.place.y, judged.place.sample);
}

/// Where a value stands in its record, in bytes.
std::size_t byte_of(const records::PermittedValue& value) {
  return kWord * (value.attribute ? kRecordHead + *value.attribute : 1);
}

/// Samples that may be left out begin with permitted values, which remain if nothing is drawn.
std::string first_values(const records::JudgedPlace& judged, std::size_t at) {
  if (judged.verdict != records::Verdict::permitted) return "";
  std::string text;
  for (const records::PermittedValue& value : judged.values) {
    const float permitted = std::clamp(0.0F, value.numbers.least, value.numbers.greatest);
    text += fmt::format("ssbo 0 subdata float {} {}\n", at + byte_of(value), permitted);
  }
  return text;
}

/// The lines that compare a record with what is permitted. NaN fails any comparison.
std::string probes(const records::JudgedPlace& judged, const cases::Case& c, std::size_t at) {
  std::string text = fmt::format("# {}\nprobe ssbo uint 0 {} {}\n", place_text(judged, c), at,
                                 judged.verdict == records::Verdict::required    ? "== 1"
                                 : judged.verdict == records::Verdict::forbidden ? "== 0"
                                                                                 : "<= 1");
  for (const records::PermittedValue& value : judged.values) {
    const std::size_t word = at + byte_of(value);
    text += fmt::format("# {}\nprobe ssbo float 0 {} >= {}\nprobe ssbo float 0 {} <= {}\n",
                        value.attribute
                            ? "attribute " + cases::one_line(c.attributes[*value.attribute].name)
                            : "depth",
                        word, value.numbers.least, word, value.numbers.greatest);
  }
  return text;
}

/// Draws one triangle into a new buffer, and probes it.
std::string draw(std::span<const records::JudgedPlace> places, const cases::Case& c,
                 const RecordedPart& part) {
  std::string text =
      fmt::format("\nssbo 0 {}\n", kWord * record_size(c) * part.width * part.height *
                                       static_cast<std::size_t>(c.framebuffer.samples));
  for (const records::JudgedPlace& judged : places) {
    text += first_values(judged, byte_of(judged, c, part));
  }
  text +=
      fmt::format("draw arrays GL_TRIANGLES {} 3\nmemory barrier GL_BUFFER_UPDATE_BARRIER_BIT\n",
                  3 * places.front().place.triangle);
  for (const records::JudgedPlace& judged : places) {
    text += probes(judged, c, byte_of(judged, c, part));
  }
  return text;
}

Result<std::string> write(const records::Exhibit& exhibit) {
  const auto c = as_opengl(exhibit);
  if (!c) return tl::unexpected(c.error());
  const bool is_vulkan = exhibit.source.rules == cases::Rules::vulkan;
  const RecordedPart part = part_of(exhibit);
  const auto places = tested_places(exhibit, records_depth(*c) && has_whole_depth_range(*c));
  if (const auto why = why_not_shown(exhibit, places)) {
    return tl::unexpected(
        Error{exhibit.file, "", fmt::format("shader_test cannot say it: {}", *why)});
  }
  if (places.empty()) {
    return tl::unexpected(
        Error{exhibit.file, "", "shader_test would test nothing: nothing is promised"});
  }
  std::string text;
  for (const std::string& line : test_heading(exhibit)) text += fmt::format("# {}\n", line);
  text += fmt::format(
      "#\n# The buffer has {} words for each sample of the pixels from ({}, {}) on, {} × {}: how "
      "often\n"
      "# it is drawn, the depth, the attributes. Probes say what each must be; places and values\n"
      "# that the rules leave open have none.\n\n",
      record_size(*c), part.left, part.top, part.width, part.height);
  text += requirements(*c);
  text += fmt::format("[vertex shader]\n{}\n", vertex_shader(*c, ShaderApi::opengl));
  text += fmt::format("[fragment shader]\n{}\n", fragment_shader(*c, part, ShaderApi::opengl));
  text += vertex_data(*c) + "[test]\n" + state(*c, is_vulkan);
  for (const auto& of_triangle : by_triangle(places)) text += draw(of_triangle, *c, part);
  return text;
}

const ExporterRegistration kRegistration({"shader_test", "a test for piglit's shader_runner",
                                          &write});

}  // namespace
}  // namespace rastercheck::reports::shader_test_exporter
