#include "cases/json_members.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/float_text.h"

namespace rastercheck::cases {

using nlohmann::json;

void write_value(json& to, bool value) { to = value; }
void write_value(json& to, std::int64_t value) { to = value; }
void write_value(json& to, std::uint64_t value) { to = value; }
void write_value(json& to, double value) { to = float64_to_json(value); }
void write_value(json& to, float value) {
  // A NaN's sign is not part of the value.
  to = std::isnan(value) ? "nan" : to_hex(value);
}
void write_value(json& to, std::string_view value) { to = value; }

json& member_of(json& object, std::string_view key) { return object[std::string(key)]; }

json& element_of(json& array) {
  array.push_back(nullptr);
  return array.back();
}

void make_object(json& to) { to = json::object(); }
void make_array(json& to) { to = json::array(); }

void read_value(const JsonNode& node, float& value) {
  const std::string text = node.text();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (text == "nan") {
    value = std::numeric_limits<float>::quiet_NaN();
  } else if (text == "inf" || text == "-inf") {
    value = text == "inf" ? kInfinity : -kInfinity;
  } else {
    value = node.hex_float32();
  }
}

void JsonKeys::expect(const JsonNode& node) const {
  if (!format_.empty()) {
    node.expect_format(format_);
    if (node.has("version") && node["version"].count() != version_) {
      node["version"].refuse(fmt::format("version must be {}", version_));
    }
  }
  node.expect_object(required_, optional_);
}

}  // namespace rastercheck::cases
