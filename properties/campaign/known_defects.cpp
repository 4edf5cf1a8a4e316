#include "properties/campaign/known_defects.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/files.h"
#include "cases/json.h"
#include "oracle/transform.h"
#include "properties/campaign/internal/amendment.h"
#include "properties/campaign/internal/known_conditions.h"
#include "properties/campaign/internal/put_right.h"
#include "properties/draw.h"
#include "records/expectations.h"
#include "records/known_json.h"

namespace rastercheck::properties {
namespace {

namespace fs = std::filesystem;
using records::KnownEntry;
using records::KnownList;
using records::Staleness;
using records::Violation;

constexpr const char* kListName = "known.json";
constexpr std::string_view kPlugin = "plugin:";

bool has_verdict(const KnownEntry& entry, records::FragmentClass verdict) {
  return std::find(entry.verdicts.begin(), entry.verdicts.end(), verdict) != entry.verdicts.end();
}

/// True if a name is safe as a folder's name: drivers report their own names, which may contain
/// anything.
bool is_plain(std::string_view name) {
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
  });
}

/// Describes what is wrong with an entry's case; empty if nothing is wrong.
std::string fault_of(const KnownEntry& entry, const cases::Case& c) {
  if (!c.found) return "has no 'found'";
  if (!records::is_of_law(entry, c.found->law)) {
    return "violates a property that its entry does not name";
  }
  if (find_law(c.found->law) == nullptr) {
    return "no property is called '" + cases::printable(c.found->law) + "'";
  }
  if (entry.laws.empty()) return "";  // the law's verdict may differ from the drawing's
  const auto verdict = cases::from_name<records::FragmentClass>(c.found->verdict);
  if (!verdict || !has_verdict(entry, *verdict))
    return "has a verdict that its entry does not name";
  return "";
}

/// Returns the first pattern of an entry that matches no law; empty if all match.
std::string unknown_law(const KnownEntry& entry) {
  for (const std::string& pattern : entry.laws) {
    const KnownEntry of_pattern{.id = {}, .reason = {}, .laws = {pattern}};
    const auto all = laws();
    const bool is_there = std::any_of(all.begin(), all.end(), [&of_pattern](const Law& law) {
      return records::is_of_law(of_pattern, law.id);
    });
    if (!is_there) return pattern;
  }
  return "";
}

/// A list on disk.
struct FoundList {
  std::string file;
  KnownList list;
};

Result<FoundList> read_file(const std::string& file) {
  const std::optional<records::Expected> expected = records::expected_by(file);
  return cases::read_text(file)
      .and_then([&](const std::string& text) {
        return expected ? records::parse_expectations(text, *expected, file)
                        : records::parse_known(text, file);
      })
      .map([&file](KnownList&& list) {
        return FoundList{file, std::move(list)};
      });
}

Result<FoundList> read_of_driver(const fs::path& folder) {
  Result<FoundList> found = read_file((folder / kListName).string());
  if (!found) return found;
  const std::optional<records::KnownDriver>& driver = found->list.driver;
  if (!driver || driver->name != folder.filename().string()) {
    return tl::unexpected(Error{found->file, "/driver/name", "is not the name of its folder"});
  }
  return found;
}

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool is_folder(const std::string& source) {
  std::error_code ignored;
  return fs::is_directory(source, ignored);
}

/// Returns the canonical path of a file.
fs::path canonical(const std::string& file) {
  std::error_code ignored;
  return fs::weakly_canonical(file, ignored);
}

/// Returns the lists of all sources that may apply to a backend.
Result<std::vector<FoundList>> lists_for(const KnownSources& sources,
                                         const std::string& specification,
                                         const std::optional<backends::Driver>& driver) {
  std::vector<FoundList> all;
  const auto add = [&all](Result<FoundList> found) -> Result<void> {
    if (!found) return tl::unexpected(found.error());
    all.push_back(*std::move(found));
    return {};
  };
  std::set<fs::path> files;
  for (const std::string& source : sources) {
    if (is_folder(source)) {
      const fs::path folder = fs::path(source) / (driver ? driver->name : "");
      const bool has_list = driver && is_plain(driver->name) && is_there(folder / kListName);
      if (!has_list) continue;
      if (Result<void> added = add(read_of_driver(folder)); !added) {
        return tl::unexpected(added.error());
      }
    } else if (files.insert(canonical(source)).second) {
      if (Result<void> added = add(read_file(source)); !added) {
        return tl::unexpected(added.error());
      }
    }
  }
  const std::string beside = sources.empty() ? "" : list_beside(specification);
  if (!beside.empty() && is_there(beside) && !files.contains(canonical(beside))) {
    if (Result<void> added = add(read_file(beside)); !added) {
      return tl::unexpected(added.error());
    }
  }
  return all;
}

