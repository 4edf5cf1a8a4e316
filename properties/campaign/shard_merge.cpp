#include "properties/campaign/shard_merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "cases/json.h"
#include "properties/campaign/campaign.h"
#include "properties/campaign/causes.h"

namespace rastercheck::properties {
namespace {

using records::Run;
using records::Shard;
using Environment = std::map<std::string, std::string>;

// --- Differences ---------------------------------------------------------------------------------

/// The first difference found between a shard and those before it.
class ShardDifference {
 public:
  explicit ShardDifference(std::string first) : first_(std::move(first)) {}

  template <typename Value>
  void compare(std::string_view what, const Value& here, const Value& there) {
    if (here != there) say(fmt::format("its {} is {}, not {}", what, here, there));
  }
  /// Compares lists: names an element that only one of them has.
  void compare(std::string_view what, const std::vector<std::string>& here,
               const std::vector<std::string>& there) {
    if (here == there) return;
    const auto missing = [](const auto& all, const auto& some) {
      return std::find_if(all.begin(), all.end(), [&some](const std::string& one) {
        return std::find(some.begin(), some.end(), one) == some.end();
      });
    };
    if (const auto one = missing(here, there); one != here.end()) {
      say(fmt::format("its {} include '{}', which the other shard lacks", what, *one));
    } else if (const auto other = missing(there, here); other != there.end()) {
      say(fmt::format("its {} lack '{}', which the other shard has", what, *other));
    } else {
      say(fmt::format("its {} are '{}', not '{}'", what, fmt::join(here, " "),
                      fmt::join(there, " ")));
    }
  }
  /// Compares values that are too large to be shown; `what` says that they differ.
  void expect(bool is_same, const std::string& what) {
    if (!is_same) say(what);
  }

  Result<void> result(const std::string& file) const {
    if (!said_) return {};
    return tl::unexpected(Error{
        file, "",
        cases::printable(fmt::format("belongs to another campaign than {}: {}", first_, *said_))});
  }

 private:
  void say(std::string text) {
    if (!said_) said_ = std::move(text);
  }

  std::string first_;
  std::optional<std::string> said_;
};

std::string value_of(const Environment& environment, const std::string& key) {
  const auto found = environment.find(key);
  return found == environment.end() ? "" : found->second;
}

/// Returns the driver to which each known list was applied: "gl:llvmpipe 22.3.6".
std::vector<std::string> drivers_of(const Run& run) {
  std::vector<std::string> drivers;
  drivers.reserve(run.known.size());
  for (const records::KnownOfBackend& known : run.known) {
    drivers.push_back(known.backend + " " + known.version);
  }
  return drivers;
}

/// True if the known lists of two shards are equal, wherever their files lie.
bool say_the_same(const records::KnownOfBackend& one, records::KnownOfBackend other) {
  other.file = one.file;
  return one == other;
}

/// Names the first backend whose promises differ.
std::string other_promises(const Shard& here, const Shard& there) {
  const auto [one, other] = std::mismatch(here.promises.begin(), here.promises.end(),
                                          there.promises.begin(), there.promises.end());
  return fmt::format("{} has another contract in the other shard",
                     one == here.promises.end() ? "a backend" : one->backend);
}

Result<void> check_same_campaign(const Run& here, const Run& there, const std::string& file,
                                 const std::string& first) {
  ShardDifference difference(first);
  difference.compare("program's version", value_of(here.environment, "version"),
                     value_of(there.environment, "version"));
  // A baseline is for one architecture only.
  difference.compare("architecture", value_of(here.environment, "architecture"),
                     value_of(there.environment, "architecture"));
  difference.compare("rules version", here.rules_version, there.rules_version);
  difference.compare("number of shards", here.plan.shard->count, there.plan.shard->count);
  difference.compare("seed", here.plan.seed, there.plan.seed);
  difference.compare("number of cases of each property", here.plan.cases_per_law,
                     there.plan.cases_per_law);
  difference.compare("backends", here.plan.backends, there.plan.backends);
  difference.compare("properties", here.plan.laws, there.plan.laws);
  difference.compare("options", records::option_words(here.plan),
                     records::option_words(there.plan));
  difference.compare("scene", "'" + here.plan.scene + "'", "'" + there.plan.scene + "'");
  difference.expect(here.plan.contract == there.plan.contract, "its contract file is different");
  difference.expect(here.plan.capabilities == there.plan.capabilities,
                    "its backends support other features");
  difference.compare("corpus' digest", here.shard->corpus_digest, there.shard->corpus_digest);
  difference.compare("known drivers", drivers_of(here), drivers_of(there));
  difference.expect(here.shard->known_digest == there.shard->known_digest &&
                        std::equal(here.known.begin(), here.known.end(), there.known.begin(),
                                   there.known.end(), &say_the_same),
                    "its lists of known defects are different");
  if (here.shard->promises != there.shard->promises) {
    difference.expect(false, other_promises(*here.shard, *there.shard));
  }
  return difference.result(file);
}

// --- Environment ---------------------------------------------------------------------------------

std::optional<double> number_in(const std::string& text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return stop == end && error == std::errc() ? std::optional(number) : std::nullopt;
}

/// Joins the shards' values of one key, each value once, in the order of the shards.
std::string all_said(const std::vector<std::string>& said) {
  std::vector<std::string> once;
  for (const std::string& one : said) {
    if (std::find(once.begin(), once.end(), one) == once.end()) once.push_back(one);
  }
  return fmt::format("{}", fmt::join(once, ", "));
}

std::string sum_of(const std::vector<std::string>& said) {
  double sum = 0;
  for (const std::string& one : said) sum += number_in(one).value_or(0);
  return fmt::format("{:.1f}", sum);
}

Environment merged_environment(const std::vector<Environment>& shards) {
  std::map<std::string, std::vector<std::string>> said;
  for (const Environment& environment : shards) {
    for (const auto& [key, value] : environment) said[key].push_back(value);
  }
  Environment merged{{"shards", std::to_string(shards.size())}};
  for (const auto& [key, values] : said) {
    if (key == "seconds") {
      merged[key] = sum_of(values);
    } else if (key == "date") {
      merged[key] = *std::max_element(values.begin(), values.end());
    } else {
      merged[key] = all_said(values);
    }
  }
  return merged;
}

// --- Missing shards ------------------------------------------------------------------------------

/// "shard 3 of 7 is missing", "shards 1 to 3 and 5 of 7 are missing".
std::string missing_sentence(const std::vector<std::uint64_t>& missing, std::uint64_t count) {
  std::vector<std::string> ranges;
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const std::uint64_t first = missing[i];
    while (i + 1 < missing.size() && missing[i + 1] == missing[i] + 1) ++i;
    const bool is_range = missing[i] > first + 1;
    if (is_range) {
      ranges.push_back(fmt::format("{} to {}", first, missing[i]));
    } else {
      for (std::uint64_t one = first; one <= missing[i]; ++one) {
        ranges.push_back(std::to_string(one));
      }
    }
  }
  std::string text = ranges.front();
  for (std::size_t i = 1; i < ranges.size(); ++i) {
    text += (i + 1 < ranges.size() ? ", " : " and ") + ranges[i];
  }
  const bool is_one = missing.size() == 1;
  return fmt::format("{} {} of {} {} missing", is_one ? "shard" : "shards", text, count,
                     is_one ? "is" : "are");
}

}  // namespace

