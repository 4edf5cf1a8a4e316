#pragma once

// What becomes of a case that a law is asked about: it is counted in a record, and where the law is
// violated, a counterexample is kept and made smaller.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "backends/backend.h"
#include "cases/case.h"
#include "properties/campaign/findings.h"
#include "properties/campaign/known_defects.h"
#include "properties/campaign/shrink.h"
#include "properties/law.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// A case to be checked, and where it comes from.
struct NumberedCase {
  cases::Case source;
  std::string stratum;
  std::uint64_t index = 0;
  records::Origin origin = records::Origin::random;
};

/// Checks a case and adds the outcome to the findings: counts, errors, labels, and, where the law
/// is violated and no case before it failed in the same way, a counterexample of each way: the one
/// triangle that suffices, if one does, else the case. What the case gave is kept as well where the
/// findings keep that. One that is violated in ways only that are `known` is counted as known
/// instead. A backend that is lost (Backend::is_lost) is not asked any more: each of its cases
/// fails. Returns whether the law says something of the case and held.
bool check_case(const Law& law, const std::string& specification, backends::Backend& backend,
                std::uint64_t seed, const NumberedCase& numbered, Findings& findings,
                const KnownDefects* known = nullptr);

/// A random case of which a law has nothing to say, or which the backend refuses, is drawn again,
/// at most so often (records::kRedrawn).
inline constexpr std::uint64_t kMostRedrawn = 3;

/// Checks a random case likewise, drawn again where it says nothing; why it does not is counted.
/// Returns the case if the law held of it.
std::optional<NumberedCase> check_random_case(const Law& law, const std::string& specification,
                                              backends::Backend& backend, std::uint64_t seed,
                                              std::uint64_t index,
                                              const cases::Capabilities& capabilities,
                                              Findings& findings,
                                              const KnownDefects* known = nullptr);

/// Checks the case of an entry of what is known and adds the outcome to the findings: known, where
/// its violations are of that entry, and a violation where they are not. Where the law holds that
/// is an unexpected pass; of a driver of the list's version it counts as a violation too, as the
/// list is stale.
void check_known_case(const Law& law, const std::string& specification, backends::Backend& backend,
                      std::uint64_t seed, const KnownDefects& known, std::size_t entry,
                      Findings& findings);

/// A drawing that fails is a violation of whatever was to be checked: what the backend says stands
/// in its note. Nothing is said of a case that the backend does not support, nor of one with
/// positions beyond float32, which no backend gets. Violations that nothing in `known` explains
/// come first.
Check check_or_note(const Law& law, const cases::Case& c, backends::Backend& backend,
                    std::uint64_t index, const KnownDefects* known = nullptr);

/// That check of a case whose drawing failed.
Check failed_check(const Error& error);

/// In a word, how a check of a case that the law speaks of came out: the class of its first
/// violation, or "held".
std::string verdict_of(const Check& check);

/// Puts the violations of a case that are of the verdict, kind and condition that `found` says
/// first; false where the check has none.
bool put_alike_first(Check& check, const cases::Case& c, const cases::Found& found);

/// Why a law says nothing of a case, as records count it: one of few texts, what follows a colon
/// left out. The check is not applicable.
std::string reason_of(const Law& law, backends::Backend& backend, const Check& check);

/// Adds what a check of a case gave to the findings: its record, and, where the findings keep that,
/// what the case gave. Returns whether the law is violated in ways that nothing known explains; the
/// counterexample is not kept yet.
bool account(const Law& law, const std::string& specification, backends::Backend& backend,
             const NumberedCase& numbered, const Check& check, Findings& findings);

/// Keeps a counterexample of the case in the findings, if none before it failed in the same way.
void keep_counterexample(const Law& law, const std::string& specification,
                         backends::Backend& backend, std::uint64_t seed,
                         const NumberedCase& numbered, const Check& check, Findings& findings,
                         const KnownDefects* known = nullptr);

/// The counterexample made as small as it gets while the law finds the same class of violation, one
/// that is not known, and looked at closely. One of several triangles that the backend hangs at
/// stays as it was found. `findings` gets it, and a fault where the oracle
/// failed meanwhile.
void shrink_counterexample(const Law& law, backends::Backend& backend,
                           const records::Counterexample& found, const ShrinkLimits& limits,
                           Findings& findings, const KnownDefects* known = nullptr);

}  // namespace rastercheck::properties
