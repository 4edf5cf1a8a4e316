#include "reports/cause_text.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string_view>

#include "cases/json.h"
#include "reports/counterexample_text.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

const records::Counterexample& first_of(const records::Run& run, const records::Cause& cause) {
  return run.counterexamples[static_cast<std::size_t>(cause.counterexamples.front())];
}

std::size_t laws_of(const records::Run& run, const records::Cause& cause) {
  std::set<std::string_view> laws;
  for (const std::uint64_t place : cause.counterexamples) {
    const auto& found = run.counterexamples[static_cast<std::size_t>(place)].source.found;
    if (found) laws.insert(found->law);
  }
  return laws.size();
}

}  // namespace

std::string cause_counts(const records::Run& run) {
  return fmt::format("{}, {}",
                     counted(run.counterexamples.size(), "counterexample", "counterexamples"),
                     counted(run.causes.size(), "cause", "causes"));
}

std::string cause_line(const records::Run& run, const records::Cause& cause) {
  std::string line =
      fmt::format("{}: {} of {}", cases::printable(cause.sentence),
                  counted(cause.counterexamples.size(), "counterexample", "counterexamples"),
                  counted(laws_of(run, cause), "property", "properties"));
  if (run.plan.backends.size() > 1) line += ", on " + cases::printable(cause.backend);
  return line;
}

std::string hint_text(const records::Cause& cause) {
  if (!cause.hint) return "";
  const std::uint64_t wrong = cause.hint->wrong;
  return fmt::format("it draws as if {} ({})", cases::printable(cause.hint->change),
                     wrong == 1 ? std::string("its one wrong drawing")
                                : fmt::format("{} of {} wrong drawings", cause.hint->right, wrong));
}

std::vector<std::size_t> without_cause(const records::Run& run) {
  std::set<std::uint64_t> named;
  for (const records::Cause& cause : run.causes) {
    named.insert(cause.counterexamples.begin(), cause.counterexamples.end());
  }
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < run.counterexamples.size(); ++i) {
    if (!named.contains(i)) rest.push_back(i);
  }
  return rest;
}

std::string causes_text(const records::Run& run, const CommandOf& command_of) {
  std::string text;
  for (std::size_t i = 0; i < run.causes.size(); ++i) {
    const records::Cause& cause = run.causes[i];
    text += fmt::format("\nCause {}: {}\n", i + 1, cause_line(run, cause));
    if (cause.hint) text += fmt::format("  Hint: {}.\n", hint_text(cause));
    for (const std::string& tried : cause.tried) {
      text += fmt::format("  It {}.\n", cases::printable(tried));
    }
    const records::Counterexample& first = first_of(run, cause);
    text += counterexample_text(first, command_of(first));
  }
  return text;
}

std::string causes_list(const records::Run& run, const CommandOf& command_of) {
  std::string text = fmt::format("{}:\n", cause_counts(run));
  for (std::size_t i = 0; i < run.causes.size(); ++i) {
    const records::Cause& cause = run.causes[i];
    text += fmt::format("  {}. {}\n", i + 1, cause_line(run, cause));
    if (cause.hint) text += fmt::format("     hint: {}\n", hint_text(cause));
    text += fmt::format("     {}\n", command_of(first_of(run, cause)));
  }
  return text;
}

}  // namespace rastercheck::reports
