#include "cases/json_members.h"

#include <nlohmann/json.hpp>

namespace rastercheck::cases {

using nlohmann::json;

void write_value(json& to, bool value) { to = value; }
void write_value(json& to, std::int64_t value) { to = value; }
void write_value(json& to, std::uint64_t value) { to = value; }
void write_value(json& to, double value) { to = float64_to_json(value); }
void write_value(json& to, std::string_view value) { to = value; }

json& member_of(json& object, std::string_view key) { return object[std::string(key)]; }

json& element_of(json& array) {
  array.push_back(nullptr);
  return array.back();
}

void make_object(json& to) { to = json::object(); }
void make_array(json& to) { to = json::array(); }

}  // namespace rastercheck::cases
