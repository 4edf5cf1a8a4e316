#include "properties/campaign/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "cases/case_writer.h"
#include "cases/files.h"
#include "cases/json.h"
#include "cases/names.h"
#include "properties/campaign/check_case.h"
#include "properties/campaign/corpus.h"
#include "properties/campaign/internal/hints.h"
#include "properties/campaign/shrink.h"
#include "properties/draw.h"
#include "properties/fitted_case.h"
#include "records/enclosure.h"
#include "records/summary.h"

namespace rastercheck::properties {
namespace {

using records::Counterexample;
using records::Violation;

constexpr int kDigits = 6;  ///< most digits of errors and distances

Result<void> read_number(const char* variable, std::uint64_t& number) {
  const char* const value = std::getenv(variable);
  if (value == nullptr) return {};
  const std::string text = value;
  const char* const end = text.data() + text.size();
  std::uint64_t read = 0;
  const auto [stop, problem] = std::from_chars(text.data(), end, read);
  if (stop != end || problem != std::errc()) {
    return tl::unexpected(
        Error{variable, "",
              fmt::format("'{}' is not an integer from 0 to 2^64 - 1", cases::printable(text))});
  }
  number = read;
  return {};
}

/// Returns a file name: "MyRasterizer-whole-pixels-move.json".
std::string file_name(const std::string& name, std::string_view law) {
  std::string file = fmt::format("{}-{}", name, law);
  for (char& c : file) {
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (!is_plain) c = '-';
  }
  return file + ".json";
}

std::string place_text(const Violation& v, const cases::Case& c) {
  std::string text = fmt::format("pixel ({}, {}), sample {} of triangle {}", v.place.x, v.place.y,
                                 v.place.sample, v.place.triangle);
  if (!v.attribute) return fmt::format("{}, {}", text, to_string(v.kind));
  text += fmt::format(", attribute {}", *v.attribute);
  if (*v.attribute < c.attributes.size() && !c.attributes[*v.attribute].name.empty()) {
    text += fmt::format(" ('{}')", cases::printable(c.attributes[*v.attribute].name));
  }
  return text;
}

std::string violation_text(const Violation& v, const cases::Case& c) {
  const std::string note = cases::printable(v.note);
  if (!v.has_place()) return fmt::format("  {}\n", note);
  std::string text = fmt::format("  {}\n    exactly: {}\n    drawn:   {}\n", place_text(v, c),
                                 cases::printable(v.exact), cases::printable(v.actual));
  if (v.error) {
    text += fmt::format("    off by   {} scale ULP", records::to_decimal(*v.error, kDigits));
    if (v.bound) text += fmt::format(", {} allowed", records::to_decimal(*v.bound, kDigits));
    text += "\n";
  }
  if (v.distance) {
    text += fmt::format("    distance to the deciding boundary: {} pixels\n",
                        records::to_decimal(*v.distance, kDigits));
  }
  if (!note.empty()) text += fmt::format("    {}\n", note);
  return text;
}

/// Says where the case was found, and whether it was shrunk.
std::string history_text(const Counterexample& one, const std::string& name) {
  const cases::Found& found = *one.source.found;
  std::string text = one.origin == records::Origin::corpus
                         ? fmt::format("case {} of the corpus", found.index)
                         : records::random_case_text(found);
  if (!name.empty()) text += fmt::format(", “{}”", cases::printable(name));
  if (!one.is_shrunk()) return text + ", as found";
  return text + fmt::format(", shrunk in {} tries", one.shrinking->tries);
}

/// Lists the commands that take a case file.
std::string commands_text(const std::string& file) {
  return fmt::format(
      "  What is right: rastercheck oracle {0}\n"
      "  Another backend: rastercheck replay {0} --backend cpu\n",
      file);
}

/// Saves the case file and returns commands that read it. Returns the file's text as well if it is
/// not saved.
std::string file_text(const cases::Case& c, const std::string& folder) {
  std::string problem;
  if (!folder.empty()) {
    const std::string file =
        (std::filesystem::path(folder) / file_name(c.found->backend, c.found->law)).string();
    std::error_code ignored;  // If the folder is missing, writing reports it.
    std::filesystem::create_directories(folder, ignored);
    const Result<void> written = cases::write_file(file, cases::to_json(c));
    if (written) return commands_text(file);
    problem = fmt::format("  The case could not be saved: {}\n", to_string(written.error()));
  }
  return fmt::format("{}{}  The case file, to pass to these commands on standard input:\n{}",
                     problem, commands_text("-"), cases::to_json(c));
}

/// Says what the drawing of a case, as it was found, looks like, if one simple change explains all
/// that is wrong in it.
std::string hint_text(const cases::Case& found, backends::Backend& backend) {
  const DrawnParts all{records::DrawnPart::coverage, records::DrawnPart::depth,
                       records::DrawnPart::values};
  const auto hints = hints_of(found, backend, all, {});
  if (!hints || hints->empty()) return "";
  return fmt::format("  Hint: it draws as if {}.\n", cases::printable(hints->front()));
}

/// Lists other laws that the case violates: their tests may fail for the same reason, and each
/// test, alone in its process, cannot know of the others. Lists none if nothing was drawn, which
/// violates every law.
std::string also_violated_text(const Law& law, backends::Backend& backend,
                               const Counterexample& one) {
  const bool is_drawn = std::none_of(
      one.violations.begin(), one.violations.end(),
      [](const Violation& v) { return v.fragment_class >= records::FragmentClass::failed; });
  if (!is_drawn) return "";
  constexpr std::size_t kMostListed = 6;
  std::size_t count = 0;
  std::string text;
  for (const Law& other : laws()) {
    if (other.id == law.id || !is_promised(other, backend)) continue;
    const Check check = check_or_note(other, one.source, backend, 0);
    if (!check.is_applicable || check.violation_count == 0) continue;
    if (++count <= kMostListed) text += fmt::format("    “{}”\n", other.sentence);
  }
  if (count > kMostListed) text += fmt::format("    … and {} more\n", count - kMostListed);
  if (text.empty()) return text;
  return "  Also violated by this case, probably for the same reason:\n" + text;
}

std::string counterexample_text(const Law& law, const Counterexample& one,
                                backends::Backend& backend, const std::string& hint,
                                const TrialOptions& options) {
  const cases::Case& c = one.source;
  std::string text = fmt::format(
      "{} violates the property “{}”: {}\n  Why it must hold: {}\n  Found in {}.\n",
      c.found->backend, law.sentence, c.found->verdict, law.reason, history_text(one, c.name));
  if (!one.violations.empty()) text += violation_text(one.violations.front(), c);
  if (one.violation_count > 1) {
    text += fmt::format("  … {} violations in all\n", one.violation_count);
  }
  for (const std::string& line : one.close_up) text += "    " + line + "\n";
  text += hint + also_violated_text(law, backend, one);
  return text + file_text(c, options.output);
}

/// Shrinks and describes the first counterexample, or describes a fault of the oracle.
std::string findings_text(const Law& law, backends::Backend& backend, const Findings& findings,
                          const TrialOptions& options) {
  Findings shrunk;
  std::string hint;
  if (!findings.fault) {
    const Counterexample& found = findings.counterexamples.front();
    const ShrinkLimits limits = shrink_limits(options.shrinking, found);
    shrink_counterexample(law, backend, found, limits, shrunk);
    if (limits.tries > 0) hint = hint_text(found.source, backend);
  }
  const std::optional<std::string>& fault = findings.fault ? findings.fault : shrunk.fault;
  if (fault)
    return fmt::format("“{}” could not be checked: {}", law.sentence, cases::printable(*fault));
  return counterexample_text(law, shrunk.counterexamples.front(), backend, hint, options);
}

/// Checks cases up to the first that fails.
Findings check_cases(const Law& law, const std::string& name, backends::Backend& backend,
                     const std::vector<cases::Case>& corpus, const TrialOptions& options) {
  Findings findings;
  const auto is_over = [&findings] {
    return findings.fault.has_value() || !findings.counterexamples.empty();
  };
  const cases::Capabilities capabilities = capabilities_of(backend);
  for (std::uint64_t i = 0; i < corpus.size() && !is_over(); ++i) {
    check_case(law, name, backend, options.seed,
               {fitted_case(capabilities, corpus[i]), std::string(records::kCorpusStratum), i,
                records::Origin::corpus},
               findings);
  }
  for (std::uint64_t i = 0; i < options.cases && !is_over(); ++i) {
    Generated generated = random_case(law, options.seed, i, capabilities);
    check_case(law, name, backend, options.seed,
               {std::move(generated.source), std::move(generated.stratum), i}, findings);
  }
  return findings;
}

std::uint64_t checked_cases(const records::RecordSet& records) {
  std::uint64_t checked = 0;
  for (const auto& [key, record] : records) checked += record.cases.checked;
  return checked;
}

/// Lists why the law applied to no case, the most frequent reason first.
std::string reasons_text(const records::RecordSet& records) {
  records::LawSummary row;
  for (const auto& [key, record] : records) {
    for (const auto& [why, cases] : record.not_applicable_because) {
      row.not_applicable_because[why] += cases;
    }
  }
  std::string text;
  for (const auto& [cases, why] : records::reasons_of(row)) {
    text +=
        fmt::format("  {} {}: {}\n", cases, cases == 1 ? "case" : "cases", cases::printable(why));
  }
  return text;
}

/// Names the labels that random cases should have reached and did not.
std::string unreached_text(const Law& law, const std::string& name, backends::Backend& backend,
                           const records::RecordSet& records) {
  std::string text;
  for (const records::UnreachedLabel& one :
       unreached_labels(law, promises_of(name, &backend, {}), records)) {
    text += fmt::format("  “{}” was reached by {} of {} random cases; at least {} are required\n",
                        one.label, one.reached, one.checked, one.least);
  }
  if (text.empty()) return text;
  return fmt::format("{} does not violate “{}”, but was hardly tested:\n{}", name, law.sentence,
                     text);
}

}  // namespace

Result<TrialOptions> trial_options(const std::string& corpus) {
  TrialOptions options;
  for (const auto& [variable, number] : {std::pair("RASTERCHECK_SEED", &options.seed),
                                         std::pair("RASTERCHECK_CASES", &options.cases)}) {
    const Result<void> read = read_number(variable, *number);
    if (!read) return tl::unexpected(read.error());
  }
  if (const char* const folder = std::getenv("RASTERCHECK_CORPUS")) {
    options.corpus = folder;
  } else if (std::error_code ignored; std::filesystem::is_directory(corpus, ignored)) {
    options.corpus = corpus;
  }
  if (const char* const folder = std::getenv("RASTERCHECK_OUTPUT")) options.output = folder;
  return options;
}

Trial try_law(const Law& law, const std::string& name, const MakeTried& make,
              const TrialOptions& options) {
  std::vector<cases::Case> corpus;
  if (!options.corpus.empty()) {
    Result<std::vector<cases::Case>> read = read_corpus(options.corpus);
    if (!read) return {Trial::Outcome::failed, to_string(read.error())};
    corpus = *std::move(read);
  }
  const std::unique_ptr<backends::Backend> backend = make();
  if (!backend) return {Trial::Outcome::failed, name + " could not be created"};
  if (!is_promised(law, *backend)) {
    return {Trial::Outcome::skipped,
            fmt::format("{} does not promise “{}”: {}\n  The property does not apply to: {}", name,
                        law.sentence, reason_of(law, *backend, {}), law.exceptions)};
  }

  const Findings findings = check_cases(law, name, *backend, corpus, options);
  if (findings.fault || !findings.counterexamples.empty()) {
    return {Trial::Outcome::failed, findings_text(law, *backend, findings, options)};
  }
  if (const std::optional<Error> lost = backend->is_lost()) {
    return {Trial::Outcome::failed, fmt::format("“{}” could not be checked: {}", law.sentence,
                                                cases::printable(to_string(*lost)))};
  }
  if (checked_cases(findings.records) == 0) {
    return {Trial::Outcome::skipped,
            fmt::format("nothing was checked: “{}” applies to none of {} cases\n{}", law.sentence,
                        corpus.size() + options.cases, reasons_text(findings.records))};
  }
  std::string unreached = unreached_text(law, name, *backend, findings.records);
  if (!unreached.empty()) return {Trial::Outcome::failed, std::move(unreached)};
  return {};
}

}  // namespace rastercheck::properties
