#pragma once

// The key `picture` of a case file (docs/case-format.md).

#include <string>

#include "cases/json_node.h"
#include "cases/picture_layout.h"

namespace rastercheck::cases {

PictureLayout read_picture_layout(const JsonNode& node);
std::string to_json(const PictureLayout& layout);

}  // namespace rastercheck::cases
