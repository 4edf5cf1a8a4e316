#pragma once

// The policy of the regression gate: which entries may be worse than the baseline, why and until
// when. A file written by the user:
//
//   {"format": "rastercheck-policy", "version": 1, "allow": [
//     {"property": "values-*", "backend": "cpu", "kind": "smooth", "stratum": "*",
//      "reason": "…", "until": "2026-12-31", "worst": 0.75}]}

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"
#include "records/comparison.h"

namespace rastercheck::gate {

inline constexpr std::uint64_t kPolicyVersion = 1;

/// A day such as "2026-12-31"; comparing texts compares days.
using Day = std::string;

/// One entry of a policy. Patterns are shell patterns, as in fnmatch(3); "*" if absent from the
/// file.
struct Allowance {
  std::string law = "*";
  std::string backend = "*";
  std::string kind = "*";
  std::string stratum = "*";  ///< "all": the entry of all strata together
  std::string reason = {};    ///< not empty
  Day until = {};             ///< the last valid day
  /// Limit for the largest |error|, in the kind's unit; empty: no limit.
  std::optional<double> worst = std::nullopt;
  bool operator==(const Allowance&) const = default;
};

struct Policy {
  std::string file;  ///< as the user named it; empty without a file
  std::vector<Allowance> allow;
  bool operator==(const Policy&) const = default;
};

/// Marks in the comparisons which worse entries the policy allows on that day: those that match an
/// allowance still valid then.
records::PolicyReview apply(const Policy& policy, const Day& today,
                            std::vector<records::Comparison>& comparisons);

/// Refuses all but the format above; `file` names the source in errors.
Result<Policy> parse_policy(std::string_view text, const std::string& file);
/// Parses a file, or standard input for "-".
Result<Policy> read_policy(const std::string& file);

}  // namespace rastercheck::gate
