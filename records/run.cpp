#include "records/run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rastercheck::records {
namespace {

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// Says that the run is only a shard, and how to merge the shards.
std::string shard_sentence(const Run& run) {
  const ShardNumber& number = *run.plan.shard;
  const std::string rest =
      run.records.empty() && run.cases_left == 0
          ? "it had no work to do"
          : "one part of the campaign, which cannot tell whether labels were reached";
  return fmt::format("Shard {}: {}; `rastercheck merge` combines all {}.", to_string(number), rest,
                     number.count);
}

}  // namespace

std::string drawn_by_key(const std::string& backend) { return "drawn by " + backend; }

const std::string& sentence_of(const Run& run, const std::string& law) {
  const auto found = run.sentences.find(law);
  return found == run.sentences.end() ? law : found->second;
}

std::string unreached_sentence(const UnreachedLabel& label) {
  return fmt::format("Not reached: {} on {}: '{}' in {} of {} cases; at least {} were required.",
                     label.law, label.backend, label.label, label.reached, label.checked,
                     label.least);
}

namespace {

const char* meaning_of(Staleness staleness) {
  switch (staleness) {
    case Staleness::wrong_list:
      return "the list of known defects is wrong, which counts as a violation.";
    case Staleness::other_version:
      return "this is only a warning, because the list is for another version of the driver.";
    case Staleness::waiver:
      break;
  }
  return "its entry can be removed.";
}

}  // namespace

std::string unexpected_sentence(const UnexpectedPass& pass) {
  // The id of an entry from an expectation list names its law (expectations.h).
  if (pass.id == pass.law || pass.id.ends_with("/" + pass.law)) {
    return fmt::format(
        "Unexpected pass: {} was expected to fail on {}, but nothing violates it; its line can be "
        "removed.",
        pass.law, pass.backend);
  }
  return fmt::format("Unexpected pass: the case of {} no longer violates {} on {}; {}", pass.id,
                     pass.law, pass.backend, meaning_of(pass.staleness));
}

std::vector<SkippedLaw> skipped_laws(const Run& run) {
  std::vector<SkippedLaw> all;
  for (const KnownOfBackend& known : run.known) {
    for (const KnownEntry& entry : known.list.entries) {
      if (!is_skipped_by(known, entry)) continue;
      for (const std::string& law : run.plan.laws) {
        if (is_of_law(entry, law)) all.push_back({known.backend, law, known.file});
      }
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

namespace {

const char* words_of(cases::DriverPromise promise) {
  switch (promise) {
    case cases::DriverPromise::spec:
      return "the text of its API";
    case cases::DriverPromise::conformance:
      return "the limits of Khronos' conformance tests";
    case cases::DriverPromise::ieee:
      break;
  }
  return "float32 arithmetic, which no API promises; violations are worse than that";
}

/// Adds sentences about lists for another version of the driver, about entries past their last day,
/// and about skipped laws.
void add_known_caveats(const Run& run, std::vector<std::string>& all) {
  for (const KnownOfBackend& known : run.known) {
    if (known.list.driver && known.version != known.list.driver->version) {
      all.push_back(fmt::format("The known defects of {} were found with {}; this is {}.",
                                known.backend, known.list.driver->version, known.version));
    }
    for (const KnownEntry& entry : known.list.entries) {
      const bool has_run_out =
          std::find(known.run_out.begin(), known.run_out.end(), entry.id) != known.run_out.end();
      if (!has_run_out) continue;
      all.push_back(fmt::format("Known defect {} of {} expired after {} and counts again ({}).",
                                entry.id, known.backend, entry.until, known.file));
    }
  }
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> skipped;
  for (const SkippedLaw& one : skipped_laws(run)) {
    skipped[{one.backend, one.file}].push_back(one.law);
  }
  for (const auto& [key, laws] : skipped) {
    all.push_back(fmt::format("Skipped on {} by {}: {} {}, {}.", key.first, key.second, laws.size(),
                              laws.size() == 1 ? "property" : "properties", fmt::join(laws, ", ")));
  }
}

}  // namespace

std::vector<std::string> caveats(const Run& run) {
  std::vector<std::string> all;
  if (run.shard) all.push_back(shard_sentence(run));
  if (run.plan.contract) {
    all.push_back(fmt::format("Judged by the contract in {}, not by the backends' own promises.",
                              run.plan.contract->file));
  }
  for (const auto& [backend, promise] : run.held_to) {
    all.push_back(fmt::format("{}{} is judged by {} (--promise {}).",
                              run.plan.contract ? "Where the contract says nothing, " : "", backend,
                              words_of(promise), to_string(promise)));
  }
  if (run.cases_left > 0) {
    all.push_back(
        fmt::format("The run ended early: {} of its cases were not checked.", run.cases_left));
  }
  if (run.plan.shrinking.seconds) {
    all.push_back(fmt::format(
        "Shrinking was limited to {} s per counterexample, so their sizes depend on the machine.",
        *run.plan.shrinking.seconds));
  }
  add_known_caveats(run, all);
  std::map<std::string, std::uint64_t> given_up;
  for (const auto& [key, record] : run.records) {
    const auto label = record.labels.find(std::string(kGivenUp));
    if (label != record.labels.end()) given_up[key.backend] += label->second;
  }
  for (const auto& [backend, cases] : given_up) {
    all.push_back(
        fmt::format("{} crashed or hung so often that it was given up: {} of its cases were not "
                    "drawn and count as violations.",
                    backend, cases));
  }
  return all;
}

std::string file_word(std::string_view text) {
  // ASCII only, whatever the locale, so that every system and archive accepts the file name
  // unchanged.
  std::string word;
  for (const char c : text) word += is_letter_or_digit(c) ? c : '-';
  return word;
}

std::string random_case_text(const cases::Found& found) {
  const std::uint64_t times = found.index / kRedrawn;
  std::string text = fmt::format("case {} of seed {}", found.index % kRedrawn, found.seed);
  if (times == 0) return text;
  if (times <= 2) return text + (times == 1 ? ", drawn again once" : ", drawn again twice");
  return text + fmt::format(", drawn again {} times", times);
}

std::vector<std::string> special_words(const cases::Found& found) {
  std::vector<std::string> words;
  if (!found.kind.empty() && found.kind != to_string(AttributeKind::coverage)) {
    words.push_back(found.kind);
  }
  if (!found.condition.empty() && found.condition != "ordinary") words.push_back(found.condition);
  return words;
}

std::string file_of(const Counterexample& counterexample) {
  const cases::Found found = counterexample.source.found.value_or(cases::Found());
  std::string name = fmt::format("{}-{}-{}", file_word(found.law), file_word(found.backend),
                                 file_word(found.verdict));
  for (const std::string& word : special_words(found)) name += "-" + file_word(word);
  return fmt::format("counterexamples/{}.json", name);
}

}  // namespace rastercheck::records
