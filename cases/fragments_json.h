#pragma once

// Fragments as `rastercheck render --json` prints them:
//
//   {"format": "rastercheck-fragments", "version": 1, "backend": "cpu", "fragments": [
//     {"triangle": 0, "x": 3, "y": 2, "sample": 0, "depth": "0x1p-1", "attributes": ["0x1p+0"]},
//     …
//   ]}
//
// A fragment without "sample" is at sample 0. Depths and attributes may also be JSON numbers.

#include <functional>
#include <string>
#include <string_view>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::cases {

/// Hands the text to `write` piece by piece, until `write` returns false.
void write_fragments(const Fragments& drawn, const std::string& backend,
                     const std::function<bool(std::string_view)>& write);

/// Reads the fragments of a case, in any order. `file` is the name used in errors.
Result<Fragments> parse_fragments(std::string_view text, const std::string& file, const Case& c);

}  // namespace rastercheck::cases
