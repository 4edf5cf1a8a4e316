#pragma once

// The largest errors that a run recorded, and the cases that have them.

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "cases/case.h"
#include "properties/inspect/run_cases.h"
#include "records/judgement.h"
#include "records/plan.h"
#include "records/record.h"
#include "records/run.h"

namespace rastercheck::properties {

/// An error that a run recorded; refers to the run.
struct RunError {
  const records::RecordKey* key = nullptr;
  const records::WorstError* worst = nullptr;

  double size() const;  ///< |error|, at most; in the unit of the kind
};

/// By backend, kind and stratum of the values: the errors, the largest first. Of equal errors,
/// those of the law on values come first.
using LargestErrors = std::map<std::tuple<std::string, records::AttributeKind, records::Stratum>,
                               std::vector<RunError>>;

/// Returns, for each law and generator, the most negative and the most positive ideal error
/// (oracle/judge.h) of each backend, kind and stratum, except those of flat values, which are
/// copies.
LargestErrors largest_errors(const records::Run& run);

/// Returns the case whose check showed the error; empty if the case no longer exists. A law may
/// have measured the error on a changed version of the case.
std::optional<cases::Case> case_of(const RunError& error, const records::Plan& plan,
                                   const CaseSources& sources);

}  // namespace rastercheck::properties
