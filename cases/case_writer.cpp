#include "cases/case_writer.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "cases/float_text.h"
#include "cases/json.h"
#include "cases/names.h"
#include "cases/picture_layout_json.h"

namespace rastercheck::cases {
namespace {

std::string number(float value) { return "\"" + to_hex(value) + "\""; }

template <typename Enum>
std::string word(Enum value) {
  return json_string(name_of(value));
}

template <typename Range>
std::string list(const Range& values) {
  std::string text = "[";
  for (const float value : values) {
    if (text.size() > 1) text += ", ";
    text += number(value);
  }
  return text + "]";
}

/// An array with each element on its own line.
std::string lines(const std::vector<std::string>& elements) {
  return elements.empty() ? "[]" : fmt::format("[\n    {}\n  ]", fmt::join(elements, ",\n    "));
}

std::string coverage_text(const Coverage& coverage) {
  if (!coverage) return "\"exact\"";
  std::string text = fmt::format(R"({{"subpixel_bits": {}, "rounding": {})",
                                 coverage->subpixel_bits, word(coverage->rounding));
  if (coverage->position_error != 0 || std::signbit(coverage->position_error)) {
    text += fmt::format(R"(, "position_error": {})", number(coverage->position_error));
  }
  return text + "}";
}

/// True if a reader gives this bias to a case that says nothing of one: -0 is not 0.
bool is_default(const DepthBias& bias) {
  return bias == DepthBias() && !std::signbit(bias.constant) && !std::signbit(bias.slope) &&
         !std::signbit(bias.clamp);
}

std::string vertex_text(const Case& c, std::size_t vertex) {
  const ClipVertex& p = c.positions[vertex];
  std::string text = fmt::format(R"({{"position": {})", list(std::array{p.x, p.y, p.z, p.w}));
  if (!c.attributes.empty()) {
    text += fmt::format(R"(, "attributes": {})", list(c.attributes_of(vertex)));
  }
  if (c.clip_distance_count > 0) {
    text += fmt::format(R"(, "clip_distances": {})", list(c.clip_distances_of(vertex)));
  }
  return text + "}";
}

std::string primitive_text(Primitive primitive, const Triangle& t) {
  switch (primitive) {
    case Primitive::triangles:
      return fmt::format("[{}, {}, {}]", t[0], t[1], t[2]);
    case Primitive::lines:
      return fmt::format("[{}, {}]", t[0], t[1]);
    case Primitive::points:
      break;
  }
  return fmt::to_string(t[0]);
}

std::string found_text(const Found& found) {
  std::string rest;
  if (!found.kind.empty()) rest += fmt::format(R"(, "kind": {})", json_string(found.kind));
  if (!found.condition.empty()) {
    rest += fmt::format(R"(, "condition": {})", json_string(found.condition));
  }
  return fmt::format(
      R"({{"property": {}, "backend": {}, "verdict": {}, "seed": {}, "index": {}{}}})",
      json_string(found.law), json_string(found.backend), json_string(found.verdict), found.seed,
      found.index, rest);
}

}  // namespace

std::string to_json(const Case& c) {
  std::vector<std::string> members;
  const auto add = [&members](std::string_view key, const std::string& value) {
    members.push_back(fmt::format("  \"{}\": {}", key, value));
  };
  add("format", "\"rastercheck-case\"");
  add("version", "1");
  add("name", json_string(c.name));
  add("framebuffer", fmt::format(R"({{"width": {}, "height": {}, "samples": {}}})",
                                 c.framebuffer.width, c.framebuffer.height, c.framebuffer.samples));
  const Viewport& v = c.viewport;
  add("viewport", fmt::format(R"({{"x": {}, "y": {}, "width": {}, "height": {}, "min_depth": {}, )"
                              R"("max_depth": {}}})",
                              number(v.x), number(v.y), number(v.width), number(v.height),
                              number(v.min_depth), number(v.max_depth)));
  add("rules", word(c.rules));
  add("coverage", coverage_text(c.coverage));
  if (c.basis != default_basis(c.rules)) add("basis", word(c.basis));
  if (c.fill_rule != default_fill_rule(c.rules)) add("fill_rule", word(c.fill_rule));
  const bool has_triangles = c.primitive == Primitive::triangles;
  if (has_triangles) add("cull", word(c.cull));
  add("front_face", word(c.front_face));
  if (c.scissor) {
    add("scissor", fmt::format(R"({{"x": {}, "y": {}, "width": {}, "height": {}}})", c.scissor->x,
                               c.scissor->y, c.scissor->width, c.scissor->height));
  }
  if (c.depth_test != DepthTest::none) add("depth_test", word(c.depth_test));
  if (c.depth_clear) add("depth_clear", number(*c.depth_clear));
  if (c.depth_clamp) add("depth_clamp", "true");
  if (has_triangles && !is_default(c.depth_bias)) {
    add("depth_bias", fmt::format(R"({{"constant": {}, "slope": {}, "clamp": {}}})",
                                  number(c.depth_bias.constant), number(c.depth_bias.slope),
                                  number(c.depth_bias.clamp)));
  }
  if (c.depth_format != DepthFormat::float32) add("depth_format", word(c.depth_format));
  if (c.primitive == Primitive::lines) {
    add("line_width", number(c.line_width));
    add("line_mode", word(c.line_mode));
  }
  if (c.primitive == Primitive::points) add("point_size", number(c.point_size));

  std::vector<std::string> attributes;
  attributes.reserve(c.attributes.size());
  for (const Attribute& a : c.attributes) {
    attributes.push_back(fmt::format(R"({{"name": {}, "interpolation": {}, "location": {}}})",
                                     json_string(a.name), word(a.interpolation), word(a.location)));
  }
  if (!attributes.empty()) add("attributes", lines(attributes));
  if (c.camera) {
    add("camera",
        fmt::format(R"({{"model": {}, "view": {}, "projection": {}}})", list(c.camera->model),
                    list(c.camera->view), list(c.camera->projection)));
  }

  std::vector<std::string> vertices;
  vertices.reserve(c.positions.size());
  for (std::size_t i = 0; i < c.positions.size(); ++i) vertices.push_back(vertex_text(c, i));
  add("vertices", lines(vertices));
  std::vector<std::string> primitives;
  primitives.reserve(c.triangles.size());
  for (const Triangle& t : c.triangles) primitives.push_back(primitive_text(c.primitive, t));
  add(name_of(c.primitive), lines(primitives));
  if (c.essential) {
    std::vector<std::string> words;
    for (const std::string& one : *c.essential) words.push_back(json_string(one));
    add("essential", fmt::format("[{}]", fmt::join(words, ", ")));
  }
  if (c.choices) add("choices", fmt::to_string(*c.choices));
  if (c.found) add("found", found_text(*c.found));
  if (c.picture) add("picture", to_json(*c.picture));
  return fmt::format("{{\n{}\n}}\n", fmt::join(members, ",\n"));
}

void write_value(nlohmann::json& to, const Case& c) {
  to = parse_json(to_json(c), "case").value_or(nlohmann::json());
}

}  // namespace rastercheck::cases
