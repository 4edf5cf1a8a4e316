#include "cases/case_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cases/float_text.h"
#include "cases/json.h"
#include "cases/names.h"
#include "cases/sample_pattern.h"

namespace rastercheck::cases {
namespace {

using nlohmann::json;

/// One value of the document with its place. Reading goes on after an error, on neutral values, so
/// that the decoding below reads as the format does; only the first error is kept.
class Node {
 public:
  Node(const json& value, std::string pointer, std::optional<Error>& error, const std::string& file)
      : value_(&value), pointer_(std::move(pointer)), error_(&error), file_(&file) {}

  void refuse(std::string reason) const {
    if (*error_) return;
    *error_ = Error{*file_, pointer_.empty() ? "/" : pointer_, std::move(reason)};
  }
  bool failed() const { return error_->has_value(); }

  /// Refuses anything but an object with all of `required` and nothing beyond `optional`.
  void expect_object(std::initializer_list<std::string_view> required,
                     std::initializer_list<std::string_view> optional) const {
    if (!value_->is_object()) return refuse("must be an object");
    for (const auto& member : value_->items()) {
      const std::string& key = member.key();
      const auto is_key = [&key](std::string_view known) { return known == key; };
      if (std::none_of(required.begin(), required.end(), is_key) &&
          std::none_of(optional.begin(), optional.end(), is_key)) {
        return Node(member.value(), child_pointer(pointer_, key), *error_, *file_)
            .refuse(fmt::format("unknown key '{}'", printable(key)));
      }
    }
    for (const std::string_view key : required) {
      if (!value_->contains(key)) refuse(fmt::format("missing key '{}'", key));
    }
  }

  bool has(std::string_view key) const { return value_->is_object() && value_->contains(key); }

  Node operator[](std::string_view key) const {
    static const json kMissing;
    return {has(key) ? value_->at(std::string(key)) : kMissing, child_pointer(pointer_, key),
            *error_, *file_};
  }

  /// The elements of an array; none of anything else, which is refused.
  std::vector<Node> elements() const {
    std::vector<Node> nodes;
    if (!value_->is_array()) {
      refuse("must be an array");
      return nodes;
    }
    nodes.reserve(value_->size());
    for (std::size_t i = 0; i < value_->size(); ++i) {
      nodes.emplace_back((*value_)[i], child_pointer(pointer_, std::to_string(i)), *error_, *file_);
    }
    return nodes;
  }

  /// The elements of an array of `least` to `most`.
  std::vector<Node> elements(std::size_t least, std::size_t most, std::string_view what) const {
    std::vector<Node> nodes = elements();
    if (!failed() && (nodes.size() < least || nodes.size() > most)) {
      refuse(least == most
                 ? fmt::format("must have {} {}, not {}", least, what, nodes.size())
                 : fmt::format("must have {} to {} {}, not {}", least, most, what, nodes.size()));
      nodes.clear();
    }
    return nodes;
  }

  bool is_string() const { return value_->is_string(); }

  std::string text() const {
    if (value_->is_string()) return value_->get<std::string>();
    refuse("must be a string");
    return {};
  }

  bool boolean() const {
    if (value_->is_boolean()) return value_->get<bool>();
    refuse("must be true or false");
    return false;
  }

  std::int64_t integer(std::int64_t least, std::int64_t most) const {
    std::optional<std::int64_t> number;
    if (value_->is_number_unsigned()) {
      const auto value = value_->get<std::uint64_t>();
      if (std::in_range<std::int64_t>(value)) number = static_cast<std::int64_t>(value);
    } else if (value_->is_number_integer()) {
      number = value_->get<std::int64_t>();
    } else if (value_->is_number_float()) {
      const auto value = value_->get<double>();
      if (value != std::floor(value)) {
        refuse("must be an integer");
        return least;
      }
      if (std::abs(value) <= 0x1p53) number = static_cast<std::int64_t>(value);
    } else {
      refuse("must be an integer");
      return least;
    }
    if (!number || *number < least || *number > most) {
      refuse(fmt::format("out of range: must be an integer from {} to {}", least, most));
      return least;
    }
    return *number;
  }

  std::uint64_t unsigned_integer() const {
    if (value_->is_number_unsigned()) return value_->get<std::uint64_t>();
    // Integral floats such as 64.0 are integers, within what a double counts exactly.
    std::optional<Error> ignored;
    const std::int64_t value = Node(*value_, pointer_, ignored, *file_)
                                   .integer(0, std::numeric_limits<std::int64_t>::max());
    if (ignored) {
      refuse(fmt::format("out of range: must be an integer from 0 to {}",
                         std::numeric_limits<std::uint64_t>::max()));
    }
    return static_cast<std::uint64_t>(value);
  }