Result<cases::Case> read_entry_case(const KnownEntry& entry, const fs::path& folder) {
  const std::string file = (folder / entry.case_file).string();
  Result<cases::Case> c = cases::read_case(file);
  if (!c) return c;
  if (const std::string fault = fault_of(entry, *c); !fault.empty()) {
    return tl::unexpected(Error{file, "/found", fault});
  }
  if (c->name.empty()) c->name = entry.id;
  return c;
}

Staleness staleness_of(const KnownList& list, const std::optional<backends::Driver>& driver) {
  if (!list.driver) return Staleness::waiver;
  return driver && driver->version == list.driver->version ? Staleness::wrong_list
                                                           : Staleness::other_version;
}

/// Adds those entries of a list that apply to the backend.
Result<void> add_list(FoundList found, const std::string& specification,
                      const std::optional<backends::Driver>& driver, KnownDefects& known) {
  const bool is_of_other =
      found.list.driver && (!driver || driver->name != found.list.driver->name);
  if (is_of_other) return {};
  records::KnownOfBackend of_backend{
      specification, found.file, driver ? driver->version : "", {found.list.driver, {}}, {}};
  const std::vector<std::string> names{specification, known_name_of(specification)};
  const fs::path folder = fs::path(found.file).parent_path();
  for (std::size_t i = 0; i < found.list.entries.size(); ++i) {
    KnownEntry& entry = found.list.entries[i];
    if (const std::string pattern = unknown_law(entry); !pattern.empty()) {
      return tl::unexpected(
          Error{found.file, entry.expected ? entry.id : fmt::format("/entries/{}/properties", i),
                "no property is called '" + cases::printable(pattern) + "'"});
    }
    if (!records::is_of_backend(entry, names)) continue;
    of_backend.list.entries.push_back(entry);
    const bool has_run_out = !entry.until.empty() && entry.until < today();
    if (has_run_out) of_backend.run_out.push_back(entry.id);
    if (entry.expected == records::Expected::skip) continue;
    const auto other =
        std::find_if(known.defects.begin(), known.defects.end(),
                     [&entry](const KnownDefect& one) { return one.entry.id == entry.id; });
    if (other != known.defects.end()) {
      if (other->entry == entry) continue;  // a copy of the list, as `rastercheck bisect` makes one
      return tl::unexpected(
          Error{found.file, cases::printable(entry.id), "is also in another list of the backend"});
    }
    KnownDefect defect{entry, std::nullopt, staleness_of(found.list, driver), has_run_out};
    if (!entry.expected) {
      Result<cases::Case> c = read_entry_case(entry, folder);
      if (!c) return tl::unexpected(c.error());
      defect.shown = *std::move(c);
    }
    known.defects.push_back(std::move(defect));
  }
  if (!of_backend.list.entries.empty()) known.lists.push_back(std::move(of_backend));
  return {};
}

}  // namespace

std::string list_beside(const std::string& specification) {
  if (!specification.starts_with(kPlugin)) return "";
  return (fs::path(specification.substr(kPlugin.size())).parent_path() / kListName).string();
}

std::string known_name_of(const std::string& specification) {
  if (!specification.starts_with(kPlugin)) return specification;
  return std::string(kPlugin) + fs::path(specification.substr(kPlugin.size())).filename().string();
}

