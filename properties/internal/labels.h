#pragma once

#include <algorithm>
#include <string>

#include "properties/law.h"

namespace rastercheck::properties {

/// Adds a label that the case reached; they stay in order, each once.
inline void add_label(Check& check, const std::string& label) {
  const auto at = std::lower_bound(check.labels.begin(), check.labels.end(), label);
  if (at == check.labels.end() || *at != label) check.labels.insert(at, label);
}

}  // namespace rastercheck::properties