  float number() const {
    if (value_->is_string()) {
      const auto text = value_->get<std::string>();
      if (!is_hex_float(text)) {
        refuse(fmt::format("must be a number or a hex float such as \"0x1.8p-2\", not \"{}\"",
                           printable(text)));
        return 0;
      }
      const std::optional<float> value = float_from_hex(text);
      if (!value) refuse(fmt::format("not exactly a float32: {}", printable(text)));
      return value.value_or(0.0F);
    }
    if (!value_->is_number()) {
      refuse("must be a number or a hex-float string");
      return 0;
    }
    const std::optional<float> value = exact_float(value_->get<double>());
    if (!value) refuse(fmt::format("not exactly a float32: {}", value_->dump()));
    return value.value_or(0.0F);
  }

  float number(float least, float most) const {
    const float value = number();
    if (failed() || (value >= least && value <= most)) return value;
    refuse(fmt::format("out of range: must be from {} to {}", least, most));
    return least;
  }

  template <typename Enum>
  Enum word() const {
    const std::string chosen = text();
    const std::optional<Enum> value = from_name<Enum>(chosen);
    if (!value) refuse(fmt::format("must be {}", name_list<Enum>()));
    return value.value_or(Enum{});
  }

 private:
  const json* value_;
  std::string pointer_;
  std::optional<Error>* error_;
  const std::string* file_;
};

FramebufferSize read_framebuffer(const Node& node) {
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

Viewport read_viewport(const Node& node, Rules rules) {
  node.expect_object({"x", "y", "width", "height"}, {"min_depth", "max_depth"});
  Viewport viewport;
  viewport.x = node["x"].number();
  viewport.y = node["y"].number();
  viewport.width = node["width"].number(-kMaxSize, kMaxSize);
  viewport.height = node["height"].number(-kMaxSize, kMaxSize);
  if (node.has("min_depth")) viewport.min_depth = node["min_depth"].number(0, 1);
  if (node.has("max_depth")) viewport.max_depth = node["max_depth"].number(0, 1);
  if (rules == Rules::d3d && viewport.min_depth > viewport.max_depth) {
    node["min_depth"].refuse("d3d wants min_depth <= max_depth");
  }
  return viewport;
}

Coverage read_coverage(const Node& node) {
  if (node.is_string()) {
    if (node.text() != "exact") node.refuse("must be \"exact\" or an object with subpixel_bits");
    return std::nullopt;
  }
  node.expect_object({"subpixel_bits"}, {"rounding", "position_error"});
  Snapping snapping;
  snapping.subpixel_bits = static_cast<int>(node["subpixel_bits"].integer(0, kMaxSubpixelBits));
  if (node.has("rounding")) snapping.rounding = node["rounding"].word<Rounding>();
  if (node.has("position_error")) {
    snapping.position_error = node["position_error"].number(0, kMaxPositionError);
  }
  return snapping;
}

Scissor read_scissor(const Node& node) {
  node.expect_object({"x", "y", "width", "height"}, {});
  Scissor scissor;
  scissor.x = static_cast<int>(node["x"].integer(-kMaxSize, kMaxSize));
  scissor.y = static_cast<int>(node["y"].integer(-kMaxSize, kMaxSize));
  scissor.width = static_cast<int>(node["width"].integer(0, kMaxSize));
  scissor.height = static_cast<int>(node["height"].integer(0, kMaxSize));
  return scissor;
}

std::vector<Attribute> read_attributes(const Node& node) {
  std::vector<Attribute> attributes;
  for (const Node& element : node.elements(0, kMaxAttributes, "attributes")) {
    element.expect_object({"name"}, {"interpolation", "location"});
    Attribute attribute;
    attribute.name = element["name"].text();
    if (element.has("interpolation")) {
      attribute.interpolation = element["interpolation"].word<Interpolation>();
    }
    if (element.has("location")) attribute.location = element["location"].word<Location>();
    attributes.push_back(std::move(attribute));
  }
  return attributes;
}

Matrix4 read_matrix(const Node& node) {
  Matrix4 matrix = kIdentity;
  std::size_t i = 0;
  for (const Node& element : node.elements(16, 16, "numbers, row by row")) {
    matrix[i++] = element.number();
  }
  return matrix;
}

Camera read_camera(const Node& node) {
  node.expect_object({}, {"model", "view", "projection"});
  Camera camera;
  if (node.has("model")) camera.model = read_matrix(node["model"]);
  if (node.has("view")) camera.view = read_matrix(node["view"]);
  if (node.has("projection")) camera.projection = read_matrix(node["projection"]);
  return camera;
}

ClipVertex read_position(const Node& node, bool with_camera) {
  const std::vector<Node> numbers = node.elements(with_camera ? 3 : 4, 4, "numbers");
  if (node.failed()) return {};
  ClipVertex position;
  position.x = numbers[0].number();
  position.y = numbers[1].number();
  position.z = numbers[2].number();
  if (numbers.size() == 4) position.w = numbers[3].number();
  return position;
}

void read_vertices(const Node& node, Case& c) {
  bool first = true;
  for (const Node& vertex : node.elements()) {
    if (node.failed()) return;
    vertex.expect_object({"position"}, {"attributes", "clip_distances"});
    c.positions.push_back(read_position(vertex["position"], c.camera.has_value()));

    const std::size_t count = c.attributes.size();
    if (vertex.has("attributes")) {
      for (const Node& value :
           vertex["attributes"].elements(count, count, "numbers, as declared")) {
        c.attribute_values.push_back(value.number());
      }
    } else if (count > 0) {
      vertex.refuse("missing key 'attributes'");
    }

    std::vector<Node> distances;
    if (vertex.has("clip_distances")) {
      distances = vertex["clip_distances"].elements(0, kMaxClipDistances, "numbers");
    }
    if (first) c.clip_distance_count = distances.size();
    if (distances.size() != c.clip_distance_count) {
      // Absent where vertex 0 has some, the vertex is the place.
      (vertex.has("clip_distances") ? vertex["clip_distances"] : vertex)
          .refuse(
              fmt::format("must have {} clip_distances, as vertex 0 has", c.clip_distance_count));
    }
    for (const Node& distance : distances) c.clip_distances.push_back(distance.number());
    first = false;
  }
}

void read_triangles(const Node& node, Case& c) {
  for (const Node& element : node.elements()) {
    if (node.failed()) return;
    Triangle triangle{};
    std::size_t corner = 0;
    for (const Node& index : element.elements(3, 3, "indices")) {
      const std::int64_t value = index.integer(0, std::numeric_limits<std::uint32_t>::max());
      if (value >= static_cast<std::int64_t>(c.positions.size())) {
        index.refuse(
            fmt::format("index {} out of range: there are {} vertices", value, c.positions.size()));
      }
      triangle[corner++] = static_cast<std::uint32_t>(value);
    }
    c.triangles.push_back(triangle);
  }
}

Found read_found(const Node& node) {
  node.expect_object({}, {"law", "backend", "verdict", "seed", "index"});
  Found found;
  if (node.has("law")) found.law = node["law"].text();
  if (node.has("backend")) found.backend = node["backend"].text();
  if (node.has("verdict")) found.verdict = node["verdict"].text();
  if (node.has("seed")) found.seed = node["seed"].unsigned_integer();
  if (node.has("index")) found.index = node["index"].unsigned_integer();
  return found;
}

void check_header(const Node& root) {
  root.expect_object(
      {"format", "version", "framebuffer", "viewport", "rules", "vertices", "triangles"},
      {"name", "coverage", "basis", "fill_rule", "cull", "front_face", "scissor", "depth_test",
       "depth_clamp", "attributes", "camera", "found"});
  if (root.failed()) return;
  if (root["format"].text() != "rastercheck-case") {
    root["format"].refuse("must be \"rastercheck-case\"");
  }
  if (root["version"].integer(0, std::numeric_limits<std::int32_t>::max()) != 1) {
    root["version"].refuse("version must be 1");
  }
}

Case read_document(const Node& root) {
  Case c;
  check_header(root);
  if (root.failed()) return c;
  if (root.has("name")) c.name = root["name"].text();
  c.framebuffer = read_framebuffer(root["framebuffer"]);
  c.rules = root["rules"].word<Rules>();
  c.viewport = read_viewport(root["viewport"], c.rules);
  if (root.has("coverage")) c.coverage = read_coverage(root["coverage"]);
  c.basis = root.has("basis") ? root["basis"].word<Basis>() : default_basis(c.rules);
  c.fill_rule =
      root.has("fill_rule") ? root["fill_rule"].word<TieRule>() : default_fill_rule(c.rules);
  if (root.has("cull")) c.cull = root["cull"].word<Cull>();
  if (root.has("front_face")) c.front_face = root["front_face"].word<FrontFace>();
  if (root.has("scissor")) c.scissor = read_scissor(root["scissor"]);
  if (root.has("depth_test")) c.depth_test = root["depth_test"].word<DepthTest>();
  if (root.has("depth_clamp")) c.depth_clamp = root["depth_clamp"].boolean();
  if (root.has("attributes")) c.attributes = read_attributes(root["attributes"]);
  if (root.has("camera")) c.camera = read_camera(root["camera"]);
  if (root.has("found")) c.found = read_found(root["found"]);
  if (root.failed()) return c;
  read_vertices(root["vertices"], c);
  if (root.failed()) return c;
  read_triangles(root["triangles"], c);
  return c;
}

}  // namespace

Result<Case> parse_case(std::string_view text, const std::string& file) {
  const Result<json> document = parse_json(text, file);
  if (!document) return tl::unexpected(document.error());
  std::optional<Error> error;
  Case c = read_document(Node(*document, "", error, file));
  if (error) return tl::unexpected(*error);
  return c;
}

Result<Case> read_case(const std::string& file) {
  return read_text(file).and_then(
      [&file](const std::string& text) { return parse_case(text, file); });
}

}  // namespace rastercheck::cases
