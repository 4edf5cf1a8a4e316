#pragma once

// Specimens as JSON:
//
//   {"property": "…", "backend": "cpu", "origin": "random", "index": 12, "name": "…",
//    "triangle": 0, "left": 3, "top": 5, "width": 2, "height": 1, "samples": 1, "attributes": 1,
//    "rows": ["3f000000:40490fdb -"]}
//
// "name" is absent if empty. Each row of pixels is one text, with its samples, pixel by pixel,
// separated by spaces. A sample is "-" if not drawn, else depth and attributes: eight hexadecimal
// digits each, the bits of a float32, separated by colons.

#include <nlohmann/json_fwd.hpp>

#include "cases/json_members.h"
#include "records/specimen.h"

namespace rastercheck::records {

void write_value(nlohmann::json& to, const Specimen& specimen);
/// Refuses unknown and missing keys, parts above the size limits, and malformed rows.
void read_value(const cases::JsonNode& node, Specimen& specimen);

}  // namespace rastercheck::records
