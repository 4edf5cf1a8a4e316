#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rastercheck::reports {

/// Returns JSON in ASCII that no HTML parser mistakes for markup.
std::string embedded_json(const nlohmann::json& data);

}  // namespace rastercheck::reports
