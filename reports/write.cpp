#include "reports/write.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/files.h"
#include "reports/format.h"

namespace rastercheck::reports {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCounterexamples = "counterexamples";
constexpr std::string_view kDifferences = "differences";
constexpr std::string_view kEarlier = "earlier";  ///< subfolder of each of these two

Error failure(const fs::path& file, std::string_view what, const std::error_code& why) {
  return {file.string(), "", std::string(what) + (why ? ": " + why.message() : "")};
}

Result<void> make_folder(const fs::path& folder) {
  std::error_code why;
  fs::create_directories(folder, why);
  if (why) return tl::unexpected(failure(folder, "cannot be made", why));
  return {};
}

/// The origin of a case file that a run of this tool wrote. Empty unless the file holds a case
/// whose `found` gives the file's name.
std::optional<cases::Found> found_in(const fs::path& file) {
  std::error_code ignored;
  if (file.extension() != ".json" || !fs::is_regular_file(file, ignored)) return std::nullopt;
  const Result<cases::Case> source = cases::read_case(file.string());
  const bool is_ours =
      source && source->found &&
      fs::path(records::file_of(records::Counterexample{*source, 0, {}})).filename() ==
          file.filename();
  return is_ours ? source->found : std::nullopt;
}

/// True if the case may still fail: it belongs to the run's laws and backends, but the run may not
/// have checked it, because it ended early or is a shard other than the first. Only the first shard
/// checks such cases.
bool may_fail_still(const records::Run& run, const cases::Found& found) {
  const auto has = [](const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  const bool is_part = run.cases_left > 0 || (run.plan.shard && run.plan.shard->index != 1);
  return is_part && has(run.plan.laws, found.law) && has(run.plan.backends, found.backend);
}

/// True for a file of differences/ that a run of this tool wrote.
bool is_difference(const fs::path& file) {
  std::error_code ignored;
  if (file.extension() != ".json" || !fs::is_regular_file(file, ignored)) return false;
  const Result<cases::Case> source = cases::read_case(file.string());
  if (!source || !source->found) return false;
  const fs::path start = records::file_of(records::Difference{*source, ""});
  // Compares only the start of the name: the rest names the other backend, which the case file does
  // not store.
  const std::string name = start.filename().string();
  return file.filename().string().starts_with(name.substr(0, name.rfind("-right")));
}

/// Moves files of earlier runs that are not among `current` into a folder of their own.
template <typename IsStale>
Result<void> put_earlier_aside(const fs::path& folder, const std::set<fs::path>& current,
                               const IsStale& is_stale) {
  std::error_code why;
  if (!fs::exists(folder, why)) return {};
  // List all files before moving any: to move files during the listing would make its result
  // undefined.
  std::vector<fs::path> stale;
  for (auto entry = fs::directory_iterator(folder, why); !why && entry != fs::directory_iterator();
       entry.increment(why)) {
    if (!current.contains(entry->path()) && is_stale(entry->path())) stale.push_back(entry->path());
  }
  if (why) return tl::unexpected(failure(folder, "cannot be listed", why));
  const fs::path aside = folder / kEarlier;
  for (const fs::path& file : stale) {
    Result<void> made = make_folder(aside);
    if (!made) return made;
    fs::rename(file, aside / file.filename(), why);
    if (why) return tl::unexpected(failure(file, "cannot be moved", why));
  }
  return {};
}

/// Writes a case file. `written` has the files written so far.
Result<void> write_case(const cases::Case& source, const fs::path& file,
                        std::set<fs::path>& written) {
  if (!written.insert(file).second) {
    return tl::unexpected(failure(file, "two cases would have this name", {}));
  }
  return make_folder(file.parent_path()).and_then([&] {
    return cases::write_file(file.string(), cases::to_json(source));
  });
}

/// Writes the counterexamples. Moves away those of earlier runs: either this run checked them and
/// found another failure or none, or it did not check their laws and backends at all.
Result<void> write_counterexamples(const records::Run& run, const fs::path& directory) {
  std::set<fs::path> written;
  for (const records::Counterexample& counterexample : run.counterexamples) {
    Result<void> done =
        write_case(counterexample.source, directory / records::file_of(counterexample), written);
    if (!done) return done;
  }
  return put_earlier_aside(directory / kCounterexamples, written, [&run](const fs::path& file) {
    const std::optional<cases::Found> found = found_in(file);
    return found && !may_fail_still(run, *found);
  });
}

/// Writes the cases on which backends differ, and moves away those of earlier runs.
Result<void> write_differences(const records::Run& run, const fs::path& directory) {
  std::set<fs::path> written;
  for (const records::Difference& difference : run.differences) {
    Result<void> done =
        write_case(difference.source, directory / records::file_of(difference), written);
    if (!done) return done;
  }
  return put_earlier_aside(directory / kDifferences, written, &is_difference);
}

}  // namespace

Result<void> write_reports(const records::Run& run, const std::string& directory,
                           std::span<const std::string> format_names) {
  // Check the formats before anything is written.
  std::vector<Format> chosen;
  for (const std::string& name : format_names) {
    const Result<Format> format = find_format(name);
    if (!format) return tl::unexpected(format.error());
    if (format->needs_cases && !run.cases) {
      return tl::unexpected(Error{std::string(format->file_name), "",
                                  "the run kept no cases (`rastercheck run --keep-cases` does)"});
    }
    chosen.push_back(*format);
  }
  Result<void> done = make_folder(directory)
                          .and_then([&] { return write_counterexamples(run, directory); })
                          .and_then([&] { return write_differences(run, directory); });
  for (std::size_t i = 0; done && i < chosen.size(); ++i) {
    done = cases::write_file((fs::path(directory) / chosen[i].file_name).string(),
                             chosen[i].write(run));
  }
  return done;
}

}  // namespace rastercheck::reports
