// `rastercheck replay FILE…`: checks saved cases and counterexamples again.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case_reader.h"
#include "cases/json.h"
#include "cli/backend_failure.h"
#include "cli/case_check.h"
#include "cli/command.h"
#include "cli/contract_option.h"
#include "cli/isolation.h"
#include "cli/known_option.h"
#include "cli/progress.h"
#include "cli/terminal.h"
#include "oracle/transform.h"
#include "properties/campaign/check_case.h"
#include "properties/campaign/close_up.h"
#include "records/counterexample_json.h"
#include "reports/counterexample_text.h"

namespace rastercheck::cli::replay_command {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string backend;
  KnownOption known;
  std::string contract;
  std::optional<cases::DriverPromise> promise;
  std::optional<cases::DrawBy> draw_by;
  double timeout = kDefaultTimeout;
  bool json = false;
  bool quiet = false;
};

/// Ways to draw, as in `rastercheck run`. Only those without a depth test are offered: a saved case
/// itself says whether it has one.
constexpr auto kWays = names_of(cases::DrawBy());

/// The result of one law on a file's case.
struct Outcome {
  std::string file;
  std::string law;
  std::string backend;
  properties::Check check;
  std::string found;                  ///< the verdict saved in the file; empty if it has none
  std::vector<std::string> close_up;  ///< for the first violation

  std::string verdict() const {
    return check.is_applicable ? properties::verdict_of(check) : "not applicable";
  }
  bool is_violated() const { return check.violation_count > 0 && check.known.empty(); }
};

void print_outcome(const Outcome& outcome, bool quiet) {
  std::string note;
  if (!outcome.found.empty()) {
    note = outcome.found == outcome.verdict()
               ? " (as found)"
               : fmt::format(" (found as: {})", cases::printable(outcome.found));
  }
  for (const std::string& id : outcome.check.known) note += "; known: " + id;
  if (!outcome.check.why_not.empty()) note += ": " + cases::printable(outcome.check.why_not);
  fmt::print("{}: {}, {}: {}{}\n", outcome.file, outcome.law, outcome.backend, outcome.verdict(),
             note);
  if (quiet || outcome.check.violation_count == 0) return;
  const properties::Check& check = outcome.check;
  fmt::print("{}",
             reports::violations_text(check.violations, check.violation_count, terminal_columns()));
  for (const std::string& line : outcome.close_up) fmt::print("    {}\n", line);
}

