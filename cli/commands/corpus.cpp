// `rastercheck corpus add FILE`: turns a counterexample into a case of the corpus, which every
// later run checks.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/files.h"
#include "cases/json.h"
#include "cli/command.h"
#include "cli/corpus_folder.h"
#include "properties/law.h"

namespace rastercheck::cli::corpus_command {
namespace {

struct Options {
  std::string file;
  std::string as;
  std::string name;
  std::string corpus;
  bool quiet = false;
};

/// True if a word may be a file name of the corpus, without folder or extension.
bool is_plain_word(const std::string& word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

/// Returns a sentence on what the case is for, to be used if the user gave none.
std::string sentence_of(const cases::Case& c) {
  if (!c.found) return c.name;
  const properties::Law* const law = properties::find_law(c.found->law);
  const std::string_view broken = law == nullptr ? c.found->law : law->sentence;
  return fmt::format("{} violated \"{}\": {}", c.found->backend, broken, c.found->verdict);
}

ExitCode add(const Options& options) {
  Result<cases::Case> c = cases::read_case(options.file);
  if (!c) return fail(c.error());
  const std::string word = options.as.empty() && options.file != "-"
                               ? std::filesystem::path(options.file).stem().string()
                               : options.as;
  if (!is_plain_word(word)) {
    return fail(
        {"--as", "",
         fmt::format("'{}' is not a valid name; use only a-z, 0-9 and -", cases::printable(word))});
  }
  const std::string folder = options.corpus.empty() ? corpus_folder() : options.corpus;
  std::error_code why;
  std::filesystem::create_directories(folder, why);
  if (why) return fail({folder, "", "cannot be created: " + why.message()});
  const std::string file = (std::filesystem::path(folder) / (word + ".json")).string();
  if (std::filesystem::exists(file, why)) {
    return fail({file, "", "already exists; choose another name with --as"});
  }
  c->name = options.name.empty() ? sentence_of(*c) : options.name;
  if (c->name.empty())
    return fail({"--name", "", "is required: say in a sentence what the case is for"});
  // Every law checks the corpus, not only the law that found the case.
  c->found.reset();
  const Result<void> written = cases::write_file(file, cases::to_json(*c));
  if (!written) return fail(written.error());
  if (!options.quiet) fmt::print("{}\n", file);
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.require_subcommand(1);
  CLI::App* add_command = app.add_subcommand("add", "Add a case or counterexample to the corpus");
  add_command->add_option("FILE", options->file, "Case file; - reads standard input")
      ->type_name(kFile)
      ->required();
  add_command
      ->add_option("--as", options->as,
                   "Name in the corpus: a-z, 0-9 and -; default: the name of FILE")
      ->type_name("NAME");
  add_command
      ->add_option("--name", options->name,
                   "What the case is for, in one sentence; default: what it violated")
      ->type_name("TEXT");
  add_command
      ->add_option("--corpus", options->corpus,
                   "Folder of case files, created if missing; default: the corpus that comes with "
                   "the program")
      ->type_name(kFolder);
  add_command->add_flag("-q,--quiet", options->quiet, "Print nothing");
  constexpr const char* kFooter =
      "Prints the new file's name. Every run checks the corpus first.\n\n"
      "Example:\n"
      "  rastercheck corpus add rastercheck-out/counterexamples/NAME.json --corpus mine";
  app.footer(kFooter);
  add_command->footer(kFooter);
  return [options] { return add(*options); };
}

const Registration kRegistration("corpus", "Keep counterexamples for later runs", &set_up);

}  // namespace
}  // namespace rastercheck::cli::corpus_command
