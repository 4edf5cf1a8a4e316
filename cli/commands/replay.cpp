// `rastercheck replay FILE…`: saved cases and counterexamples once more.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "backends/backend.h"
#include "cases/case_reader.h"
#include "cases/json.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/isolation.h"
#include "oracle/transform.h"
#include "properties/check_case.h"
#include "properties/close_up.h"
#include "records/counterexample_json.h"
#include "reports/counterexample_text.h"

namespace rastercheck::cli {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string backend;
  double timeout = kDefaultTimeout;
  bool json = false;
  bool quiet = false;
};

/// A law checked on a file's case.
struct Outcome {
  std::string file;
  std::string law;
  std::string backend;
  properties::Check check;
  std::string found;  ///< the verdict the file was saved with; empty where it says none
  const cases::Case* source = nullptr;
  std::vector<std::string> close_up;  ///< of the first violation

  std::string verdict() const {
    return check.is_applicable ? properties::verdict_of(check) : "not applicable";
  }
};

/// The laws to check: the one it was found by, or all.
Result<std::vector<const properties::Law*>> laws_for(const cases::Case& c,
                                                     const std::string& file) {
  std::vector<const properties::Law*> chosen;
  for (const properties::Law& law : properties::laws()) {
    if (!c.found || c.found->law == law.name) chosen.push_back(&law);
  }
  if (chosen.empty()) {
    return tl::unexpected(Error{file, "/found/law",
                                fmt::format("there is no law '{}' (see rastercheck list "
                                            "properties)",
                                            cases::printable(c.found->law))});
  }
  return chosen;
}

void print_outcome(const Outcome& outcome, bool quiet) {
  std::string note;
  if (!outcome.found.empty()) {
    note = outcome.found == outcome.verdict()
               ? " (as it was found)"
               : fmt::format(" (found as: {})", cases::printable(outcome.found));
  }
  fmt::print("{}: {}, {}: {}{}\n", outcome.file, outcome.law, outcome.backend, outcome.verdict(),
             note);
  if (quiet || outcome.check.violation_count == 0) return;
  const properties::Check& check = outcome.check;
  fmt::print("{}", reports::violations_text(check.violations, check.violation_count));
  for (const std::string& line : outcome.close_up) fmt::print("    {}\n", line);
  fmt::print("{}", reports::case_text(*outcome.source));
}

void print_json(const std::vector<Outcome>& outcomes) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Outcome& outcome : outcomes) {
    nlohmann::ordered_json json{{"file", outcome.file},
                                {"law", outcome.law},
                                {"backend", outcome.backend},
                                {"verdict", outcome.verdict()},
                                {"violation_count", outcome.check.violation_count},
                                {"violations", nlohmann::ordered_json::array()}};
    if (!outcome.found.empty()) json["found"] = outcome.found;
    for (const records::Violation& v : outcome.check.violations) {
      json["violations"].push_back(nlohmann::ordered_json(records::violation_to_json(v)));
    }
    all.push_back(std::move(json));
  }
  fmt::print("{}\n", all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

/// A file's case, and what it is to be checked by.
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
    // What positions beyond float32 draw is no question to a backend.
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

Result<std::vector<Outcome>> check_inputs(const std::vector<Input>& inputs) {
  std::vector<Outcome> outcomes;
  std::map<std::string, std::unique_ptr<backends::Backend>> made;
  for (const auto& [file, source, laws, specification] : inputs) {
    if (!made.contains(specification)) {
      auto backend = backends::make_backend(specification);
      if (!backend) return tl::unexpected(backend.error());
      made[specification] = *std::move(backend);
    }
    const cases::Found found = source.found.value_or(cases::Found());
    for (const properties::Law* law : laws) {
      Outcome outcome{file, std::string(law->name), specification, {}, found.verdict, &source, {}};
      outcome.check = properties::check_or_note(*law, source, *made[specification], {found.index});
      if (outcome.check.fault) return tl::unexpected(Error{file, "", *outcome.check.fault});
      if (!outcome.check.violations.empty()) {
        outcome.close_up =
            properties::close_up(source, *made[specification], outcome.check.violations.front());
      }
      outcomes.push_back(std::move(outcome));
    }
  }
  return outcomes;
}

ExitCode run(const Options& options) {
  isolate_foreign_backends(options.timeout);
  const Result<std::vector<Input>> inputs = read_inputs(options);
  if (!inputs) return fail(inputs.error());
  std::vector<std::string> specifications;
  for (const Input& input : *inputs) specifications.push_back(input.backend);
  if (const ExitCode code = check_backends(specifications); code != ExitCode::ok) return code;
  const Result<std::vector<Outcome>> checked = check_inputs(*inputs);
  if (!checked) return fail_internally(checked.error());
  const std::vector<Outcome>& outcomes = *checked;
  if (options.json) {
    print_json(outcomes);
  } else {
    for (const Outcome& outcome : outcomes) print_outcome(outcome, options.quiet);
  }
  const auto is_violated = [](const Outcome& o) { return o.check.violation_count > 0; };
  const auto is_checked = [](const Outcome& o) { return o.check.is_applicable; };
  if (std::any_of(outcomes.begin(), outcomes.end(), is_violated)) return ExitCode::violated;
  const bool some = std::any_of(outcomes.begin(), outcomes.end(), is_checked);
  return some ? ExitCode::ok : ExitCode::nothing_checked;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("FILE", options->files, "Case files or counterexamples; - reads standard input")
      ->required();
  app.add_option("--backend", options->backend,
                 "What draws; without it the one it was found with, or cpu");
  add_timeout(app, options->timeout);
  app.add_flag("--json", options->json, "As JSON");
  app.add_flag("-q,--quiet", options->quiet, "Verdicts only");
  app.footer(
      "A counterexample is checked by the property that it was found by, any other case by all.\n"
      "Exit code 0 if they held, 1 if one was violated, 5 if none says anything of the case.");
  return [options] { return run(*options); };
}

const Registration kRegistration("replay", "Checks saved cases and counterexamples again", &set_up);

}  // namespace
}  // namespace rastercheck::cli
