#pragma once

// Reads the rows of a probe by their names.

#include <algorithm>
#include <string>
#include <vector>

#include "records/probe.h"

namespace rastercheck::properties {

/// The row of that name; one that is measured as "no such row" if there is none.
inline const records::Measured& row(const records::Probe& probe, const std::string& what) {
  static const records::Measured kNone{"", "", "no such row", "", false, {}};
  const auto found = std::find_if(probe.rows.begin(), probe.rows.end(),
                                  [&](const records::Measured& one) { return one.what == what; });
  return found == probe.rows.end() ? kNone : *found;
}

inline std::string measured(const records::Probe& probe, const std::string& what) {
  return row(probe, what).measured;
}

/// The names of the rows that contradict what is declared.
inline std::vector<std::string> against(const records::Probe& probe) {
  std::vector<std::string> names;
  for (const records::Measured& one : probe.rows) {
    if (one.contradicts) names.push_back(one.what);
  }
  return names;
}

}  // namespace rastercheck::properties
