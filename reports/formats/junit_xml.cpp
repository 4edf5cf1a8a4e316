// junit.xml: the format of test results that CI servers read. A suite is a backend, a test a law.
//
//   failure   the law is violated; shown by class, with a command that replays each counterexample
//   error     a label that had to be reached was not: the law did not test what it claims to
//   skipped   the law checked no case, or no sample of a scene was judged; the message says why (a
//             scene is a test, too)
//
// Known violations of a driver are not failures; the test's output mentions them. Only the
// suite's properties depend on machine and time; tests have no duration. reports/schema/junit.xsd
// describes the format.

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <vector>

#include "records/share.h"
#include "records/summary.h"
#include "reports/commands.h"
#include "reports/finding_text.h"
#include "reports/format.h"
#include "reports/internal/html.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports::junit_xml_format {
namespace {

using records::LawSummary;
using records::LawVerdict;
using records::Run;

/// The numbers of tests by outcome.
struct Outcomes {
  std::size_t tests = 0;
  std::size_t failures = 0;
  std::size_t errors = 0;
  std::size_t skipped = 0;

  void add(const LawSummary& row, bool requires_cases) {
    ++tests;
    if (row.verdict == LawVerdict::violated) {
      ++failures;
    } else if (!row.unreached.empty() || (requires_cases && row.verdict == LawVerdict::thin)) {
      ++errors;
    } else if (row.verdict == LawVerdict::not_checked) {
      ++skipped;
    }
  }
  void add(const records::SceneResult& scene) {
    ++tests;
    if (scene.judged == 0) ++skipped;
  }
  std::string attributes() const {
    return fmt::format(R"(tests="{}" failures="{}" errors="{}" skipped="{}")", tests, failures,
                       errors, skipped);
  }
};

/// The facts that a reader of a failed test needs first: where the law failed, by how much, and how
/// to repeat the failure.
std::string failure_text(const Run& run, const LawSummary& row) {
  std::string text;
  for (const records::Counterexample& counterexample : run.counterexamples) {
    const cases::Found found = counterexample.source.found.value_or(cases::Found());
    if (found.law != row.law || found.backend != row.backend) continue;
    text += replay_command(run, records::file_of(counterexample)) + "\n";
    for (const records::Violation& violation : counterexample.violations) {
      text += finding_text(violation, counterexample.source) + "\n";
    }
  }
  return text;
}

std::string outcome_of(const Run& run, const LawSummary& row) {
  if (row.verdict == LawVerdict::violated) {
    std::string_view type = "violated";
    for (const records::Counterexample& counterexample : run.counterexamples) {
      const auto& found = counterexample.source.found;
      if (!found || found->law != row.law || found->backend != row.backend) continue;
      type = found->verdict;
      break;
    }
    return fmt::format("<failure message=\"{}\" type=\"{}\">{}</failure>\n",
                       html(verdict_text(row)), html(type), html(failure_text(run, row)));
  }
  std::string text;
  for (const records::UnreachedLabel& label : row.unreached) {
    text += fmt::format("<error message=\"{}\" type=\"label not reached\"/>\n",
                        html(records::unreached_sentence(label)));
  }
  if (run.plan.require_cases && row.unreached.empty() && row.verdict == LawVerdict::thin) {
    text +=
        fmt::format("<error message=\"{}\" type=\"too few cases\"/>\n", html(verdict_text(row)));
  }
  if (row.unreached.empty() && row.verdict == LawVerdict::not_checked) {
    const std::string why = records::why_not_checked(row);
    text += fmt::format("<skipped message=\"{}\"/>\n", html(why.empty() ? verdict_text(row) : why));
  }
  return text;
}

std::string test_of(const Run& run, const LawSummary& row) {
  std::string text = fmt::format("<testcase classname=\"rastercheck.{}\" name=\"{}\">\n",
                                 html(row.backend), html(row.law));
  text += outcome_of(run, row);
  text += fmt::format(
      "<system-out>{} checked, {} and {} judged{}; worst {} scale ULP{}</system-out>\n",
      counted(row.cases.checked, "case", "cases"),
      counted(row.judged.fragments, "fragment", "fragments"),
      counted(row.judged.values, "value", "values"),
      row.judged.not_judged.empty() ? "" : ", not: " + records::not_judged_words(row.judged),
      html(number_text(row.ideal.worst)),
      row.cases.known == 0 ? "" : ", " + counted(row.cases.known, "known case", "known cases"));
  return text + "</testcase>\n";
}

/// The scene as a test, which is skipped if no sample of the scene was judged. Errors of the scene
/// fail the tests of laws.
std::string test_of(const records::SceneResult& scene) {
  const std::string sentence = html(records::scene_sentence(scene));
  return fmt::format(
      "<testcase classname=\"rastercheck.{}\" name=\"scene {}\">\n{}"
      "<system-out>{}</system-out>\n</testcase>\n",
      html(scene.backend), html(scene.file),
      scene.judged == 0 ? fmt::format("<skipped message=\"{}\"/>\n", sentence) : "", sentence);
}

std::string properties_of(const Run& run) {
  std::string text = "<properties>\n";
  const auto add = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("<property name=\"{}\" value=\"{}\"/>\n", html(name), html(value));
  };
  add("command", run_command(run));
  for (const auto& [name, value] : run.environment) add(name, value);
  return text + "</properties>\n";
}

std::string write(const Run& run) {
  const std::vector<LawSummary> rows = records::summarize(run);
  Outcomes of_all;
  std::string suites;
  for (const std::string& backend : run.plan.backends) {
    Outcomes outcomes;
    std::string tests;
    for (const LawSummary& row : rows) {
      if (row.backend != backend) continue;
      outcomes.add(row, run.plan.require_cases.has_value());
      of_all.add(row, run.plan.require_cases.has_value());
      tests += test_of(run, row);
    }
    for (const records::SceneResult& scene : run.scenes) {
      if (scene.backend != backend) continue;
      outcomes.add(scene);
      of_all.add(scene);
      tests += test_of(scene);
    }
    suites += fmt::format("<testsuite name=\"{}\" {}>\n{}{}</testsuite>\n", html(backend),
                          outcomes.attributes(), properties_of(run), tests);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"RasterCheck\" {}>\n"
      "{}</testsuites>\n",
      of_all.attributes(), suites);
}

const FormatRegistration kRegistration({"junit", "junit.xml", &write});

}  // namespace
}  // namespace rastercheck::reports::junit_xml_format
