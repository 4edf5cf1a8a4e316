#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cases/json_node.h"
#include "records/enclosure.h"

namespace rastercheck::records {

/// [lo, hi], each a number that reads back as the same double, or "inf" or "-inf".
nlohmann::json enclosure_to_json(const Enclosure& enclosure);

/// Refuses what is no array of two doubles, and ends in the wrong order.
Enclosure enclosure_from_json(const cases::JsonNode& node);

}  // namespace rastercheck::records
