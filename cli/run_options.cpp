#include "cli/run_options.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <random>
#include <span>
#include <system_error>

#include "cases/contract_json.h"
#include "cases/json.h"
#include "cli/corpus_folder.h"
#include "properties/law.h"
#include "records/run.h"
#include "records/summary.h"
#include "reports/run_reader.h"

namespace rastercheck::cli {
namespace {

bool matches(const std::string& name, const std::string& pattern) {
  return ::fnmatch(pattern.c_str(), name.c_str(), FNM_EXTMATCH) == 0;
}

/// The ids of the laws that match one of the patterns; "@(this|that)" matches either. Fails where a
/// pattern matches none.
Result<std::vector<std::string>> chosen_laws(const std::vector<std::string>& patterns) {
  const std::span<const properties::Law> laws = properties::laws();
  for (const std::string& pattern : patterns) {
    const auto is_meant = [&](const auto& law) { return matches(std::string(law.id), pattern); };
    if (std::none_of(laws.begin(), laws.end(), is_meant)) {
      return tl::unexpected(
          Error{"--property", cases::printable(pattern),
                "no property has this id; stars match the rest of one, as in '*edge*' (see "
                "rastercheck list properties)"});
    }
  }
  std::vector<std::string> ids;
  for (const properties::Law& law : laws) {
    std::string id(law.id);
    const auto is_of = [&](const std::string& pattern) { return matches(id, pattern); };
    if (std::any_of(patterns.begin(), patterns.end(), is_of)) ids.push_back(std::move(id));
  }
  return ids;
}

/// The same without those that were there before: twice the same is no more work.
std::vector<std::string> without_repetitions(const std::vector<std::string>& all) {
  std::vector<std::string> once;
  for (const std::string& one : all) {
    if (std::find(once.begin(), once.end(), one) == once.end()) once.push_back(one);
  }
  return once;
}

/// The options that decide what is found, as words of the command line; without backends, cases,
/// seed and scene.
std::vector<std::string> other_options(const RunOptions& options) {
  std::vector<std::string> words;
  const auto add = [&words](const char* name, const std::string& value) {
    words.insert(words.end(), {name, value});
  };
  const RunOptions usual;
  if (options.properties != usual.properties) {
    for (const std::string& property : options.properties) add("--property", property);
  }
  if (!options.scene.empty() && options.scene_size != usual.scene_size) {
    add("--scene-size", std::to_string(options.scene_size));
  }
  if (!options.contract.empty()) add("--contract", options.contract);
  if (!options.corpus.empty()) add("--corpus", options.corpus);
  if (options.known.is_none) words.emplace_back("--no-known");
  if (!options.known.directory.empty()) add("--known", options.known.directory);
  if (options.shrink_tries != usual.shrink_tries) {
    add("--shrink-tries", std::to_string(options.shrink_tries));
  }
  if (options.shrink_seconds) add("--shrink-seconds", fmt::format("{}", *options.shrink_seconds));
  if (options.keeps_cases) words.emplace_back("--keep-cases");
  if (options.timeout != usual.timeout) add("--timeout", fmt::format("{}", options.timeout));
  return words;
}

/// Sets one option to what the baseline was made with; refuses another value that was given.
template <typename Value>
Result<void> settle(const CLI::App& app, const char* name, const std::string& section,
                    Value& option, const Value& in_baseline) {
  if (app.count(name) > 0 && option != in_baseline) {
    return tl::unexpected(Error{
        name, "",
        fmt::format("is not as in the baseline's section {}; leave it out, and it is", section)});
  }
  option = in_baseline;
  return {};
}

/// Sets an option to the number that the run recorded of it, and leaves it where it recorded none.
/// Fails on anything but a number that is not negative.
template <typename Value>
Result<void> take_number(const records::Run& run, const std::string& file, const char* name,
                         Value& option) {
  const std::optional<std::string> text = records::option_of(run.options, name);
  if (!text) return {};
  const char* const end = std::to_address(text->end());
  const auto [stop, problem] = std::from_chars(std::to_address(text->begin()), end, option);
  if (stop == end && problem == std::errc() && option >= Value()) return {};
  return tl::unexpected(Error{
      file, "/options", fmt::format("'{}' is no value of {}", cases::printable(*text), name)});
}

}  // namespace

Result<properties::RunPlan> plan_of(const RunOptions& options) {
  const auto shard = parse_shard(options.shard);
  if (!shard) return tl::unexpected(shard.error());
  if (*shard && !options.seed) {
    return tl::unexpected(
        Error{"--shard", "", "needs --seed: all shards have to be of the same campaign"});
  }
  properties::RunPlan plan;
  plan.campaign.shard = *shard;
  plan.campaign.seed = options.seed ? *options.seed : std::random_device()();
  plan.campaign.cases_per_law = options.cases;
  plan.campaign.backends = without_repetitions(options.backends);
  const Result<std::vector<std::string>> laws = chosen_laws(options.properties);
  if (!laws) return tl::unexpected(laws.error());
  plan.campaign.laws = *laws;
  plan.campaign.shrinking = {options.shrink_tries, options.shrink_seconds};
  plan.campaign.keeps_cases = options.keeps_cases;
  plan.corpus = options.corpus.empty() ? corpus_folder() : options.corpus;
  plan.known = options.known.folder();
  plan.scene = options.scene;
  plan.scene_size = options.scene_size;
  plan.options = other_options(options);
  plan.program = RASTERCHECK_VERSION;
  plan.contract_file = options.contract;
  if (plan.contract_file.empty()) return plan;
  return cases::read_contract(plan.contract_file).map([&plan](const cases::ContractTerms& terms) {
    plan.terms = terms;
    return plan;
  });
}

Result<void> take_case_set(const CLI::App& app, const gate::CaseSet& set, RunOptions& options) {
  const std::vector<std::string>& words = set.options;
  std::optional<std::uint64_t> seed = set.seed;
  const auto value = [&words](const char* name) {
    return records::option_of(words, name).value_or("");
  };
  std::vector<std::string> properties = records::values_of(words, "--property");
  if (properties.empty()) properties = RunOptions().properties;
  const bool is_none = std::find(words.begin(), words.end(), "--no-known") != words.end();
  if (app.count("--corpus") == 0) options.corpus = value("--corpus");
  const bool is_told = set.contract_digest && app.count("--contract") > 0;
  const std::string contract = is_told ? options.contract : value("--contract");
  options.keeps_cases = true;
  return settle(app, "--seed", set.section, options.seed, seed)
      .and_then(
          [&] { return settle(app, "--cases", set.section, options.cases, set.cases_per_law); })
      .and_then(
          [&] { return settle(app, "--property", set.section, options.properties, properties); })
      .and_then([&] { return settle(app, "--contract", set.section, options.contract, contract); })
      .and_then([&] {
        return settle(app, "--known", set.section, options.known.directory, value("--known"));
      })
      .and_then(
          [&] { return settle(app, "--no-known", set.section, options.known.is_none, is_none); });
}

Result<void> take_failed(RunOptions& options) {
  const std::string file = options.rerun_failed + "/run.json";
  const Result<records::Run> run = reports::read_run(file);
  if (!run) return tl::unexpected(run.error());
  options.backends.clear();
  options.properties.clear();
  for (const records::LawSummary& row : records::summarize(*run)) {
    if (row.verdict != records::LawVerdict::violated) continue;
    options.backends.push_back(row.backend);
    options.properties.push_back(row.law);
  }
  if (run->scene == "-") {
    return tl::unexpected(Error{file, "/scene", "was read from standard input"});
  }
  if (options.properties.empty()) {
    return tl::unexpected(
        Error{file, "", "says that nothing was violated: nothing to check again"});
  }
  options.properties = without_repetitions(options.properties);
  options.seed = run->seed;
  options.cases = run->cases_per_law;
  options.scene = run->scene;
  const auto text = [&run](const char* name) {
    return records::option_of(run->options, name).value_or("");
  };
  const auto is_set = [&run](const char* flag) {
    return std::find(run->options.begin(), run->options.end(), flag) != run->options.end();
  };
  options.contract = text("--contract");
  options.corpus = text("--corpus");
  options.known.directory = text("--known");
  options.known.is_none = is_set("--no-known");
  options.keeps_cases = is_set("--keep-cases");
  options.shrink_seconds = run->shrink_seconds;
  return take_number(*run, file, "--scene-size", options.scene_size)
      .and_then([&] { return take_number(*run, file, "--shrink-tries", options.shrink_tries); })
      .and_then([&] { return take_number(*run, file, "--timeout", options.timeout); });
}

}  // namespace rastercheck::cli
