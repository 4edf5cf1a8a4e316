#pragma once

// What earlier runs left in a run's folder, and how a new one begins there.

#include <functional>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/checkpoint.h"

namespace rastercheck::properties {

/// Told of what does not stop a run, and should be known.
using Warn = std::function<void(const Error&)>;

/// Where a new run begins: at nothing, but for the counterexamples that earlier runs left in the
/// folder, those of an unfinished one included: they are made files of, as the new run takes its
/// place. Of several shards only the first gets them, so that they are counted once. Warns of an
/// unfinished run, and of counterexamples that cannot be read. With `saved_in` those of that folder
/// are checked again instead.
Result<Checkpoint> begin_run(const records::Plan& plan, const std::string& directory,
                             const Warn& warn, const std::string& saved_in = "");

/// Where the folder's unfinished run had come to. Fails where there is none, or where `program`, a
/// version, is not the one that began it, or a law that it checks is gone.
Result<Checkpoint> resume_run(const std::string& directory, const std::string& program);

/// Whether the run can go on with this corpus, and with what is known of its backends: they have to
/// be those that it began with.
Result<void> check_same(const Checkpoint& checkpoint, const std::vector<cases::Case>& corpus,
                        const KnownByBackend& known);

}  // namespace rastercheck::properties