Result<void> ShardMerge::check(const Run& run, const std::string& file) const {
  const auto refuse = [&file](const std::string& reason) {
    return tl::unexpected(Error{file, "", reason});
  };
  if (!run.shard || !run.plan.shard) return refuse("is not a shard: the run had no --shard option");
  const std::string name = "shard " + to_string(*run.plan.shard);
  if (!added_.empty()) {
    Result<void> same = check_same_campaign(run, first_, file, added_.begin()->second.file);
    if (!same) return same;
  }
  if (run.cases_left > 0 || !run.shard->is_whole) {
    const std::string what = run.cases_left == 0
                                 ? "before all counterexamples were shrunk"
                                 : fmt::format("with {} cases not checked", run.cases_left);
    return refuse(name + " was interrupted " + what + "; `rastercheck run --resume` continues it");
  }
  const auto other = added_.find(run.plan.shard->index);
  if (other != added_.end()) return refuse(name + " is given twice, also as " + other->second.file);
  for (const records::Counterexample& one : run.counterexamples) {
    if (!one.source.found) return refuse("a counterexample does not say how it was found");
  }
  return {};
}

Result<void> ShardMerge::add(Run run, const std::string& file) {
  Result<void> checked = check(run, file);
  if (!checked) return checked;
  added_[run.plan.shard->index] = {file, run.environment};
  if (!run.shard->scene_digest.empty()) scene_digest_ = run.shard->scene_digest;
  std::move(run.scenes.begin(), run.scenes.end(), std::back_inserter(scenes_));
  std::move(run.pictures.begin(), run.pictures.end(), std::back_inserter(pictures_));
  std::move(run.shard->saved.begin(), run.shard->saved.end(), std::back_inserter(saved_));
  merge(all_, {std::move(run.records), std::move(run.cases), std::move(run.outcomes),
               std::move(run.counterexamples), std::move(run.unexpected), std::nullopt});
  if (added_.size() > 1) return {};
  run.records.clear();
  run.cases.reset();
  run.outcomes.reset();
  run.counterexamples.clear();
  run.unexpected.clear();
  run.scenes.clear();
  run.pictures.clear();
  run.inspections.clear();
  run.specimens.clear();
  run.differences.clear();
  first_ = std::move(run);
  return {};
}

Result<MergedRun> ShardMerge::finish() && {
  if (added_.empty()) return tl::unexpected(Error{"merge", "", "no shards given"});
  const std::uint64_t count = first_.plan.shard->count;
  std::vector<std::uint64_t> missing;
  for (std::uint64_t index = 1; index <= count; ++index) {
    if (!added_.contains(index)) missing.push_back(index);
  }
  if (!missing.empty()) {
    return tl::unexpected(Error{"merge", "", missing_sentence(missing, count)});
  }
  MergedRun merged;
  std::vector<Environment> environments;
  for (auto& [index, added] : added_) {
    environments.push_back(std::move(added.environment));
    merged.files.push_back(std::move(added.file));
  }
  merged.run = std::move(first_);
  Run& run = merged.run;
  merged.common = *std::move(run.shard);
  merged.common.scene_digest = scene_digest_;
  merged.common.saved = std::move(saved_);
  run.shard.reset();
  run.plan.shard.reset();
  run.records = std::move(all_.records);
  run.cases = std::move(all_.cases);
  run.outcomes = std::move(all_.outcomes);
  run.counterexamples = std::move(all_.counterexamples);
  run.causes = causes_of(run.counterexamples);
  run.unexpected = std::move(all_.unexpected);
  run.scenes = std::move(scenes_);
  run.pictures = std::move(pictures_);
  run.unreached = unreached_labels(run.plan.laws, merged.common.promises, run.records);
  add_unexpected_passes(run);
  run.environment = merged_environment(environments);
  return merged;
}

}  // namespace rastercheck::properties
