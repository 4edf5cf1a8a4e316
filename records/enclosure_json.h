#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cases/json_members.h"
#include "records/enclosure.h"

namespace rastercheck::records {

/// [lo, hi], each a number that reads back as the same double, or "inf" or "-inf".
void write_value(nlohmann::json& to, const Enclosure& enclosure);

/// Refuses anything but an array of two doubles in ascending order.
void read_value(const cases::JsonNode& node, Enclosure& enclosure);

}  // namespace rastercheck::records
