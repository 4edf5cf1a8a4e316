#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cases/case.h"

namespace rastercheck::cases {

/// A case as the text of a case file; reading it back gives the same Case, bit for bit. Floats are
/// hex floats, keys at their default are left out, every vertex and triangle has a line of its own.
std::string to_json(const Case& c);

/// The same within another document, for records that have cases (json_members.h).
void write_value(nlohmann::json& to, const Case& c);

}  // namespace rastercheck::cases
