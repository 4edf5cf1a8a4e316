// `rastercheck known add` and `known expect`: record known defects of a backend.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <system_error>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/files.h"
#include "cases/json.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/contract_option.h"
#include "cli/corpus_folder.h"
#include "cli/isolation.h"
#include "properties/campaign/known_defects.h"
#include "properties/campaign/waiver.h"
#include "records/expectations.h"
#include "records/known_json.h"
#include "reports/run_reader.h"

namespace rastercheck::cli::known_command {
namespace {

namespace fs = std::filesystem;

struct AddOptions {
  std::vector<std::string> files;
  std::string reason;
  std::string until;
  std::string list;
  std::string id;
  std::string backend;
  std::string contract;
  std::optional<cases::DriverPromise> promise;
  double timeout = kDefaultTimeout;
  bool quiet = false;
};

struct ExpectOptions {
  std::vector<std::string> runs;
  std::string output;
  bool quiet = false;
};

/// Counterexamples, and the one backend that draws them.
struct Given {
  std::vector<cases::Case> cases;
  std::string backend;
};

Result<Given> read_given(const AddOptions& options) {
  Given given{{}, options.backend};
  for (const std::string& file : options.files) {
    Result<cases::Case> c = cases::read_case(file);
    if (!c) return tl::unexpected(c.error());
    const std::string of = c->found ? c->found->backend : "";
    if (given.backend.empty()) given.backend = of;
    if (given.backend.empty()) {
      return tl::unexpected(
          Error{file, "/found", "is missing; expected a counterexample that a run saved"});
    }
    if (options.backend.empty() && of != given.backend) {
      return tl::unexpected(Error{
          file, "/found/backend",
          fmt::format("is '{}', but in {} it is '{}'; all counterexamples must be of one backend",
                      cases::printable(of), options.files[0], cases::printable(given.backend))});
    }
    given.cases.push_back(*std::move(c));
  }
  return given;
}

/// Reads the list; returns an empty one if the file does not exist.
Result<records::KnownList> read_list(const std::string& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return records::KnownList();
  Result<records::KnownList> list = cases::read_text(file).and_then(
      [&file](const std::string& text) { return records::parse_known(text, file); });
  if (list && list->driver) {
    return tl::unexpected(Error{
        file, "/driver",
        "is a driver's list, whose entries need a rule and a finding; write the entry by hand"});
  }
  return list;
}

/// True if the name of an entry, and of its case's file, may contain this character.
bool is_of_word(char c) {
  constexpr std::string_view kOthers = "-_.+";
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         kOthers.find(c) != std::string_view::npos;
}

/// Returns "little" for "plugin:build/liblittle.so", "cpu" for "cpu:precision=float32".
std::string stem_of(const std::string& backend) {
  const std::string name = properties::known_name_of(backend);
  const std::size_t colon = name.find(':');
  const bool is_plugin = name != backend || backend.starts_with("plugin:");
  std::string stem =
      is_plugin ? fs::path(name.substr(colon + 1)).stem().string() : name.substr(0, colon);
  if (is_plugin && stem.starts_with("lib")) stem.erase(0, 3);
  std::replace_if(
      stem.begin(), stem.end(), [](char c) { return !is_of_word(c); }, '-');
  return stem.empty() ? "known" : stem;
}

/// Returns the first of "little-1", "little-2", … that no entry uses, in this list or another one.
std::string free_id(const std::string& stem, const records::KnownList& list,
                    const properties::KnownDefects& known) {
  std::set<std::string> ids;
  for (const records::KnownEntry& entry : list.entries) ids.insert(entry.id);
  for (const properties::KnownDefect& one : known.defects) ids.insert(one.entry.id);
  std::size_t number = 1;
  while (ids.contains(fmt::format("{}-{}", stem, number))) ++number;
  return fmt::format("{}-{}", stem, number);
}

bool is_plain_word(const std::string& word) {
  return !word.empty() && word.front() != '.' && std::all_of(word.begin(), word.end(), &is_of_word);
}

/// Writes the entry's case, then the list with the entry, so that no list names a missing case.
Result<void> write_entry(const std::string& file, records::KnownList list,
                         const records::KnownEntry& entry, const cases::Case& shown) {
  list.entries.push_back(entry);
  // Writes nothing that could not be read back.
  const std::string text = cases::json_of(list).dump(2) + "\n";
  if (const auto read = records::parse_known(text, file); !read) {
    return tl::unexpected(read.error());
  }
  const fs::path of_case = fs::path(file).parent_path() / entry.case_file;
  std::error_code why;
  fs::create_directories(of_case.parent_path(), why);
  if (why) {
    return tl::unexpected(
        Error{of_case.parent_path().string(), "", "cannot be created: " + why.message()});
  }
  if (fs::exists(of_case, why)) {
    return tl::unexpected(
        Error{of_case.string(), "", "already exists; choose another name with --id"});
  }
  return cases::write_file(of_case.string(), cases::to_json(shown)).and_then([&] {
    return cases::write_file(file, text);
  });
}

/// Says what the entry waives and for which laws: an entry that names laws also hides every other
/// defect that violates them.
void print_entry(const records::KnownEntry& entry, const std::string& file,
                 const std::string& sentence) {
  const nlohmann::json list = cases::json_of(records::KnownList{std::nullopt, {entry}});
  const nlohmann::json& written = list.at("entries").at(0);
  fmt::print("{} in {}: {}\n  {}: {}, when {}\n", entry.id, file, cases::printable(sentence),
             entry.laws.empty() ? "in every property"
                                : fmt::format("in {} only", fmt::join(entry.laws, ", ")),
             cases::json_line(written.at("verdicts")), cases::json_line(written.at("when")));
}

ExitCode add(const AddOptions& options) {
  const Result<Given> given = read_given(options);
  if (!given) return fail(given.error());
  const std::string file =
      options.list.empty() ? properties::list_beside(given->backend) : options.list;
  if (file.empty()) {
    return fail({"--known", "",
                 fmt::format("is required: {} is not a plugin, so it has no list beside it",
                             cases::printable(given->backend))});
  }
  const Result<records::KnownList> list = read_list(file);
  if (!list) return fail(list.error());
  const auto terms = read_terms(options.contract, options.promise);
  if (!terms) return fail(terms.error());
  const backends::BackendFactory factory = backend_factory(options.timeout, *terms);
  if (const ExitCode code = check_backends(factory, {given->backend}); code != ExitCode::ok) {
    return code;
  }
  const auto backend = factory.make(given->backend);
  if (!backend) return fail(backend.error());
  // Corrects already known faults in the drawings before looking for this fault.
  properties::KnownSources sources = known_sources_of(properties::KnownSources());
  std::error_code ignored;
  if (fs::exists(file, ignored)) sources.push_back(file);
  const auto read = properties::read_known_defects(sources, given->backend, **backend);
  if (!read) return fail(read.error());
  const properties::KnownDefects known = read->value_or(properties::KnownDefects());
  Result<properties::Waiver> waiver =
      properties::make_waiver(given->cases, options.files, **backend, known);
  if (!waiver) return fail(waiver.error());

  records::KnownEntry& entry = waiver->entry;
  entry.id = options.id.empty() ? free_id(stem_of(given->backend), *list, known) : options.id;
  if (!is_plain_word(entry.id)) {
    return fail(
        {"--id", "",
         "must be a name of letters, digits, '-', '_', '+' and '.', and must not begin with '.'"});
  }
  entry.reason = options.reason;
  entry.until = options.until;
  entry.backends = {properties::known_name_of(given->backend)};
  entry.case_file = "known/" + entry.id + ".json";
  cases::Case shown = given->cases.front();
  shown.found->backend = entry.backends.front();
  const Result<void> written = write_entry(file, *list, entry, shown);
  if (!written) return fail(written.error());
  if (options.quiet) return ExitCode::ok;
  print_entry(entry, file, waiver->sentence);
  return ExitCode::ok;
}

ExitCode expect(const ExpectOptions& options) {
  std::vector<records::Run> runs;
  for (const std::string& folder : options.runs) {
    Result<records::Run> run = reports::read_run(folder + "/run.json");
    if (!run) return fail(run.error());
    runs.push_back(*std::move(run));
  }
  const records::ExpectationTexts texts = records::expectations_of(runs);
  const std::pair<const char*, const std::string*> files[] = {
      {"-fails.txt", &texts.fails}, {"-flakes.txt", &texts.flakes}, {"-skips.txt", &texts.skips}};
  for (const auto& [ending, text] : files) {
    const std::string file = options.output + ending;
    const Result<void> written = cases::write_file(file, *text);
    if (!written) return fail(written.error());
    if (options.quiet) continue;
    fmt::print("{}: {}\n", file, std::count(text->begin(), text->end(), '\n'));
  }
  return ExitCode::ok;
}

void set_up_add(CLI::App& app, AddOptions& options) {
  app.add_option("COUNTEREXAMPLE", options.files,
                 "Counterexamples of one cause and backend, as saved by a run")
      ->type_name(kFile)
      ->required();
  app.add_option("--reason", options.reason, "Why the defect is accepted, in one sentence")
      ->type_name("TEXT")
      ->required();
  app.add_option("--until", options.until,
                 "Last day on which the defect counts as known, such as 2027-01-31")
      ->type_name("DATE");
  app.add_option(
         "--known", options.list,
         "List to add the entry to, created if missing; default: known.json beside the plugin")
      ->type_name(kFile);
  app.add_option("--id", options.id, "Name of the entry; default: the backend's name and a number")
      ->type_name("NAME");
  app.add_option("--backend", options.backend,
                 "Backend to draw with; default: that of the counterexamples")
      ->type_name(kBackend);
  add_contract(app, options.contract);
  add_promise(app, options.promise);
  add_timeout(app, options.timeout);
  app.add_flag("-q,--quiet", options.quiet, "Print nothing");
}

Action set_up(CLI::App& app) {
  const auto adding = std::make_shared<AddOptions>();
  const auto expecting = std::make_shared<ExpectOptions>();
  app.require_subcommand(1);
  CLI::App* const add_command =
      app.add_subcommand("add", "Waive the fault that counterexamples show");
  set_up_add(*add_command, *adding);
  add_command->footer(
      "Finds out by trial what the counterexamples need to fail, and writes an entry with just "
      "these "
      "conditions. Runs read known.json beside a plugin, and the lists that --known names; a run "
      "whose violations are all known ends with exit code 0.\n\n"
      "Exit code 0 if the entry was written, 2 if the property holds here, 4 if the backend cannot "
      "run here.\n\n"
      "Example:\n"
      "  rastercheck known add rastercheck-out/counterexamples/NAME.json \\\n"
      "    --reason \"Edges are inclusive.\" --until 2027-06-30");
  CLI::App* const expect_command =
      app.add_subcommand("expect", "Write expectation lists from the results of runs");
  expect_command
      ->add_option("DIR", expecting->runs,
                   "Output folders of runs; properties that only some of them violated are flakes")
      ->type_name(kFolder)
      ->required();
  expect_command
      ->add_option("--output", expecting->output,
                   "Start of the three lists' names: NAME-fails.txt, NAME-flakes.txt, "
                   "NAME-skips.txt")
      ->type_name("NAME")
      ->required();
  expect_command->add_flag("-q,--quiet", expecting->quiet, "Print nothing");
  expect_command->footer(
      "Prints the number of names in each list.\n\n"
      "Example:\n"
      "  rastercheck known expect rastercheck-out --output llvmpipe\n"
      "  rastercheck run --backend gl:llvmpipe --known llvmpipe-fails.txt");
  app.footer("docs/known-defects.md describes the lists.");
  return [&app, adding, expecting] {
    return app.got_subcommand("add") ? add(*adding) : expect(*expecting);
  };
}

const Registration kRegistration("known", "Record known defects of a backend", &set_up);

}  // namespace
}  // namespace rastercheck::cli::known_command
