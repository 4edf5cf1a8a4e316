#include "cases/fragments_json.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "cases/float_text.h"
#include "cases/fragment_collector.h"
#include "cases/json.h"
#include "cases/json_node.h"

namespace rastercheck::cases {
namespace {

/// Reads a number that a rasterizer wrote: any float32, even infinite or NaN.
float drawn_float(const JsonNode& node) {
  if (node.is_string()) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const std::string text = node.text();
    if (text == "inf") return kInfinity;
    if (text == "-inf") return -kInfinity;
    if (text == "nan") return kNan;
    if (text == "-nan") return -kNan;
  }
  return node.float32();
}

void read_fragment(const JsonNode& node, const Case& c, FragmentCollector& to) {
  node.expect_object({"triangle", "x", "y", "depth"}, {"sample", "attributes"});
  SamplePlace at;
  at.triangle = node["triangle"].count<std::uint32_t>();
  at.x = node["x"].count<std::uint32_t>();
  at.y = node["y"].count<std::uint32_t>();
  if (node.has("sample")) at.sample = node["sample"].count<std::uint32_t>();
  std::vector<float> attributes;
  attributes.reserve(c.attributes.size());
  if (node.has("attributes")) {
    for (const JsonNode& value : node["attributes"].elements()) {
      attributes.push_back(drawn_float(value));
    }
  }
  const float depth = drawn_float(node["depth"]);
  if (node.failed()) return;
  if (const std::string fault = to.add(at, depth, attributes); !fault.empty()) node.refuse(fault);
}

Fragments read_fragments(const JsonNode& root, const Case& c) {
  root.expect_format("rastercheck-fragments");
  root.expect_object({"format", "version", "fragments"}, {"backend"});
  if (!root.failed()) root["version"].integer(1, 1);
  FragmentCollector collector(c);
  for (const JsonNode& node : root["fragments"].elements()) {
    if (root.failed()) return {};
    read_fragment(node, c, collector);
  }
  tl::expected<Fragments, std::string> drawn = collector.take();
  if (drawn) return *std::move(drawn);
  root["fragments"].refuse(drawn.error());
  return {};
}

}  // namespace

void write_fragments(const Fragments& drawn, const std::string& backend,
                     const std::function<bool(std::string_view)>& write) {
  bool goes_on = write(fmt::format(
      R"({{"format": "rastercheck-fragments", "version": 1, "backend": {}, "fragments": [)",
      json_string(backend)));
  for (std::size_t i = 0; i < drawn.size() && goes_on; ++i) {
    std::string attributes;
    for (const float value : drawn.attributes_of(i)) {
      attributes += fmt::format("{}\"{}\"", attributes.empty() ? "" : ", ", to_hex(value));
    }
    goes_on = write(fmt::format(
        R"({}{{"triangle": {}, "x": {}, "y": {}, "sample": {}, "depth": "{}", "attributes": [{}]}})",
        i == 0 ? "\n  " : ",\n  ", drawn.triangle[i], drawn.x[i], drawn.y[i], drawn.sample[i],
        to_hex(drawn.depth[i]), attributes));
  }
  if (goes_on) write("\n]}\n");
}

Result<Fragments> parse_fragments(std::string_view text, const std::string& file, const Case& c) {
  return read_json(text, file, [&c](const JsonNode& root) { return read_fragments(root, c); });
}

}  // namespace rastercheck::cases
