#pragma once

// What a law finds in the first of its own cases, for tests of laws.

#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties {

struct Found {
  std::uint64_t violations = 0;
  std::set<std::string> notes;
  std::set<std::string> labels;
  std::set<std::string> strata;
};

inline Found find_in_cases(std::string_view law, DamagedBackend& backend, std::uint64_t count) {
  Found found;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Generated made = own_case(law, i);
    const Check check = check_law(*find_law(law), made.source, backend, i).value();
    found.violations += check.violation_count;
    for (const records::Violation& violation : check.violations) found.notes.insert(violation.note);
    found.labels.insert(check.labels.begin(), check.labels.end());
    found.strata.insert(made.stratum);
  }
  return found;
}

}  // namespace rastercheck::properties
