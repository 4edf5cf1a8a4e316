#pragma once

// A law's own cases, with seed 1, and what the law finds in them.

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "backends/factory.h"
#include "properties/law.h"

namespace rastercheck::properties {

inline Generated own_case(std::string_view law, std::uint64_t index) {
  Draw draw = draw_of(*find_law(law), 1, index);
  return find_law(law)->generate(draw);
}

/// The findings of a law in its cases 0 to count − 1.
struct FoundInOwnCases {
  int applicable = 0;                  ///< number of cases
  int violated = 0;                    ///< number of cases
  std::uint64_t required = 0;          ///< number of samples
  std::map<std::string, int> reached;  ///< label → number of cases
  std::set<std::string> strata;        ///< of the cases with required samples

  std::set<std::string> labels() const {
    std::set<std::string> all;
    for (const auto& [label, cases] : reached) all.insert(label);
    return all;
  }
};

inline FoundInOwnCases check_own_cases(std::string_view law, backends::Backend& backend,
                                       std::uint64_t count) {
  FoundInOwnCases found;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Generated made = own_case(law, i);
    const Check check = check_law(*find_law(law), made.source, backend, i).value();
    found.applicable += check.is_applicable ? 1 : 0;
    found.violated += check.violation_count > 0 ? 1 : 0;
    found.required += check.judgement.counts.required;
    for (const std::string& label : check.labels) ++found.reached[label];
    if (check.judgement.counts.required > 0) found.strata.insert(made.stratum);
  }
  return found;
}

inline FoundInOwnCases check_own_cases(std::string_view law, const std::string& specification,
                                       std::uint64_t count) {
  return check_own_cases(law, *backends::make_backend(specification).value(), count);
}

}  // namespace rastercheck::properties
