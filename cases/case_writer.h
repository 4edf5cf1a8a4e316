#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cases/case.h"

namespace rastercheck::cases {

/// Formats a case as a case file; reading it back gives the same Case, bit for bit. Writes floats
/// as hex floats, omits most keys that have their default value, and gives every vertex and
/// triangle its own line.
std::string to_json(const Case& c);

/// Writes a case nested in another document, for records that contain cases (json_members.h).
void write_value(nlohmann::json& to, const Case& c);

}  // namespace rastercheck::cases
