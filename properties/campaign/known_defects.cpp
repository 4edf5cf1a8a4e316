#include "properties/campaign/known_defects.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/files.h"
#include "cases/json.h"
#include "oracle/transform.h"
#include "properties/campaign/internal/known_conditions.h"
#include "properties/draw.h"
#include "records/known_json.h"

namespace rastercheck::properties {
namespace {

namespace fs = std::filesystem;
using records::KnownEntry;
using records::Violation;

bool is_of(const KnownEntry& entry, std::string_view law) {
  const std::string name(law);
  return std::any_of(entry.laws.begin(), entry.laws.end(), [&name](const std::string& pattern) {
    return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  });
}

bool has_verdict(const KnownEntry& entry, records::FragmentClass verdict) {
  return std::find(entry.verdicts.begin(), entry.verdicts.end(), verdict) != entry.verdicts.end();
}

/// A folder's name: a driver says its own name, and may say anything.
bool is_plain(std::string_view name) {
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
  });
}

/// What is wrong with an entry's case, in words; empty where nothing is.
std::string fault_of(const KnownEntry& entry, const cases::Case& c) {
  if (!c.found) return "has no 'found'";
  if (!is_of(entry, c.found->law)) return "is found by a law that is not of its entry";
  if (find_law(c.found->law) == nullptr) {
    return "there is no law '" + cases::printable(c.found->law) + "'";
  }
  const auto verdict = cases::from_name<records::FragmentClass>(c.found->verdict);
  if (!verdict || !has_verdict(entry, *verdict)) return "has a verdict that is not of its entry";
  return "";
}

/// The one pattern of an entry that no law has; empty where there is none.
std::string unknown_law(const KnownEntry& entry) {
  for (const std::string& pattern : entry.laws) {
    const auto all = laws();
    const bool is_there = std::any_of(all.begin(), all.end(), [&pattern](const Law& law) {
      return ::fnmatch(pattern.c_str(), std::string(law.id).c_str(), 0) == 0;
    });
    if (!is_there) return pattern;
  }
  return "";
}

Result<records::KnownList> read_list(const fs::path& folder) {
  const std::string file = (folder / "known.json").string();
  Result<records::KnownList> list = cases::read_text(file).and_then(
      [&file](const std::string& text) { return records::parse_known(text, file); });
  if (list && list->driver != folder.filename().string()) {
    return tl::unexpected(Error{file, "/driver/name", "is not the name of its folder"});
  }
  return list;
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

}  // namespace

Result<std::vector<records::KnownList>> read_known_lists(const std::string& directory) {
  std::error_code ignored;
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(directory, ignored)) {
    if (fs::exists(entry.path() / "known.json", ignored)) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  std::vector<records::KnownList> lists;
  for (const fs::path& folder : folders) {
    Result<records::KnownList> list = read_list(folder);
    if (!list) return tl::unexpected(list.error());
    lists.push_back(*std::move(list));
  }
  return lists;
}

Result<std::optional<KnownDefects>> read_known_defects(const std::string& directory,
                                                       backends::Backend& backend) {
  const std::optional<backends::Driver> driver = backend.about().driver;
  if (directory.empty() || !driver || !is_plain(driver->name)) return std::nullopt;
  const fs::path folder = fs::path(directory) / driver->name;
  const std::string file = (folder / "known.json").string();
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return std::nullopt;

  Result<records::KnownList> list = read_list(folder);
  if (!list) return tl::unexpected(list.error());
  KnownDefects known{*std::move(list), {}, *driver};
  for (std::size_t i = 0; i < known.list.entries.size(); ++i) {
    const KnownEntry& entry = known.list.entries[i];
    if (const std::string pattern = unknown_law(entry); !pattern.empty()) {
      return tl::unexpected(Error{file, fmt::format("/entries/{}/laws", i),
                                  "there is no law '" + cases::printable(pattern) + "'"});
    }
    Result<cases::Case> c = read_entry_case(entry, folder);
    if (!c) return tl::unexpected(c.error());
    known.cases.push_back(*std::move(c));
  }
  return known;
}

std::vector<std::string> entries_of(const KnownDefects& known, std::string_view law,
                                    const cases::Case& clip, const Violation& violation) {
  std::vector<std::string> ids;
  for (const KnownEntry& entry : known.list.entries) {
    if (is_of(entry, law) && has_verdict(entry, violation.fragment_class) &&
        meets(entry.when, clip, violation)) {
      ids.push_back(entry.id);
    }
  }
  return ids;
}

void tell_known(const KnownDefects& known, const Law& law, const cases::Case& c, Check& check) {
  if (check.violations.empty() || known.list.entries.empty()) return;
  const Result<cases::ClipCase> clip = oracle::to_clip_case(c, "");
  if (!clip) return;
  std::set<std::string> ids;
  const auto is_new = [&](const Violation& violation) {
    const std::vector<std::string> of = entries_of(known, law.id, *clip, violation);
    ids.insert(of.begin(), of.end());
    return of.empty();
  };
  const auto first_known =
      std::stable_partition(check.violations.begin(), check.violations.end(), is_new);
  if (first_known == check.violations.begin()) check.known.assign(ids.begin(), ids.end());
}

std::vector<std::size_t> entries_to_check(const KnownDefects& known,
                                          const std::vector<std::string>& laws) {
  std::vector<std::size_t> entries;
  for (std::size_t i = 0; i < known.cases.size(); ++i) {
    const std::string& law = known.cases[i].found->law;
    if (std::find(laws.begin(), laws.end(), law) != laws.end()) entries.push_back(i);
  }
  return entries;
}

std::string digest_of_known(const KnownByBackend& known) {
  std::string all;
  for (const auto& [backend, defects] : known) {
    all += backend + '\n' + defects.driver.name + '\n' + defects.driver.version + '\n' +
           cases::json_of(defects.list).dump();
    for (const cases::Case& c : defects.cases) all += cases::to_json(c);
  }
  return known.empty() ? "" : fmt::format("{:016x}", fnv1a(all));
}

}  // namespace rastercheck::properties