void print_json(const std::vector<Outcome>& outcomes) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Outcome& outcome : outcomes) {
    nlohmann::ordered_json json{{"file", outcome.file},
                                {"property", outcome.law},
                                {"backend", outcome.backend},
                                {"verdict", outcome.verdict()},
                                {"violation_count", outcome.check.violation_count},
                                {"violations", nlohmann::ordered_json::array()}};
    if (!outcome.found.empty()) json["found"] = outcome.found;
    if (!outcome.check.known.empty()) json["known"] = outcome.check.known;
    if (!outcome.check.is_applicable) json["not_applicable_because"] = outcome.check.why_not;
    for (const records::Violation& v : outcome.check.violations) {
      json["violations"].push_back(nlohmann::ordered_json(cases::json_of(v)));
    }
    all.push_back(std::move(json));
  }
  fmt::print("{}\n", all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

/// A file's case, and the laws and backend to check it with.
struct Input {
  std::string file;
  cases::Case source;
  std::vector<const properties::Law*> laws;
  std::string backend;
};

Result<std::vector<Input>> read_inputs(const Options& options) {
  std::vector<Input> inputs;
  for (const std::string& file : options.files) {
    Result<cases::Case> c = cases::read_case(file);
    // Refuses cases whose clip positions are beyond float32: no backend can be asked to draw them.
    if (c) c = oracle::to_clip_case(*c, file).map([&c](const cases::Case&) { return *c; });
    if (!c) return tl::unexpected(c.error());
    auto laws = laws_for(*c, file);
    if (!laws) return tl::unexpected(laws.error());
    std::string backend = options.backend;
    if (backend.empty()) backend = c->found ? c->found->backend : "cpu";
    inputs.push_back({file, *std::move(c), *std::move(laws), std::move(backend)});
  }
  return inputs;
}

/// Checks one law on one input.
Outcome check_law(const properties::Law& law, const Input& input, const Drawer& by) {
  const cases::Case& source = input.source;
  const cases::Found found = source.found.value_or(cases::Found());
  Outcome outcome{input.file, std::string(law.id), input.backend, {}, found.verdict, {}};
  outcome.check = check_again(law, source, by);
  if (!outcome.check.is_applicable && outcome.check.why_not.empty()) {
    outcome.check.why_not = properties::reason_of(law, *by.backend, outcome.check);
  }
  if (!outcome.check.violations.empty()) {
    outcome.close_up = properties::close_up(source, *by.backend, outcome.check.violations.front());
  }
  return outcome;
}

/// Backends by specification.
using Drawers = std::map<std::string, Drawer>;

Result<Drawers> make_drawers(const backends::BackendFactory& factory,
                             const std::vector<Input>& inputs,
                             const properties::KnownSources& known) {
  Drawers made;
  for (const Input& input : inputs) {
    if (made.contains(input.backend)) continue;
    Result<Drawer> drawer = make_drawer(factory, input.backend, known);
    if (!drawer) return tl::unexpected(drawer.error());
    made[input.backend] = *std::move(drawer);
  }
  return made;
}

/// Checks all laws on all inputs. Prints results as they come, except for JSON. Fails if the oracle
/// fails.
Result<std::vector<Outcome>> check_inputs(const std::vector<Input>& inputs, const Drawers& drawers,
                                          const Options& options) {
  std::vector<Outcome> outcomes;
  std::uint64_t all = 0;
  for (const Input& input : inputs) all += input.laws.size();
  for (const Input& input : inputs) {
    bool is_shown = false;
    for (const properties::Law* law : input.laws) {
      {
        // The bar disappears before anything is printed.
        ProgressBar bar(options.quiet || all == 1);
        bar.show(outcomes.size(), all, "checks");
        outcomes.push_back(check_law(*law, input, drawers.at(input.backend)));
      }
      const Outcome& outcome = outcomes.back();
      if (outcome.check.fault) return tl::unexpected(Error{input.file, "", *outcome.check.fault});
      if (options.json) continue;
      print_outcome(outcome, options.quiet);
      is_shown = is_shown || (!options.quiet && outcome.check.violation_count > 0);
    }
    if (is_shown) fmt::print("{}", reports::case_text(input.source));
  }
  return outcomes;
}

ExitCode run(const Options& options) {
  const auto terms = read_terms(options.contract, options.promise);
  if (!terms) return fail(terms.error());
  backends::BackendFactory factory = backend_factory(options.timeout, *terms);
  factory.draw_by = options.draw_by;
  const Result<std::vector<Input>> inputs = read_inputs(options);
  if (!inputs) return fail(inputs.error());
  std::vector<std::string> specifications;
  for (const Input& input : *inputs) specifications.push_back(input.backend);
  if (const ExitCode code = check_backends(factory, specifications); code != ExitCode::ok)
    return code;
  const Result<Drawers> drawers = make_drawers(factory, *inputs, options.known.sources());
  if (!drawers) return fail(drawers.error());
  const Result<std::vector<Outcome>> checked = check_inputs(*inputs, *drawers, options);
  if (!checked) return fail_internally(checked.error());
  const std::vector<Outcome>& outcomes = *checked;
  if (options.json) print_json(outcomes);
  const auto is_violated = [](const Outcome& o) { return o.is_violated(); };
  const auto is_checked = [](const Outcome& o) { return o.check.is_applicable; };
  if (std::any_of(outcomes.begin(), outcomes.end(), is_violated)) return ExitCode::violated;
  const bool some = std::any_of(outcomes.begin(), outcomes.end(), is_checked);
  return some ? ExitCode::ok : ExitCode::nothing_checked;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("FILE", options->files, "Case files or counterexamples; - reads standard input")
      ->type_name(kFile)
      ->required();
  app.add_option("--backend", options->backend,
                 "Backend to draw with; default: that of a counterexample, else cpu")
      ->type_name(kBackend);
  add_known(app, options->known);
  add_contract(app, options->contract);
  add_promise(app, options->promise);
  add_draw_by(app, options->draw_by, std::span(kWays).first(2))
      ->description("How drivers with several ways to draw do so (see rastercheck run --help)");
  add_timeout(app, options->timeout);
  app.add_flag("--json", options->json, "Print the result as JSON");
  app.add_flag("-q,--quiet", options->quiet, "Print only the verdicts");
  app.footer(
      "A counterexample is checked against the property that it violated, any other case against "
      "all.\n\n"
      "Exit code 0 if the properties held or failed in known ways, 1 if one was violated, 4 if the "
      "backend cannot run here, 5 if none applies to the case.\n\n"
      "Example:\n"
      "  rastercheck replay rastercheck-out/counterexamples/*.json");
  return [options] { return run(*options); };
}

const Registration kRegistration("replay", "Check saved cases and counterexamples again", &set_up);

}  // namespace
}  // namespace rastercheck::cli::replay_command
