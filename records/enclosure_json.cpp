#include "records/enclosure_json.h"

#include <nlohmann/json.hpp>

namespace rastercheck::records {

void write_value(nlohmann::json& to, const Enclosure& enclosure) {
  to = nlohmann::json::array(
      {cases::float64_to_json(enclosure.lo), cases::float64_to_json(enclosure.hi)});
}

void read_value(const cases::JsonNode& node, Enclosure& enclosure) {
  const auto [lo, hi] = node.two_elements("lower and upper end");
  enclosure = {lo.float64(), hi.float64()};
  if (!(enclosure.lo <= enclosure.hi)) node.refuse("the lower end must not be above the upper");
}

}  // namespace rastercheck::records
