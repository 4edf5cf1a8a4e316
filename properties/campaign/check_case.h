#pragma once

// Checks one case against a law, counts the outcome in a record, and for a violation keeps and
// shrinks a counterexample.

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

/// A case to check, with its source.
struct NumberedCase {
  cases::Case source;
  std::string stratum;
  std::uint64_t index = 0;
  records::Origin origin = records::Origin::random;
};

/// Checks a case and adds the outcome to the findings: counts, errors and labels; the case's own
/// result, if the findings keep case results; and a counterexample for each new way of failing. If
/// a single triangle suffices, the counterexample is that triangle alone, else the whole case. A
/// case with only `known` violations counts as known instead. A lost backend (Backend::is_lost) is
/// not asked again: each of its cases fails. Returns true if the law applied and held.
bool check_case(const Law& law, const std::string& specification, backends::Backend& backend,
                std::uint64_t seed, const NumberedCase& numbered, Findings& findings,
                const KnownDefects* known = nullptr);

/// Maximum number of times that a random case is generated anew if the law does not apply or the
/// backend refuses it (records::kRedrawn).
inline constexpr std::uint64_t kMostRedrawn = 3;

/// Checks a random case as check_case() does. If the law does not apply, counts the reason and
/// generates another case, at most kMostRedrawn times. A backend that draws everything, is lost or
/// does not promise the property gets no other case. Returns the case if the law held.
std::optional<NumberedCase> check_random_case(const Law& law, const std::string& specification,
                                              backends::Backend& backend, std::uint64_t seed,
                                              std::uint64_t index,
                                              const cases::Capabilities& capabilities,
                                              Findings& findings,
                                              const KnownDefects* known = nullptr);

/// Checks a known-defect entry's case and adds the outcome to the findings: known if its violations
/// match the entry, a violation if not. If the law holds, adds an unexpected pass. If the driver
/// has the version that the list was written for, the pass counts as a violation, because the list
/// is then wrong.
void check_known_case(const Law& law, const std::string& specification, backends::Backend& backend,
                      std::uint64_t seed, const KnownDefects& known, std::size_t entry,
                      Findings& findings);

/// Checks a law; turns a failed drawing into a violation with the backend's message in its note. A
/// case is not applicable if the backend does not support it, or if its clip positions are beyond
/// float32: no backend can be given such positions. Violations that `known` does not explain come
/// first.
Check check_or_note(const Law& law, const cases::Case& c, backends::Backend& backend,
                    std::uint64_t index, const KnownDefects* known = nullptr);

/// Returns the check of a case whose drawing failed.
Check failed_check(const Error& error);

/// Returns the verdict of an applicable check in a word: the class of its first violation, or
/// "held".
std::string verdict_of(const Check& check);

/// Moves the violations with `found`'s verdict, kind and condition to the front; returns false if
/// the check has none.
bool put_alike_first(Check& check, const cases::Case& c, const cases::Found& found);

/// Returns why a check is not applicable. After the first colon, "#" replaces each word that
/// contains a digit, so that records count only a few different texts.
std::string reason_of(const Law& law, backends::Backend& backend, const Check& check);

/// Adds a check to the findings: its record, and the case's own result if the findings keep these.
/// Returns true if the law is violated in a way that is not known; does not keep the counterexample
/// yet.
bool account(const Law& law, const std::string& specification, backends::Backend& backend,
             const NumberedCase& numbered, const Check& check, Findings& findings);

/// Keeps a counterexample of the case, unless an earlier one failed in the same way.
void keep_counterexample(const Law& law, const std::string& specification,
                         backends::Backend& backend, std::uint64_t seed,
                         const NumberedCase& numbered, const Check& check, Findings& findings,
                         const KnownDefects* known = nullptr);

/// Shrinks the counterexample while the law still finds the same class of violation, disregarding
/// known defects. Then adds a close-up. Does not shrink a case with several triangles on which the
/// backend hangs. Adds the result to `findings`, or a fault if the oracle failed meanwhile.
void shrink_counterexample(const Law& law, backends::Backend& backend,
                           const records::Counterexample& found, const ShrinkLimits& limits,
                           Findings& findings, const KnownDefects* known = nullptr);

}  // namespace rastercheck::properties
