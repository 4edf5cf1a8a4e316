#include "cli/picture_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "cases/contract_json.h"
#include "cases/json.h"
#include "cases/names.h"
#include "cases/picture_process.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/isolation.h"
#include "cli/own_program.h"

namespace rastercheck::cli {
namespace {

template <typename Enum>
void add_names(CLI::App& app, const std::string& option, std::string& word, const std::string& help,
               Enum /*type*/) {
  constexpr auto names = cases::names_of(Enum{});
  app.add_option(option, word, help)
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())))
      ->type_name("NAME");
}

void add_words(std::vector<std::string>& words, const char* option, const std::string& value) {
  if (!value.empty()) words.insert(words.end(), {option, value});
}

template <typename Enum>
void replace(Enum& value, const std::string& word) {
  if (!word.empty()) value = *cases::from_name<Enum>(word);
}

}  // namespace

void add_picture_flags(CLI::App& app, PictureFlags& flags) {
  app.add_option("--channels", flags.channels,
                 "What each channel shows, as in R=u,G=v,B=0,A=coverage: an attribute, depth, "
                 "triangle (its index plus 1), coverage, a number, or - (not judged); default: "
                 "the case's, or the attributes in order")
      ->delimiter(',')
      ->allow_extra_args(false)  // what follows are files
      ->type_name("NAME=WHAT");
  app.add_option("--background", flags.background,
                 "What each of --channels shows where nothing is drawn; default: 1 for depth, "
                 "else 0")
      ->delimiter(',')
      ->allow_extra_args(false)  // what follows are files
      ->type_name("NUMBER");
  add_names(app, "--storage", flags.storage,
            "How numbers are stored; default: as in the file, without a transfer function",
            cases::Storage{});
  add_names(app, "--rounding", flags.rounding,
            "Which neighbour of a number may be stored; default: nearest", cases::StoreRounding{});
  add_names(app, "--first-row", flags.first_row,
            "Which row, as displayed, the picture begins with; default: top", cases::FirstRow{});
  add_names(app, "--resolve", flags.resolve,
            "What the mean over a pixel's samples is taken of; default: linear",
            cases::ResolveOf{});
  add_names(app, "--alpha", flags.alpha,
            "Whether colours are stored multiplied by channel A; default: straight",
            cases::Alpha{});
  add_names(app, "--blend", flags.blend, "How colours are drawn over the background; default: off",
            cases::Blend{});
}

std::vector<std::string> words_of(const PictureFlags& flags) {
  std::vector<std::string> words;
  add_words(words, "--channels", fmt::format("{}", fmt::join(flags.channels, ",")));
  add_words(words, "--background", fmt::format("{}", fmt::join(flags.background, ",")));
  add_words(words, "--storage", flags.storage);
  add_words(words, "--rounding", flags.rounding);
  add_words(words, "--first-row", flags.first_row);
  add_words(words, "--resolve", flags.resolve);
  return words;
}

std::vector<std::string> words_of(const PicturePromise& promise) {
  std::vector<std::string> words;
  add_words(words, "--promised-by", promise.backend);
  add_words(words, "--contract", promise.contract);
  return words;
}

std::string promise_text(const PicturePromise& promise) {
  const std::string who =
      promise.backend.empty() ? "what the case asks for" : "what " + promise.backend + " promises";
  return promise.contract.empty() ? who : who + ", with the terms of " + promise.contract;
}

Result<cases::PictureLayout> layout_of(const cases::Case& c, const PictureFlags& flags) {
  cases::PictureLayout layout = c.picture.value_or(cases::PictureLayout());
  if (!flags.channels.empty()) layout.channels.clear();
  for (const std::string& one : flags.channels) {
    const std::size_t equals = one.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == one.size()) {
      return tl::unexpected(Error{"--channels", cases::printable(one), "is not NAME=WHAT, as R=u"});
    }
    layout.channels.push_back({one.substr(0, equals), one.substr(equals + 1), std::nullopt});
  }
  if (flags.background.size() > layout.channels.size()) {
    return tl::unexpected(Error{"--background", "",
                                fmt::format("{} numbers for {} channels", flags.background.size(),
                                            layout.channels.size())});
  }
  for (std::size_t i = 0; i < flags.background.size(); ++i) {
    layout.channels[i].background = flags.background[i];
  }
  if (!flags.storage.empty()) layout.storage = cases::from_name<cases::Storage>(flags.storage);
  replace(layout.rounding, flags.rounding);
  replace(layout.first_row, flags.first_row);
  replace(layout.resolve, flags.resolve);
  replace(layout.alpha, flags.alpha);
  replace(layout.blend, flags.blend);
  return layout;
}

Result<cases::PictureFile> picture_from_file(const std::string& file, bool is_chw) {
  std::vector<std::string> command{kOwnProgram, "picture"};
  if (is_chw) command.emplace_back("--chw");
  // After "--" a file name may begin with any character, even with "-".
  command.insert(command.end(), {"--", file});
  return cases::picture_of_process(command, file, cases::default_reader_limits());
}

void add_picture_promise(CLI::App& app, PicturePromise& promise) {
  app.add_option("--contract", promise.contract,
                 "Contract file that the picture is judged by; default: what the case asks for")
      ->type_name(kFile);
  app.add_option("--promised-by", promise.backend,
                 "Judge by what this backend promises, as for a picture that it has drawn")
      ->type_name(kBackend);
}

tl::expected<cases::Contract, ExitCode> contract_by(const PicturePromise& promise,
                                                    const cases::Case& c) {
  std::optional<cases::ContractTerms> terms;
  if (!promise.contract.empty()) {
    Result<cases::ContractTerms> read = cases::read_contract(promise.contract);
    if (!read) return tl::unexpected(fail(read.error()));
    terms = *std::move(read);
  }
  if (promise.backend.empty()) {
    const cases::Contract own = cases::contract_of(c);
    return terms ? cases::with_terms(own, *terms, c) : own;
  }
  const auto backend = backend_factory(kDefaultTimeout, std::move(terms)).make(promise.backend);
  if (!backend) return tl::unexpected(fail_backend(backend.error()));
  return (*backend)->contract(c);
}

}  // namespace rastercheck::cli
