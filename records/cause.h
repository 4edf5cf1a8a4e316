#pragma once

// What many counterexamples have in common: as good as certainly one fault of a backend.

#include <cstdint>
#include <string>
#include <vector>

namespace rastercheck::records {

struct Cause {
  std::string backend;   ///< specification
  std::string sentence;  ///< "samples are missing where a sample lies exactly on an edge"
  /// Ids of what most of its counterexamples need (Explanation::needs); in their order.
  std::vector<std::string> needs;
  /// What was tried of the counterexample to read first, and what came of it: sentences.
  std::vector<std::string> tried;
  /// Places in the run's counterexamples, the one to read first in front.
  std::vector<std::uint64_t> counterexamples;
  bool operator==(const Cause&) const = default;
};

}  // namespace rastercheck::records
