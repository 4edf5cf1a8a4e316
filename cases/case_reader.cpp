#include "cases/case_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "cases/capabilities.h"
#include "cases/files.h"
#include "cases/json_node.h"
#include "cases/names.h"
#include "cases/picture_layout_json.h"
#include "cases/sample_pattern.h"

namespace rastercheck::cases {
namespace {

FramebufferSize read_framebuffer(const JsonNode& node) {
  node.expect_object({"width", "height"}, {"samples"});
  FramebufferSize size;
  size.width = static_cast<int>(node["width"].integer(1, kMaxSize));
  size.height = static_cast<int>(node["height"].integer(1, kMaxSize));
  if (node.has("samples")) {
    size.samples = static_cast<int>(node["samples"].integer(1, 16));
    if (standard_pattern(size.samples).empty()) {
      node["samples"].refuse("must be 1, 2, 4, 8 or 16");
    }
  }
  return size;
}

Viewport read_viewport(const JsonNode& node, Rules rules) {
  node.expect_object({"x", "y", "width", "height"}, {"min_depth", "max_depth"});
  Viewport viewport;
  viewport.x = node["x"].float32();
  viewport.y = node["y"].float32();
  viewport.width = node["width"].float32(-kMaxSize, kMaxSize);
  viewport.height = node["height"].float32(-kMaxSize, kMaxSize);
  if (node.has("min_depth")) viewport.min_depth = node["min_depth"].float32(0, 1);
  if (node.has("max_depth")) viewport.max_depth = node["max_depth"].float32(0, 1);
  if (rules == Rules::d3d && viewport.min_depth > viewport.max_depth) {
    node["min_depth"].refuse("must be at most max_depth under the rules of d3d");
  }
  return viewport;
}

Coverage read_coverage(const JsonNode& node) {
  if (node.is_string()) {
    if (node.text() != "exact") node.refuse("must be \"exact\" or an object with subpixel_bits");
    return std::nullopt;
  }
  node.expect_object({"subpixel_bits"}, {"rounding", "position_error"});
  Snapping snapping;
  snapping.subpixel_bits = static_cast<int>(node["subpixel_bits"].integer(0, kMaxSubpixelBits));
  if (node.has("rounding")) {
    snapping.rounding = node["rounding"].enumerator<Rounding>(kRoundingsOfCases);
  }
  if (node.has("position_error")) {
    snapping.position_error = node["position_error"].float32(0, kMaxPositionError);
  }
  return snapping;
}

Scissor read_scissor(const JsonNode& node) {
  node.expect_object({"x", "y", "width", "height"}, {});
  Scissor scissor;
  scissor.x = static_cast<int>(node["x"].integer(-kMaxSize, kMaxSize));
  scissor.y = static_cast<int>(node["y"].integer(-kMaxSize, kMaxSize));
  scissor.width = static_cast<int>(node["width"].integer(0, kMaxSize));
  scissor.height = static_cast<int>(node["height"].integer(0, kMaxSize));
  return scissor;
}

DepthBias read_depth_bias(const JsonNode& node) {
  node.expect_object({}, {"constant", "slope", "clamp"});
  DepthBias bias;
  if (node.has("constant")) bias.constant = node["constant"].float32();
  if (node.has("slope")) bias.slope = node["slope"].float32();
  if (node.has("clamp")) bias.clamp = node["clamp"].float32();
  return bias;
}

DepthFormat read_depth_format(const JsonNode& node) {
  const std::string word = node.text();
  for (const DepthFormat format : kDepthFormatsOfCases) {
    if (name_of(format) == word) return format;
  }
  node.refuse("must be float32, unorm16 or unorm24");
  return DepthFormat::float32;
}

std::vector<Attribute> read_attributes(const JsonNode& node) {
  std::vector<Attribute> attributes;
  for (const JsonNode& element : node.elements(0, kMaxAttributes, "attributes")) {
    element.expect_object({"name"}, {"interpolation", "location"});
    Attribute attribute;
    attribute.name = element["name"].text();
    if (element.has("interpolation")) {
      attribute.interpolation = element["interpolation"].enumerator<Interpolation>();
    }
    if (element.has("location")) attribute.location = element["location"].enumerator<Location>();
    attributes.push_back(std::move(attribute));
  }
  return attributes;
}

Matrix4 read_matrix(const JsonNode& node) {
  Matrix4 matrix = kIdentity;
  std::size_t i = 0;
  for (const JsonNode& element : node.elements(16, 16, "numbers, row by row")) {
    matrix[i++] = element.float32();
  }
  return matrix;
}

Camera read_camera(const JsonNode& node) {
  node.expect_object({}, {"model", "view", "projection"});
  Camera camera;
  if (node.has("model")) camera.model = read_matrix(node["model"]);
  if (node.has("view")) camera.view = read_matrix(node["view"]);
  if (node.has("projection")) camera.projection = read_matrix(node["projection"]);
  return camera;
}

ClipVertex read_position(const JsonNode& node, bool with_camera) {
  const std::vector<JsonNode> numbers = node.elements(with_camera ? 3 : 4, 4, "numbers");
  if (node.failed()) return {};
  ClipVertex position;
  position.x = numbers[0].float32();
  position.y = numbers[1].float32();
  position.z = numbers[2].float32();
  if (numbers.size() == 4) position.w = numbers[3].float32();
  return position;
}

void read_vertices(const JsonNode& node, Case& c) {
  bool first = true;
  for (const JsonNode& vertex : node.elements()) {
    if (node.failed()) return;
    vertex.expect_object({"position"}, {"attributes", "clip_distances"});
    c.positions.push_back(read_position(vertex["position"], c.camera.has_value()));

    const std::size_t count = c.attributes.size();
    if (vertex.has("attributes")) {
      for (const JsonNode& value :
           vertex["attributes"].elements(count, count, "numbers, as declared")) {
        c.attribute_values.push_back(value.float32());
      }
    } else if (count > 0) {
      vertex.refuse("missing key 'attributes'");
    }

    std::vector<JsonNode> distances;
    if (vertex.has("clip_distances")) {
      distances = vertex["clip_distances"].elements(0, kMaxClipDistances, "numbers");
    }
    if (first) c.clip_distance_count = distances.size();
    if (distances.size() != c.clip_distance_count) {
      // If this vertex has none although vertex 0 has some, the error points at the vertex.
      (vertex.has("clip_distances") ? vertex["clip_distances"] : vertex)
          .refuse(fmt::format("must have {} clip_distances, like vertex 0", c.clip_distance_count));
    }
    for (const JsonNode& distance : distances) c.clip_distances.push_back(distance.float32());
    first = false;
  }
}

std::uint32_t read_index(const JsonNode& node, const Case& c) {
  const std::int64_t value = node.integer(0, std::numeric_limits<std::uint32_t>::max());
  if (value >= static_cast<std::int64_t>(c.positions.size())) {
    node.refuse(
        fmt::format("index {} out of range: there are {} vertices", value, c.positions.size()));
  }
  return static_cast<std::uint32_t>(value);
}

/// Reads the key that the case's primitives are named by.
void read_primitives(const JsonNode& node, Case& c) {
  for (const JsonNode& element : node.elements()) {
    if (node.failed()) return;
    if (c.primitive == Primitive::points) {
      const std::uint32_t index = read_index(element, c);
      c.triangles.push_back({index, index, index});
      continue;
    }
    const std::size_t count = c.primitive == Primitive::lines ? 2 : 3;
    const std::vector<JsonNode> indices = element.elements(count, count, "indices");
    if (node.failed()) return;
    c.triangles.push_back(
        {read_index(indices[0], c), read_index(indices[1], c), read_index(indices.back(), c)});
  }
}

/// Refuses keys of other primitives than the case has, so that none is ignored.
void refuse_keys_of_others(const JsonNode& root, Primitive primitive) {
  const auto only = [&](std::string_view key, Primitive owner) {
    if (primitive == owner || !root.has(key)) return;
    root[key].refuse(
        fmt::format("is of {} only, and the case has {}", name_of(owner), name_of(primitive)));
  };
  only("line_width", Primitive::lines);
  only("line_mode", Primitive::lines);
  only("point_size", Primitive::points);
  only("cull", Primitive::triangles);
  only("depth_bias", Primitive::triangles);
}

Primitive read_primitive(const JsonNode& root) {
  std::optional<Primitive> found;
  for (const Primitive one : {Primitive::triangles, Primitive::lines, Primitive::points}) {
    if (!root.has(name_of(one))) continue;
    if (found) {
      root[name_of(one)].refuse(fmt::format("the case has {} already", name_of(*found)));
    }
    found = found.value_or(one);
  }
  if (!found) root.refuse("missing key 'triangles', 'lines' or 'points'");
  return found.value_or(Primitive::triangles);
}

float read_size(const JsonNode& node) {
  const float size = node.float32(0, kMostPrimitiveSize);
  if (size == 0) node.refuse("must be more than 0");
  return size;
}

Found read_found(const JsonNode& node) {
  node.expect_object({}, {"property", "backend", "verdict", "seed", "index", "kind", "condition"});
  Found found;
  if (node.has("property")) found.law = node["property"].text();
  if (node.has("backend")) found.backend = node["backend"].text();
  if (node.has("verdict")) found.verdict = node["verdict"].text();
  if (node.has("seed")) found.seed = node["seed"].unsigned_integer();
  if (node.has("index")) found.index = node["index"].unsigned_integer();
  if (node.has("kind")) found.kind = node["kind"].text();
  if (node.has("condition")) found.condition = node["condition"].text();
  return found;
}

constexpr std::size_t kMostEssential = kFeatures + 3;

/// Reads the name of a cases::Feature, or of another thing that a case may be about.
std::string read_essential(const JsonNode& node) {
  constexpr std::array<std::string_view, 3> kOthers{"rules", "samples", "size"};
  constexpr auto kNames = names_of(Feature{});
  std::string word = node.text();
  const auto is_one_of = [&word](const auto& all) {
    return std::find(all.begin(), all.end(), word) != all.end();
  };
  if (!node.failed() && !is_one_of(kNames) && !is_one_of(kOthers)) {
    node.refuse(
        fmt::format("must be one of {}, {}", fmt::join(kNames, ", "), fmt::join(kOthers, ", ")));
  }
  return word;
}

void check_header(const JsonNode& root) {
  // Checks the format first, because in a file of another format the error should not be about
  // keys.
  root.expect_format("rastercheck-case");
  root.expect_object({"format", "version", "framebuffer", "viewport", "rules", "vertices"},
                     {"triangles",   "lines",      "points",       "line_width", "line_mode",
                      "point_size",  "name",       "coverage",     "basis",      "fill_rule",
                      "cull",        "front_face", "scissor",      "depth_test", "depth_clear",
                      "depth_clamp", "depth_bias", "depth_format", "attributes", "camera",
                      "essential",   "choices",    "found",        "picture",    "round"});
  if (root.failed()) return;
  if (root["version"].integer(0, std::numeric_limits<std::int32_t>::max()) != 1) {
    root["version"].refuse("version must be 1");
  }
}

Case read_rounded(const JsonNode& outer, DecimalRounding& rounding) {
  const JsonNode root = outer.with(rounding);
  Case c;
  check_header(root);
  if (root.failed()) return c;
  if (root.has("name")) c.name = root["name"].text();
  if (root.has("round") && root["round"].boolean()) rounding.is_allowed = true;
  c.framebuffer = read_framebuffer(root["framebuffer"]);
  c.rules = root["rules"].enumerator<Rules>();
  c.viewport = read_viewport(root["viewport"], c.rules);
  if (root.has("coverage")) c.coverage = read_coverage(root["coverage"]);
  c.basis = root.has("basis") ? root["basis"].enumerator<Basis>() : default_basis(c.rules);
  c.fill_rule = root.has("fill_rule") ? root["fill_rule"].enumerator<TieRule>(kTieRulesOfCases)
                                      : default_fill_rule(c.rules);
  if (root.has("cull")) c.cull = root["cull"].enumerator<Cull>();
  if (root.has("front_face")) c.front_face = root["front_face"].enumerator<FrontFace>();
  if (root.has("scissor")) c.scissor = read_scissor(root["scissor"]);
  if (root.has("depth_test")) c.depth_test = root["depth_test"].enumerator<DepthTest>();
  if (root.has("depth_clear")) c.depth_clear = root["depth_clear"].float32(0, 1);
  if (root.has("depth_clamp")) c.depth_clamp = root["depth_clamp"].boolean();
  if (root.has("depth_bias")) c.depth_bias = read_depth_bias(root["depth_bias"]);
  if (root.has("depth_format")) c.depth_format = read_depth_format(root["depth_format"]);
  c.primitive = read_primitive(root);
  refuse_keys_of_others(root, c.primitive);
  if (root.has("line_width")) c.line_width = read_size(root["line_width"]);
  if (root.has("line_mode")) {
    c.line_mode = root["line_mode"].enumerator<LineMode>();
  } else if (c.primitive == Primitive::lines) {
    c.line_mode = default_line_mode(c.rules, c.framebuffer.samples);
  }
  if (root.has("point_size")) c.point_size = read_size(root["point_size"]);
  if (root.has("attributes")) c.attributes = read_attributes(root["attributes"]);
  if (root.has("camera")) c.camera = read_camera(root["camera"]);
  if (root.has("essential")) {
    c.essential.emplace();
    for (const JsonNode& word : root["essential"].elements(0, kMostEssential, "names")) {
      c.essential->push_back(read_essential(word));
    }
  }
  if (root.has("choices")) c.choices = root["choices"].unsigned_integer();
  if (root.has("found")) c.found = read_found(root["found"]);
  if (root.has("picture")) c.picture = read_picture_layout(root["picture"]);
  if (root.failed()) return c;
  read_vertices(root["vertices"], c);
  if (root.failed()) return c;
  read_primitives(root[name_of(c.primitive)], c);
  return c;
}

}  // namespace

Case read_case(const JsonNode& root) {
  DecimalRounding rounding;
  return read_rounded(root, rounding);
}

Result<Case> parse_case(std::string_view text, const std::string& file, DecimalRounding& rounding) {
  return read_json(text, file, [&](const JsonNode& root) { return read_rounded(root, rounding); });
}

Result<Case> parse_case(std::string_view text, const std::string& file) {
  return read_json(text, file, [](const JsonNode& root) { return read_case(root); });
}

Result<Case> read_case(const std::string& file) {
  return read_text(file).and_then(
      [&file](const std::string& text) { return parse_case(text, file); });
}

}  // namespace rastercheck::cases