std::string today() {
  return fmt::format(
      "{:%Y-%m-%d}",
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

std::vector<cases::Case> KnownDefects::cases() const {
  std::vector<cases::Case> all;
  for (const KnownDefect& one : defects) {
    if (one.shown) all.push_back(*one.shown);
  }
  return all;
}

bool KnownDefects::is_skipped(std::string_view law) const {
  return std::any_of(lists.begin(), lists.end(), [law](const records::KnownOfBackend& known) {
    const auto& entries = known.list.entries;
    return std::any_of(entries.begin(), entries.end(), [&](const KnownEntry& entry) {
      return records::is_skipped_by(known, entry) && records::is_of_law(entry, law);
    });
  });
}

Result<std::vector<KnownList>> read_known_lists(const KnownSources& sources) {
  std::vector<KnownList> lists;
  for (const std::string& source : sources) {
    if (!is_folder(source)) {
      Result<FoundList> found = read_file(source);
      if (!found) return tl::unexpected(found.error());
      lists.push_back(std::move(found->list));
      continue;
    }
    std::error_code ignored;
    std::vector<fs::path> folders;
    for (const auto& entry : fs::directory_iterator(source, ignored)) {
      if (is_there(entry.path() / kListName)) folders.push_back(entry.path());
    }
    std::sort(folders.begin(), folders.end());
    for (const fs::path& folder : folders) {
      Result<FoundList> found = read_of_driver(folder);
      if (!found) return tl::unexpected(found.error());
      lists.push_back(std::move(found->list));
    }
  }
  return lists;
}

Result<std::optional<KnownDefects>> read_known_defects(const KnownSources& sources,
                                                       const std::string& specification,
                                                       backends::Backend& backend) {
  const std::optional<backends::Driver> driver = backend.about().driver;
  Result<std::vector<FoundList>> lists = lists_for(sources, specification, driver);
  if (!lists) return tl::unexpected(lists.error());
  KnownDefects known;
  for (FoundList& found : *lists) {
    const Result<void> added = add_list(std::move(found), specification, driver, known);
    if (!added) return tl::unexpected(added.error());
  }
  return known.lists.empty() ? std::nullopt : std::optional(std::move(known));
}

namespace {

/// True if a violation meets an entry's verdicts and conditions.
bool meets_entry(const KnownEntry& entry, const cases::Case& clip, const Violation& violation) {
  return has_verdict(entry, violation.fragment_class) && meets(entry.when, clip, violation);
}

}  // namespace

std::vector<std::string> entries_of(const KnownDefects& known, std::string_view law,
                                    const cases::Case& clip, const Violation& violation) {
  std::vector<std::string> ids;
  for (const KnownDefect& defect : known.defects) {
    const KnownEntry& entry = defect.entry;
    if (defect.has_run_out) continue;
    const bool is_of_laws = !entry.laws.empty() && records::is_of_law(entry, law);
    if (is_of_laws && meets_entry(entry, clip, violation)) ids.push_back(entry.id);
  }
  return ids;
}

std::vector<std::string> entries_of_drawing(const KnownDefects& known, const cases::Case& clip,
                                            const Violation& violation) {
  std::vector<std::string> ids;
  for (const KnownDefect& defect : known.defects) {
    const KnownEntry& entry = defect.entry;
    if (defect.has_run_out || !entry.laws.empty()) continue;
    if (meets_entry(entry, clip, violation)) ids.push_back(entry.id);
  }
  return ids;
}

backends::Backend::Amendment known_amendment(const KnownDefects& known,
                                             const backends::Backend& backend,
                                             std::set<std::string>* seen) {
  return [&known, &backend, seen](const cases::Case& clip, cases::Fragments& drawn) {
    put_right(
        clip, backend.contract(clip),
        [&](const Violation& violation) {
          const std::vector<std::string> ids = entries_of_drawing(known, clip, violation);
          if (seen != nullptr) seen->insert(ids.begin(), ids.end());
          return !ids.empty();
        },
        drawn);
  };
}

void tell_expected(const KnownDefects& known, std::string_view law, Check& check) {
  if (check.violation_count == 0) return;
  for (const KnownDefect& defect : known.defects) {
    const KnownEntry& entry = defect.entry;
    const bool is_of = entry.expected && records::is_of_law(entry, law);
    if (is_of && !defect.has_run_out) check.known.push_back(entry.id);
  }
}

namespace {

/// Moves violations that no entry of the law explains to the front. If entries explain all
/// violations, adds the entries' ids and returns true.
bool are_of_law_entries(const KnownDefects& known, const Law& law, const cases::Case& clip,
                        std::vector<Violation>& violations, std::set<std::string>& ids) {
  std::set<std::string> some;
  const auto is_new = [&](const Violation& violation) {
    const std::vector<std::string> of = entries_of(known, law.id, clip, violation);
    some.insert(of.begin(), of.end());
    return of.empty();
  };
  const auto first_known = std::stable_partition(violations.begin(), violations.end(), is_new);
  const bool are_all = first_known == violations.begin() && !violations.empty();
  if (are_all) ids.insert(some.begin(), some.end());
  return are_all;
}

/// Checks the law with all known faults of drawings corrected, and adds the ids of the faults that
/// occur. Empty if none occurs.
std::optional<Check> put_known_right(const KnownDefects& known, const Law& law,
                                     const cases::Case& c, backends::Backend& backend,
                                     std::uint64_t index, const Check& check,
                                     std::set<std::string>& ids) {
  const bool is_some = std::any_of(known.defects.begin(), known.defects.end(), [](const auto& one) {
    return !one.has_run_out && one.entry.laws.empty();
  });
  const bool is_drawn = check.violations.empty() || check.violations.front().has_place();
  if (!is_some || !is_drawn) return std::nullopt;
  std::set<std::string> seen;
  Result<Check> again;
  {
    const MoreAmended amended(backend, known_amendment(known, backend, &seen));
    again = check_law(law, c, backend, index);
  }
  if (!again || !again->is_applicable || seen.empty()) return std::nullopt;
  if (again->violation_count == 0 && !again->fault) {
    // An unsteady violation is not known merely because it did not recur.
    const Result<Check> as_before = check_law(law, c, backend, index);
    if (!as_before || as_before->violation_count == 0) return std::nullopt;
  }
  ids.insert(seen.begin(), seen.end());
  return *std::move(again);
}

}  // namespace

void tell_known(const KnownDefects& known, const Law& law, const cases::Case& c,
                backends::Backend& backend, std::uint64_t index, Check& check) {
  const bool is_violated = check.is_applicable && !check.fault && check.violation_count > 0;
  if (!is_violated || known.defects.empty()) return;
  std::set<std::string> ids;
  bool is_known = false;
  if (const Result<cases::ClipCase> clip = oracle::to_clip_case(c, "")) {
    is_known = are_of_law_entries(known, law, *clip, check.violations, ids);
    std::optional<Check> again;
    if (!is_known) again = put_known_right(known, law, c, backend, index, check, ids);
    if (again && again->fault) {
      check.fault = std::move(again->fault);
      return;
    }
    if (again && again->violation_count == 0) {
      is_known = true;
    } else if (again) {
      check.violation_count = again->violation_count;
      check.violations = std::move(again->violations);
      is_known = are_of_law_entries(known, law, *clip, check.violations, ids);
    }
  }
  if (is_known) check.known.assign(ids.begin(), ids.end());
  tell_expected(known, law.id, check);
}

std::vector<std::size_t> entries_to_check(const KnownDefects& known,
                                          const std::vector<std::string>& laws) {
  std::vector<std::size_t> entries;
  for (std::size_t i = 0; i < known.defects.size(); ++i) {
    const std::optional<cases::Case>& shown = known.defects[i].shown;
    if (!shown || known.defects[i].has_run_out) continue;
    const bool is_run = std::find(laws.begin(), laws.end(), shown->found->law) != laws.end();
    if (is_run && !known.is_skipped(shown->found->law)) entries.push_back(i);
  }
  return entries;
}

void add_unexpected_passes(records::Run& run) {
  for (const records::KnownOfBackend& known : run.known) {
    for (const KnownEntry& entry : known.list.entries) {
      if (entry.expected != records::Expected::fail) continue;
      records::CaseCounts counts;
      for (const auto& [key, record] : run.records) {
        const bool is_of = key.backend == known.backend && records::is_of_law(entry, key.law);
        if (is_of) records::merge(counts, record.cases);
      }
      const bool has_held = counts.checked > 0 && counts.violations == 0 && counts.known == 0;
      if (!has_held) continue;
      run.unexpected.push_back({known.backend, entry.id, entry.laws.front(), Staleness::waiver});
    }
  }
  std::sort(run.unexpected.begin(), run.unexpected.end());
}

std::string digest_of_known(const KnownByBackend& known) {
  std::string all;
  for (const auto& [backend, defects] : known) {
    all += backend + '\n';
    // Excludes the files' names: another shard may have them elsewhere.
    for (const records::KnownOfBackend& list : defects.lists) {
      all += list.version + '\n' + cases::json_of(list.list).dump() + '\n' +
             fmt::format("{}", fmt::join(list.run_out, ",")) + '\n';
    }
    for (const KnownDefect& one : defects.defects) {
      if (one.shown) all += cases::to_json(*one.shown);
    }
  }
  return known.empty() ? "" : fmt::format("{:016x}", fnv1a(all));
}

}  // namespace rastercheck::properties
