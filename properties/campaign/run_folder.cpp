#include "properties/campaign/run_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "cases/case_writer.h"
#include "cases/files.h"
#include "cases/json.h"
#include "properties/campaign/corpus.h"
#include "records/run.h"

namespace rastercheck::properties {
namespace {

namespace fs = std::filesystem;

Result<Checkpoint> read_checkpoint_file(const std::string& file) {
  return cases::read_text(file).and_then(
      [&file](const std::string& text) { return parse_checkpoint(text, file); });
}

/// Saves the counterexamples of an unfinished run as files.
Result<void> save_unfinished(const std::string& directory, const Warn& warn) {
  const std::string file = checkpoint_file(directory);
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return {};
  const Result<Checkpoint> read = read_checkpoint_file(file);
  if (!read) {
    warn(read.error());  // The file is replaced all the same: no run can resume from it.
    return {};
  }
  const std::size_t count = read->findings.counterexamples.size();
  warn({file, "",
        "is an unfinished run, which this one replaces (--resume would have continued it); "
        "counterexamples kept from it: " +
            std::to_string(count)});
  for (const records::Counterexample& one : read->findings.counterexamples) {
    const fs::path kept = fs::path(directory) / records::file_of(one);
    if (fs::exists(kept, ignored)) continue;
    fs::create_directories(kept.parent_path(), ignored);
    Result<void> written = cases::write_file(kept.string(), cases::to_json(one.source));
    if (!written) return written;
  }
  return {};
}

}  // namespace

Result<Checkpoint> begin_run(const records::Plan& plan, const std::string& directory,
                             const Warn& warn, const std::string& saved_in) {
  const Result<void> kept = save_unfinished(directory, warn);
  if (!kept) return tl::unexpected(kept.error());
  Checkpoint start;
  start.plan = plan;
  if (plan.shard && plan.shard->index != 1) return start;
  const fs::path origin = saved_in.empty() ? directory : saved_in;
  const std::string folder = (origin / "counterexamples").string();
  SavedCases saved = read_saved(folder, plan.laws, plan.backends);
  for (const Error& error : saved.unreadable) warn(error);
  start.saved = std::move(saved.cases);
  return start;
}

Result<Checkpoint> resume_run(const std::string& directory, const std::string& program) {
  const std::string file = checkpoint_file(directory);
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    return tl::unexpected(Error{file, "", "does not exist: no run was interrupted in this folder"});
  }
  Result<Checkpoint> read = read_checkpoint_file(file);
  if (!read) return read;
  const records::Plan& plan = read->plan;
  const auto refuse = [&file](const char* place, const std::string& reason) {
    return tl::unexpected(Error{file, place, reason});
  };
  if (read->program != program)
    return refuse("/program", "was started by another version of RasterCheck");
  if (plan.scene == "-")
    return refuse("/plan/scene", "was read from standard input, which cannot be read again");
  for (const std::string& law : plan.laws) {
    if (find_law(law) == nullptr) {
      return refuse("/plan/properties", "no property is called '" + cases::printable(law) + "'");
    }
  }
  return read;
}

Result<void> check_same(const Checkpoint& checkpoint, const std::vector<cases::Case>& corpus,
                        const KnownByBackend& known) {
  const records::Plan& plan = checkpoint.plan;
  if (digest_of_known(known) != checkpoint.known_digest) {
    return tl::unexpected(
        Error{plan.known.empty() ? "known defects" : fmt::format("{}", fmt::join(plan.known, ", ")),
              "", "changed since the run was started, or a driver changed"});
  }
  const std::size_t tasks = tasks_of(checkpoint, corpus.size(), known).size();
  if (digest_of(corpus) == checkpoint.corpus_digest && tasks == checkpoint.is_done.size())
    return {};
  return tl::unexpected(Error{plan.corpus.empty() ? "the corpus" : plan.corpus, "",
                              "changed since the run was started"});
}

}  // namespace rastercheck::properties
