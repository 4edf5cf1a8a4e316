#pragma once

// Begins or resumes a run in a folder that may hold the results of earlier runs.

#include <functional>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/checkpoint.h"

namespace rastercheck::properties {

/// Called with warnings: problems that do not stop a run.
using Warn = std::function<void(const Error&)>;

/// Returns the start of a new run, which holds only the counterexamples that earlier runs left in
/// the folder. The counterexamples of an unfinished run are among them: they are saved as files,
/// because the new run replaces that run. Only the first of several shards gets the
/// counterexamples, so that they count once. Warns of an unfinished run and of unreadable
/// counterexamples. If `saved_in` is given, its counterexamples are checked again instead.
Result<Checkpoint> begin_run(const records::Plan& plan, const std::string& directory,
                             const Warn& warn, const std::string& saved_in = "");

/// Returns the state of the folder's unfinished run. Fails if none exists, if another version than
/// `program` began it, or if one of its laws no longer exists.
Result<Checkpoint> resume_run(const std::string& directory, const std::string& program);

/// Fails unless the corpus and the known defects are those that the run began with.
Result<void> check_same(const Checkpoint& checkpoint, const std::vector<cases::Case>& corpus,
                        const KnownByBackend& known);

}  // namespace rastercheck::properties
