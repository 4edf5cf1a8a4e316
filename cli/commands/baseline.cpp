// `rastercheck baseline save` and `baseline approve`: maintain the file that runs are compared
// with.

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "cases/files.h"
#include "cases/json.h"
#include "cli/command.h"
#include "cli/commit.h"
#include "cli/gate.h"
#include "gate/approve.h"
#include "gate/compare.h"
#include "records/baseline_json.h"

namespace rastercheck::cli::baseline_command {
namespace {

struct SaveOptions {
  std::string run;
  std::string output = records::kBaselineFile;
  std::string as;
  std::string commit;
  bool of_instruction_set = false;
  bool of_compiler = false;
  bool quiet = false;
};

struct ApproveOptions {
  std::string baseline;
  std::string current;
  std::string reason;
  std::string backend;
  std::string as;
  std::string commit;
  gate::EntryPattern pattern;
  bool json = false;
  bool quiet = false;
};

/// Reads a side, renames its backend to `as` and sets its commit.
Result<gate::Side> read_named(const std::string& file, const std::string& as,
                              const std::string& commit) {
  Result<gate::Side> side = gate::read_side(file);
  if (!side) return side;
  if (const auto renamed = gate::rename_backend(*side, as); !renamed) {
    return tl::unexpected(renamed.error());
  }
  if (side->run || !commit.empty()) gate::set_commit(*side, commit_of(commit));
  return side;
}

bool is_standard_output(const std::string& file) { return file == "-"; }

/// Reads the file's current baseline; an empty one if there is no file.
Result<records::Baseline> read_existing(const std::string& file) {
  std::error_code why;
  if (is_standard_output(file)) return records::Baseline();
  if (!std::filesystem::exists(file, why) && !why) return records::Baseline();
  return records::read_baseline(file);
}

/// Puts a section into the baseline and keeps the approvals of the section that it replaces.
/// Returns what happened to the section.
std::string add(records::Baseline& baseline, records::BaselineSection section) {
  std::string became = "new";
  std::string lost;
  for (const records::BaselineSection& old : baseline.sections) {
    if (old.key != section.key) continue;
    section.approvals = old.approvals;
    became = old == section ? "unchanged" : "replaced";
    if (old.plan.hunted.size() > section.plan.hunted.size()) {
      lost = fmt::format(
          "  {} worst cases of hunts are no longer in it; `rastercheck run --baseline` keeps "
          "them\n",
          old.plan.hunted.size() - section.plan.hunted.size());
    }
  }
  std::uint64_t cases = 0;
  for (const auto& [law, of_law] : section.laws) cases += of_law.count;
  std::string text = fmt::format("{}: {} entries of {} properties, {} cases; {}\n",
                                 cases::one_line(to_string(section.key)), section.entries.size(),
                                 section.laws.size(), cases, became);
  records::put(baseline, std::move(section));
  return text + lost;
}

ExitCode save(const SaveOptions& options) {
  Result<gate::Side> side = read_named(options.run, options.as, options.commit);
  if (!side) return fail(side.error());
  Result<records::Baseline> baseline = read_existing(options.output);
  if (!baseline) return fail(baseline.error());
  std::string text;
  for (records::BaselineSection& section : side->sections.sections) {
    if (options.of_instruction_set) section.key.instruction_set = section.taken.instruction_set;
    if (options.of_compiler) section.key.compiler = section.taken.compiler;
    text += add(*baseline, std::move(section));
  }
  const std::string json = records::to_json(*baseline);
  if (is_standard_output(options.output)) {
    fmt::print("{}", json);
    return ExitCode::ok;
  }
  const auto written = cases::write_file(options.output, json);
  if (!written) return fail(written.error());
  if (!options.quiet) fmt::print("{}Baseline: {}\n", text, options.output);
  return ExitCode::ok;
}

/// The changes accepted into one section.
struct Approved {
  std::string section;
  std::vector<std::string> changes;
  std::map<std::string, std::uint64_t> violations;  ///< by law
};

/// "3 violated cases are taken over: 2 of LAW, 1 of LAW"; empty if there are none.
std::string violations_text(const Approved& approved) {
  std::uint64_t all = 0;
  std::string by_law;
  for (const auto& [law, cases] : approved.violations) {
    all += cases;
    by_law += fmt::format("{}{} of {}", by_law.empty() ? "" : ", ", cases, law);
  }
  if (all == 0) return "";
  return fmt::format("{} accepted: {}",
                     all == 1 ? "1 violated case" : fmt::format("{} violated cases", all), by_law);
}

/// Accepts the figures of `current` into the section that it is compared with.
Result<Approved> approve(records::Baseline& baseline, const records::BaselineSection& current,
                         const ApproveOptions& options) {
  const auto found = gate::section_for(baseline, current, options.baseline);
  if (!found) return tl::unexpected(found.error());
  const auto comparison = gate::compare(**found, current);
  if (!comparison) {
    return tl::unexpected(
        Error{options.baseline, comparison.error().place, comparison.error().reason});
  }
  records::BaselineSection section = **found;
  Approved approved{to_string(section.key), {}, {}};
  approved.changes = gate::approve(section, current, *comparison, options.pattern, options.reason);
  approved.violations = gate::violations_taken(*comparison, options.pattern);
  records::put(baseline, std::move(section));
  return approved;
}

void print(const std::vector<Approved>& all, const ApproveOptions& options) {
  if (options.json) {
    nlohmann::ordered_json sections = nlohmann::ordered_json::array();
    for (const Approved& one : all) {
      sections.push_back(
          {{"section", one.section}, {"changes", one.changes}, {"violations", one.violations}});
    }
    fmt::print("{}\n", sections.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    return;
  }
  if (options.quiet) return;
  for (const Approved& one : all) {
    if (one.changes.empty()) {
      fmt::print("{}: nothing to approve.\n", cases::one_line(one.section));
      continue;
    }
    fmt::print("{}: approved.\n", cases::one_line(one.section));
    for (const std::string& change : one.changes) fmt::print("  {}\n", cases::one_line(change));
    if (const std::string violations = violations_text(one); !violations.empty()) {
      fmt::print("{}.\n", cases::one_line(violations));
    }
  }
}

ExitCode approve(const ApproveOptions& options) {
  if (options.reason.find_first_not_of(" \t\r\n") == std::string::npos) {
    return fail({"--reason", "", "must not be empty"});
  }
  if (options.baseline == "-") {
    return fail({"-", "", "the baseline must be a file, because it is rewritten"});
  }
  Result<records::Baseline> baseline = records::read_baseline(options.baseline);
  if (!baseline) return fail(baseline.error());
  const Result<gate::Side> current = read_named(options.current, options.as, options.commit);
  if (!current) return fail(current.error());
  std::vector<Approved> all;
  bool is_changed = false;
  for (const records::BaselineSection& section : current->sections.sections) {
    if (!options.backend.empty() && section.key.backend != records::section_name(options.backend)) {
      continue;
    }
    Result<Approved> approved = approve(*baseline, section, options);
    if (!approved) return fail(approved.error());
    is_changed = is_changed || !approved->changes.empty();
    all.push_back(*std::move(approved));
  }
  if (all.empty()) {
    return fail({options.current, "--backend", "has no section for " + options.backend});
  }
  if (is_changed) {
    const auto written = cases::write_file(options.baseline, records::to_json(*baseline));
    if (!written) return fail(written.error());
  }
  print(all, options);
  return ExitCode::ok;
}

CLI::App* add_save(CLI::App& app, SaveOptions& options) {
  CLI::App* save = app.add_subcommand("save", "Save the results of a run as the baseline");
  save->add_option("RUN", options.run,
                   "Folder or run.json of a run with --keep-cases; - reads standard input")
      ->type_name(kFile)
      ->required();
  save->add_option(
          "--output", options.output,
          "Baseline file; sections of other backends are kept; - prints a new baseline instead")
      ->type_name(kFile)
      ->capture_default_str();
  save->add_option("--as", options.as, "Name of the backend in the baseline; default: its own")
      ->type_name("NAME");
  save->add_flag("--instruction-set", options.of_instruction_set,
                 "Save a section for machines with the same vector instructions only");
  save->add_flag("--compiler", options.of_compiler,
                 "Save a section for programs of the same compiler only");
  save->add_option("--commit", options.commit,
                   "Commit that the run belongs to; default: as CI or git reports")
      ->type_name("COMMIT");
  save->add_flag("-q,--quiet", options.quiet, "Do not print what was saved");
  return save;
}

CLI::App* add_approve(CLI::App& app, ApproveOptions& options) {
  CLI::App* approve = app.add_subcommand("approve", "Accept current numbers into the baseline");
  approve->add_option("BASELINE", options.baseline, "Baseline file")->type_name(kFile)->required();
  approve
      ->add_option(
          "CURRENT", options.current,
          "New numbers: a baseline file, or the run.json or folder of a run with --keep-cases")
      ->type_name(kFile)
      ->required();
  approve
      ->add_option("--reason", options.reason, "Why the numbers are accepted; kept in the baseline")
      ->type_name("TEXT")
      ->required();
  approve
      ->add_option("--property", options.pattern.law,
                   "Only entries of properties whose id matches, such as '*edge*'")
      ->type_name(kProperty)
      ->capture_default_str();
  approve
      ->add_option("--kind", options.pattern.kind,
                   "Only entries of matching attribute kinds, such as smooth")
      ->type_name("KIND")
      ->capture_default_str();
  approve
      ->add_option(
          "--stratum", options.pattern.stratum,
          "Only entries of matching strata, such as sliver; all: the totals and their strata")
      ->type_name("STRATUM")
      ->capture_default_str();
  approve
      ->add_option("--backend", options.backend,
                   "Only entries of this backend; default: all backends")
      ->type_name(kBackend);
  approve->add_option("--as", options.as, "Name of the backend in the baseline, if it differs")
      ->type_name("NAME");
  approve
      ->add_option("--commit", options.commit,
                   "Commit that CURRENT belongs to; default: as CI or git reports")
      ->type_name("COMMIT");
  approve->add_flag("--json", options.json, "Print what was accepted as JSON");
  approve->add_flag("-q,--quiet", options.quiet, "Print nothing");
  return approve;
}

Action set_up(CLI::App& app) {
  const auto of_save = std::make_shared<SaveOptions>();
  const auto of_approve = std::make_shared<ApproveOptions>();
  app.require_subcommand(1);
  const CLI::App* save_command = add_save(app, *of_save);
  add_approve(app, *of_approve);
  app.footer(
      "`rastercheck compare` and `rastercheck run --baseline` compare runs with it.\n\n"
      "Examples:\n"
      "  rastercheck run --seed 1 --keep-cases\n"
      "  rastercheck baseline save rastercheck-out\n"
      "  rastercheck baseline approve rastercheck-baseline.json rastercheck-out \\\n"
      "    --reason 'larger steps, for speed'");
  return [of_save, of_approve, save_command] {
    return save_command->parsed() ? save(*of_save) : approve(*of_approve);
  };
}

const Registration kRegistration("baseline", "Save the numbers that later runs are compared with",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::baseline_command
