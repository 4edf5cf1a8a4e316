#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cases/json_members.h"
#include "records/enclosure.h"

namespace rastercheck::records {

/// [lo, hi], each a number that reads back as the same double, or "inf" or "-inf".
void write_value(nlohmann::json& to, const Enclosure& enclosure);

/// Refuses what is no array of two doubles, and ends in the wrong order.
void read_value(const cases::JsonNode& node, Enclosure& enclosure);

}  // namespace rastercheck::records
