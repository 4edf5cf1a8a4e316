#include "records/enclosure_json.h"

#include <nlohmann/json.hpp>

namespace rastercheck::records {

nlohmann::json enclosure_to_json(const Enclosure& enclosure) {
  return nlohmann::json::array(
      {cases::float64_to_json(enclosure.lo), cases::float64_to_json(enclosure.hi)});
}

Enclosure enclosure_from_json(const cases::JsonNode& node) {
  const auto [lo, hi] = node.two_elements("lower and upper end");
  const Enclosure enclosure{lo.float64(), hi.float64()};
  if (!(enclosure.lo <= enclosure.hi)) node.refuse("the lower end must not be above the upper");
  return enclosure;
}

}  // namespace rastercheck::records
