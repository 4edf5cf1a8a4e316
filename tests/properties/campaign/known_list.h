#pragma once

// A list of known defects on disk, for the driver that damaged:driver claims to be: it loses the
// last fragment of draws with a scissor.

#include <string>

#include "cases/case_writer.h"
#include "tests/properties/damaged_backend.h"
#include "tests/temporary_folder.h"

namespace rastercheck::properties {

/// The square with a scissor that removes nothing, as the case of an entry.
inline cases::Case scissored_square() {
  cases::Case c = square();
  c.name = "square";
  c.scissor = cases::Scissor{0, 0, 8, 8};
  c.found = cases::Found{"coverage-obeys-the-contract", "damaged:driver", "missing", 1, 0};
  return c;
}

inline constexpr const char* kKnownList = R"({
  "format": "rastercheck-known", "version": 1,
  "driver": {"name": "damaged", "version": "1"},
  "entries": [{"id": "damaged-1", "reason": "A scissor loses the last fragment.",
    "rule": "section 1", "finding": "damaged-1", "properties": ["coverage-obeys-the-contract"],
    "verdicts": ["missing"], "when": {"scissor": true}, "case": "known/damaged-1.json"}]
})";

/// Writes the list and its case into the folder damaged/ of `folder`.
inline void put_known(const TemporaryFolder& folder, const std::string& list = kKnownList,
                      const cases::Case& c = scissored_square()) {
  folder.put("damaged/known.json", list);
  folder.put("damaged/known/damaged-1.json", cases::to_json(c));
}

}  // namespace rastercheck::properties
