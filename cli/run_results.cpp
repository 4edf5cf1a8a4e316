#include "cli/run_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "backends/backend.h"
#include "cases/json.h"
#include "cli/terminal.h"
#include "properties/law.h"
#include "reports/cause_text.h"
#include "reports/commands.h"
#include "reports/side_by_side_text.h"
#include "reports/summary_table.h"

namespace rastercheck::cli {
namespace {

using records::LawSummary;
using records::LawVerdict;

auto has_verdict(LawVerdict verdict) {
  return [verdict](const LawSummary& row) { return row.verdict == verdict; };
}

/// True if the row's backend promises what the law is about and no known-defect list says to skip
/// the law.
bool has_to_hold(const LawSummary& row, const std::vector<records::BackendPromises>& promises) {
  if (!row.skipped_by.empty()) return false;
  return std::none_of(promises.begin(), promises.end(), [&row](const auto& backend) {
    const auto& unpromised = backend.unpromised;
    return backend.backend == row.backend &&
           std::find(unpromised.begin(), unpromised.end(), row.law) != unpromised.end();
  });
}

/// True if the row's law had to check something: some laws are about promises or features that not
/// every backend has.
bool is_promised(const LawSummary& row, const std::vector<records::BackendPromises>& promises) {
  const bool has_limits = std::any_of(
      promises.begin(), promises.end(),
      [&row](const auto& backend) { return backend.backend == row.backend && backend.has_limits; });
  return !has_limits && has_to_hold(row, promises);
}

bool is_violated(const std::vector<LawSummary>& rows) {
  return std::any_of(rows.begin(), rows.end(), has_verdict(LawVerdict::violated));
}

/// Prints each cause with its smallest counterexample; the folder and the report have the others.
void print_causes(const records::Run& run, const reports::CommandOf& command_of) {
  if (run.counterexamples.empty()) return;
  fmt::print("{}", reports::causes_text(run, command_of));
}

void print_scenes(const records::Run& run) {
  for (const records::SceneResult& scene : run.scenes) {
    fmt::print("{}\n", cases::printable(records::scene_sentence(scene)));
  }
}

}  // namespace

Detail detail_of(bool quiet, bool all) {
  if (quiet) return Detail::rows;
  return all ? Detail::all : Detail::summary;
}

void print_results(const records::Run& run, const std::vector<LawSummary>& rows,
                   const std::string& output, Detail detail) {
  const bool quiet = detail == Detail::rows;
  const std::vector<LawSummary> shown =
      detail == Detail::summary ? reports::notable_rows(rows) : rows;
  if (!shown.empty()) {
    fmt::print("{}", reports::summary_table(shown, quiet, terminal_columns()));
  }
  for (const records::UnreachedLabel& label : run.unreached) {
    fmt::print("{}\n", records::unreached_sentence(label));
  }
  for (const records::UnexpectedPass& pass : run.unexpected) {
    fmt::print("{}\n", records::unexpected_sentence(pass));
  }
  if (quiet) return print_scenes(run);
  fmt::print("{}{}{}{}{}{}", shown.empty() ? "" : "\n", reports::summary_counts(rows),
             reports::not_judged_text(rows), reports::power_text(rows),
             reports::not_checked_text(rows), reports::known_text(run));
  const reports::CommandOf command_of = [&](const records::Counterexample& one) {
    const std::filesystem::path file = std::filesystem::path(output) / records::file_of(one);
    return reports::replay_command(run, file.string());
  };
  print_causes(run, command_of);
  for (const std::string& caveat : records::caveats(run)) fmt::print("{}\n", caveat);
  fmt::print("{}", reports::thin_text(rows));
  if (!run.counterexamples.empty()) fmt::print("\n{}", reports::causes_list(run, command_of));
  fmt::print("{}\n", reports::side_by_side_text(run, output));
  print_scenes(run);
  fmt::print("{}", reports::verdict_lines(run, rows, has_color()));
  if (shown.size() < rows.size()) fmt::print("`--all` shows a row for each property.\n");
  if (run.cases_left > 0)
    fmt::print("`rastercheck run --resume --output {}` continues the run.\n", output);
}

ExitCode exit_code_of(const records::Run& run, const std::vector<LawSummary>& rows,
                      const std::vector<records::BackendPromises>& promises) {
  if (is_violated(rows)) return ExitCode::violated;
  const auto some = [&rows](const auto& is) { return std::any_of(rows.begin(), rows.end(), is); };
  const bool is_missing = some([&promises](const LawSummary& row) {
    const bool has_gap = row.verdict == LawVerdict::not_checked || !row.unreached.empty();
    return has_gap && is_promised(row, promises);
  });
  const bool is_too_thin =
      run.plan.require_cases && some([&promises](const LawSummary& row) {
        return row.cases.checked < row.least_cases && has_to_hold(row, promises);
      });
  const bool is_checked = some(has_verdict(LawVerdict::held)) ||
                          some(has_verdict(LawVerdict::known)) ||
                          some(has_verdict(LawVerdict::thin));
  const bool is_unseen =
      std::any_of(run.scenes.begin(), run.scenes.end(),
                  [](const records::SceneResult& scene) { return scene.judged == 0; });
  return is_missing || is_too_thin || is_unseen || !is_checked ? ExitCode::nothing_checked
                                                               : ExitCode::ok;
}

ExitCode exit_code_of_shard(const std::vector<LawSummary>& rows) {
  return is_violated(rows) ? ExitCode::violated : ExitCode::ok;
}

}  // namespace rastercheck::cli
