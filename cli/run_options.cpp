#include "cli/run_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <utility>

#include "cases/contract_json.h"
#include "cases/json.h"
#include "properties/campaign/plan_run.h"
#include "records/run.h"
#include "records/summary.h"
#include "reports/run_reader.h"

namespace rastercheck::cli {
namespace {

/// Removes repetitions, which would add no work.
std::vector<std::string> without_repetitions(const std::vector<std::string>& all) {
  std::vector<std::string> once;
  for (const std::string& one : all) {
    if (std::find(once.begin(), once.end(), one) == once.end()) once.push_back(one);
  }
  return once;
}

/// Sets one option to the baseline's value; fails if the user gave a different one.
template <typename Value>
Result<void> settle(const IsGiven& is_given, const char* name, const std::string& section,
                    Value& option, const Value& in_baseline) {
  if (is_given(name) && option != in_baseline) {
    return tl::unexpected(Error{
        name, "",
        fmt::format("differs from the baseline's section {}; omit {} to use the baseline's value",
                    section, name)});
  }
  option = in_baseline;
  return {};
}

/// settle() for and_then(): a function of the option that returns what settles it.
auto settling(const IsGiven& is_given, const std::string& section) {
  return [&](const char* name, auto& option, const auto& in_baseline) {
    return [&is_given, &section, name, &option, &in_baseline] {
      return settle(is_given, name, section, option, in_baseline);
    };
  };
}

}  // namespace

Result<records::Plan> make_plan(const RunOptions& options) {
  const auto shard = parse_shard(options.shard);
  if (!shard) return tl::unexpected(shard.error());
  if (*shard && !options.seed) {
    return tl::unexpected(
        Error{"--shard", "", "needs --seed, so that all shards check the same cases"});
  }
  if (options.plan.draw_by == cases::DrawBy::frame && options.plan.scene.empty()) {
    return tl::unexpected(Error{"--draw-by", "", "frame needs --scene, because it draws a scene"});
  }
  records::Plan plan = options.plan;
  plan.shard = *shard;
  plan.seed = options.seed ? *options.seed : std::random_device()();
  plan.backends = without_repetitions(plan.backends);
  Result<std::vector<std::string>> laws = properties::laws_matching(plan.properties);
  if (!laws) return tl::unexpected(laws.error());
  plan.laws = *std::move(laws);
  if (options.contract.empty()) return plan;
  return cases::read_contract(options.contract).map([&](const cases::ContractTerms& terms) {
    plan.contract = {options.contract, terms};
    return plan;
  });
}

Result<void> take_terms(const IsGiven& is_given, const gate::CaseSet& set, RunOptions& options) {
  const records::Plan& then = set.plan;
  records::Plan& plan = options.plan;
  if (!is_given("--corpus")) plan.corpus = then.corpus;
  // A contract file may have moved; check_contract() compares its content with the baseline's.
  const bool is_told = then.contract && is_given("--contract");
  const std::string file = then.contract ? then.contract->file : "";
  const std::string contract = is_told ? options.contract : file;
  const auto settled = settling(is_given, set.section);
  return settled("--contract", options.contract, contract)()
      .and_then(settled("--promise", plan.promise, then.promise))
      .and_then(settled("--draw-by", plan.draw_by, then.draw_by))
      .and_then(settled("--known", plan.known, then.known))
      .and_then(settled("--no-known", plan.ignores_known, then.ignores_known));
}

Result<void> check_contract(const gate::CaseSet& set, const records::Plan& plan) {
  if (!plan.contract || !set.plan.contract) return {};
  const std::uint64_t digest = cases::digest_of(plan.contract->terms);
  const std::uint64_t then = cases::digest_of(set.plan.contract->terms);
  if (then == digest) return {};
  return tl::unexpected(Error{plan.contract->file, "",
                              fmt::format("differs from the contract of the baseline's section {}: "
                                          "the digest of its terms was {:016x} and is {:016x}",
                                          set.section, then, digest)});
}

Result<void> take_case_set(const IsGiven& is_given, const gate::CaseSet& set, RunOptions& options) {
  const records::Plan& then = set.plan;
  records::Plan& plan = options.plan;
  std::optional<std::uint64_t> seed = then.seed;
  plan.hunted = then.hunted;
  plan.keeps_cases = true;
  const auto settled = settling(is_given, set.section);
  return settled("--seed", options.seed, seed)()
      .and_then(settled("--cases", plan.cases_per_law, then.cases_per_law))
      .and_then(settled("--property", plan.properties, then.properties))
      .and_then(settled("--power", plan.power, then.power))
      .and_then([&] { return take_terms(is_given, set, options); });
}

Result<void> take_failed(RunOptions& options) {
  const std::string file = options.rerun_failed + "/run.json";
  const Result<records::Run> run = reports::read_run(file);
  if (!run) return tl::unexpected(run.error());
  if (run->plan.scene == "-") {
    return tl::unexpected(
        Error{file, "/plan/scene", "was read from standard input, which cannot be read again"});
  }
  records::Plan plan = run->plan;
  plan.backends.clear();
  plan.properties.clear();
  for (const records::LawSummary& row : records::summarize(*run)) {
    if (row.verdict != records::LawVerdict::violated) continue;
    plan.backends.push_back(row.backend);
    plan.properties.push_back(row.law);
  }
  if (plan.properties.empty()) {
    return tl::unexpected(Error{file, "", "has no violated property to check again"});
  }
  plan.properties = without_repetitions(plan.properties);
  if (plan.contract) options.contract = plan.contract->file;
  options.seed = plan.seed;
  options.plan = std::move(plan);
  return {};
}

}  // namespace rastercheck::cli
