#include "gate/internal/commit_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <utility>

#include "cases/files.h"
#include "cases/json.h"
#include "cases/json_node.h"
#include "gate/compare.h"
#include "gate/sections.h"
#include "records/plan_json.h"
#include "reports/run_reader.h"
#include "reports/write.h"

namespace rastercheck::gate {
namespace {

constexpr const char* kPlanFile = "/plan.json";
constexpr const char* kJudgedFile = "/judged.jsonl";
constexpr std::size_t kShortHash = 10;

/// True if `rastercheck run` ended with an exit code that it returns after judging: all laws held,
/// a law was violated, or nothing was checked.
bool has_judged(const cases::ProcessEnd& end) {
  constexpr int kViolated = 1;
  constexpr int kNothingChecked = 5;
  return end.signal == 0 &&
         (end.exit_code == 0 || end.exit_code == kViolated || end.exit_code == kNothingChecked);
}

/// Names a command, such as "cc -shared …", and says how it ended, with the most telling line of
/// its output.
Error ended(const std::string& what, const cases::ProcessEnd& end, const std::string& log) {
  const std::string said = telling_line(cases::read_text(log).value_or(""));
  return {what, "", to_string(end) + (said.empty() ? "" : "; its output: " + said)};
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return cases::printable(line);
}

/// Returns the plan for one commit: it keeps each case's result, which a comparison needs, and
/// shrinks no counterexample.
records::Plan plan_of_commit(const BisectPlan& plan) {
  records::Plan drawn = plan.plan;
  drawn.keeps_cases = true;
  drawn.shrinking.tries = 0;
  return drawn;
}

/// Returns the `rastercheck run` command that carries out the plan into a folder.
std::vector<std::string> run_words(const BisectPlan& plan, const std::string& folder) {
  std::vector<std::string> words{plan.program, "run"};
  for (const std::string& backend : plan.plan.backends) {
    words.insert(words.end(), {"--backend", backend});
  }
  words.insert(words.end(), {"--cases", std::to_string(plan.plan.cases_per_law), "--seed",
                             std::to_string(plan.plan.seed), "--jobs", std::to_string(plan.jobs),
                             "--output", folder, "--format", "json", "--quiet"});
  const std::vector<std::string> options = records::option_words(plan_of_commit(plan));
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

template <typename Map>
void keep_laws(Map& map, const std::set<std::string>& laws) {
  std::erase_if(map, [&](const auto& entry) { return !laws.contains(entry.first.law); });
}

/// Draws with the rastercheck program that was built.
Result<records::Run> run_program(const BisectPlan& plan, const std::string& name, OutsideRun how) {
  const std::string folder = plan.folder + "/" + name;
  how.log = folder + "/run.log";
  const Result<cases::ProcessEnd> drawn = run_outside(run_words(plan, folder), how);
  if (!drawn) return tl::unexpected(drawn.error());
  if (!has_judged(*drawn)) return tl::unexpected(ended("rastercheck run", *drawn, how.log));
  return read_drawing(plan.folder, name);
}

}  // namespace

Result<records::Run> draw_commit(const BisectPlan& plan, const std::string& name, OutsideRun how) {
  const std::string folder = plan.folder + "/" + name;
  std::error_code why;
  std::filesystem::create_directories(folder, why);
  if (why) return tl::unexpected(Error{folder, "", "cannot be created: " + why.message()});
  how.log = folder + "/build.log";
  const Result<cases::ProcessEnd> built = run_outside(plan.build, how);
  if (!built) return tl::unexpected(built.error());
  if (built->signal != 0 || built->exit_code != 0) {
    return tl::unexpected(ended(joined(plan.build), *built, how.log));
  }
  if (!plan.program.empty()) return run_program(plan, name, how);
  Result<records::Run> run = plan.draw(plan_of_commit(plan), folder, plan.jobs, how.is_to_end);
  if (!run) return run;
  if (run->cases_left > 0) return tl::unexpected(Error{name, "", "was interrupted"});
  const Result<void> kept = reports::write_reports(*run, folder, std::vector<std::string>{"json"});
  if (!kept) return tl::unexpected(kept.error());
  return run;
}

std::string run_file(const std::string& folder, const std::string& name) {
  return folder + "/" + name + "/run.json";
}

Result<records::Run> read_drawing(const std::string& folder, const std::string& name) {
  return reports::read_run(run_file(folder, name));
}

records::Run only_laws(records::Run run, const std::set<std::string>& laws) {
  keep_laws(run.records, laws);
  if (run.cases) keep_laws(*run.cases, laws);
  std::erase_if(run.plan.laws, [&](const std::string& law) { return !laws.contains(law); });
  std::erase_if(run.sentences, [&](const auto& one) { return !laws.contains(one.first); });
  run.counterexamples.clear();
  run.inspections.clear();
  run.unreached.clear();
  run.unexpected.clear();
  return run;
}

std::string pattern_of(const std::set<std::string>& laws) {
  std::string all;
  for (const std::string& law : laws) {
    if (!all.empty()) all += '|';
    for (const char c : law) {
      // Writes each special character as a set of one character: in a list of patterns, '|' and
      // brackets keep their meaning even after a backslash.
      const bool is_special = std::string_view("*?[]\\(|)").find(c) != std::string_view::npos;
      all += !is_special ? std::string(1, c) : c == '\\' ? R"([\\])" : fmt::format("[{}]", c);
    }
  }
  return laws.size() == 1 ? all : "@(" + all + ")";
}

Result<std::vector<records::Comparison>> against_good(const records::Run& good,
                                                      records::Run current) {
  current.plan.properties = good.plan.properties;  // the patterns choose laws, which may differ
  const Result<records::Baseline> before = baseline_of(good);
  if (!before) return tl::unexpected(before.error());
  const Result<records::Baseline> after = baseline_of(current);
  if (!after) return tl::unexpected(after.error());
  return compare(*before, *after, {"the good commit", "this commit"});
}

std::set<std::string> worse_laws(const std::vector<records::Comparison>& comparisons) {
  std::set<std::string> laws;
  for (const records::Comparison& comparison : comparisons) {
    for (const records::EntryChange& entry : comparison.entries) {
      if (entry.change == records::Change::worse) laws.insert(entry.key.law);
    }
  }
  return laws;
}

std::string judged_text(const JudgedCommit& commit) {
  return fmt::format("{} {}{}", commit.hash.substr(0, kShortHash), to_string(commit.verdict),
                     commit.reason.empty() ? "" : ": " + cases::one_line(commit.reason));
}

Result<void> write_plan(const BisectPlan& plan) {
  const nlohmann::ordered_json json{{"build", plan.build},
                                    {"program", plan.program},
                                    {"plan", cases::json_of(plan.plan)},
                                    {"jobs", plan.jobs}};
  return cases::write_file(plan.folder + kPlanFile,
                           json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
}

Result<BisectPlan> read_plan(const std::string& folder) {
  const std::string file = folder + kPlanFile;
  const Result<std::string> text = cases::read_text(file);
  if (!text) return tl::unexpected(text.error());
  return cases::read_json(*text, file, [&](const cases::JsonNode& root) {
    root.expect_object({"build", "program", "plan", "jobs"});
    BisectPlan plan;
    for (const cases::JsonNode& word : root["build"].elements()) plan.build.push_back(word.text());
    plan.program = root["program"].text();
    plan.plan = cases::read_as<records::Plan>(root["plan"]);
    plan.jobs = static_cast<int>(root["jobs"].integer(1, std::numeric_limits<int>::max()));
    plan.folder = folder;
    return plan;
  });
}

Result<void> note(const std::string& folder, const JudgedCommit& commit) {
  const nlohmann::ordered_json line{
      {"commit", commit.hash}, {"verdict", to_string(commit.verdict)}, {"reason", commit.reason}};
  std::ofstream stream(folder + kJudgedFile, std::ios::app);
  stream << line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  stream.close();
  if (stream) return {};
  return tl::unexpected(Error{folder + kJudgedFile, "", "cannot be written"});
}

std::vector<JudgedCommit> read_judged(const std::string& folder) {
  std::vector<JudgedCommit> all;
  const std::string file = folder + kJudgedFile;
  std::istringstream lines(cases::read_text(file).value_or(""));
  for (std::string line; std::getline(lines, line);) {
    const auto commit = cases::read_json(line, file, [](const cases::JsonNode& root) {
      return JudgedCommit{root["commit"].text(), root["verdict"].enumerator<CommitVerdict>(),
                          root["reason"].text()};
    });
    if (commit) all.push_back(*commit);  // no commit: a line that is still being written
  }
  return all;
}

}  // namespace rastercheck::gate
