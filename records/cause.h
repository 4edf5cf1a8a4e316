#pragma once

// The common cause of several counterexamples: almost certainly one fault of a backend.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rastercheck::records {

/// A simple change to cases that makes their wrong drawings right.
struct Hint {
  std::string change;       ///< a clause: "y points in the other direction"
  std::uint64_t right = 0;  ///< counterexamples that the change makes right
  std::uint64_t wrong = 0;  ///< counterexamples with wrong drawings
  bool operator==(const Hint&) const = default;
};

struct Cause {
  std::string backend;   ///< specification
  std::string sentence;  ///< "samples are missing where a sample lies exactly on an edge"
  /// Ids of the features that most of its counterexamples need (Explanation::needs), in the
  /// features' order.
  std::vector<std::string> needs;
  /// Sentences: what was tried on the counterexample that should be read first, and the result.
  std::vector<std::string> tried;
  /// Indices into the run's counterexamples; the counterexample that should be read first comes
  /// first.
  std::vector<std::uint64_t> counterexamples;
  std::optional<Hint> hint = std::nullopt;  ///< the change that makes most drawings right
  bool operator==(const Cause&) const = default;
};

}  // namespace rastercheck::records
