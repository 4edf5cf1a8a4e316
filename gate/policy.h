#pragma once

// The policy of the regression gate: which entries may be worse than the baseline, why and until
// when. A file of the user's (policy_json.h):
//
//   {"format": "rastercheck-policy", "version": 1, "allow": [
//     {"law": "values-*", "backend": "cpu", "kind": "smooth", "stratum": "*",
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

/// A day, as "2026-12-31": digits in that order compare as days do.
using Day = std::string;

/// What one entry of a policy allows. Patterns are those of shells, as fnmatch(3) has them; "*"
/// where the file has none.
struct Allowance {
  std::string law = "*";
  std::string backend = "*";
  std::string kind = "*";
  std::string stratum = "*";  ///< "all" is that of all strata together
  std::string reason = {};    ///< not empty
  Day until = {};             ///< the last day on which it holds
  /// Up to which the largest magnitude may grow, in the kind's unit; nothing: by any amount.
  std::optional<double> worst = std::nullopt;
  bool operator==(const Allowance&) const = default;
};

struct Policy {
  std::string file;  ///< as the user named it; empty without one
  std::vector<Allowance> allow;
  bool operator==(const Policy&) const = default;
};

/// Notes in the comparisons what the policy allows on that day: an entry that is worse, if one
/// allowance that holds matches it.
records::PolicyReview apply(const Policy& policy, const Day& today,
                            std::vector<records::Comparison>& comparisons);

/// Refuses all but the format above; `file` names the source in errors.
Result<Policy> parse_policy(std::string_view text, const std::string& file);
/// The same from a file, or from standard input for "-".
Result<Policy> read_policy(const std::string& file);

}  // namespace rastercheck::gate
