#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/cli/help.h"
#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::completion_test {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;
using testing::StartsWith;
using testing::UnorderedElementsAre;

/// Returns what bash offers to complete `line`. `words` are the words as bash splits them, which it
/// does at ':' and '=' too.
std::vector<std::string> completions(const std::string& line, const std::vector<std::string>& words,
                                     const std::string& folder = ".") {
  std::string quoted;
  for (const std::string& word : words) quoted += fmt::format(" \"{}\"", word);
  const Outcome outcome = run_shell(fmt::format(R"(cd "{}" && bash -c '
source <("$0" completion bash); line=$1; shift
COMP_WORDS=("$0" "$@"); COMP_CWORD=$#; COMP_LINE="$0 $line"; COMP_POINT=${{#COMP_LINE}}
_rastercheck "$0"; printf "%s\n" "${{COMPREPLY[@]}}"' "$PROGRAM" "{}"{})",
                                                folder, line, quoted));
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(outcome.err, "") << line;
  std::istringstream lines(outcome.out);
  std::vector<std::string> all;
  for (std::string one; std::getline(lines, one);) {
    if (!one.empty()) all.push_back(one);
  }
  return all;
}

/// Like above, for lines that bash splits only at spaces.
std::vector<std::string> completions(const std::vector<std::string>& words,
                                     const std::string& folder = ".") {
  return completions(joined(words), words, folder);
}

TEST(Completion, OffersEveryCommandAndOptionOfTheHelp) {
  for (const Help& help : all_help()) {
    const auto with = [&help](const char* last) {
      std::vector<std::string> words = help.command;
      words.emplace_back(last);
      return completions(words);
    };
    EXPECT_THAT(help.options, Not(IsEmpty())) << joined(help.command);
    EXPECT_THAT(with("--"), IsSupersetOf(help.options)) << joined(help.command);
    if (!help.commands.empty()) {
      EXPECT_EQ(with(""), help.commands) << joined(help.command);
    }
  }
}

TEST(Completion, OffersWhatBeginsAlike) {
  EXPECT_THAT(completions({"re"}), ElementsAre("render", "replay", "report"));
  EXPECT_THAT(completions({"corpus", "a"}), ElementsAre("add"));
  EXPECT_THAT(completions({"run", "--sh"}),
              ElementsAre("--shard", "--shrink-tries", "--shrink-seconds"));
  EXPECT_THAT(completions({"baseline", "save", "--o"}), ElementsAre("--output"));
  EXPECT_THAT(completions({"frobnicate", ""}), IsEmpty());
}

TEST(Completion, OffersValuesWhereTheyAreKnown) {
  EXPECT_THAT(completions({"import", "--rules", ""}), ElementsAre("opengl", "vulkan", "d3d"));
  EXPECT_THAT(completions({"list", "b"}), ElementsAre("backends"));
  EXPECT_THAT(completions("plugin new --language=c", {"plugin", "new", "--language", "=", "c"}),
              ElementsAre("c", "c++"));
  EXPECT_THAT(completions({"plugin", "new", "--language", "r"}), ElementsAre("rust"));
  EXPECT_THAT(completions({"run", "--cases", ""}), IsEmpty());
  EXPECT_THAT(completions({"run", "--seed", "-"}), IsEmpty());
}

TEST(Completion, OffersTheNextOfAList) {
  EXPECT_THAT(completions({"run", "--format", "html,ju"}), ElementsAre("html,junit"));
  EXPECT_THAT(completions("run --format=html,ju", {"run", "--format", "=", "html,ju"}),
              ElementsAre("html,junit"));
}

TEST(Completion, OffersThePropertiesByTheirIds) {
  EXPECT_THAT(completions({"run", "--property", "values-at"}),
              ElementsAre("values-at-vertices-come-back"));
  EXPECT_THAT(completions({"run", "--property", "'values-stay-w"}),
              ElementsAre("values-stay-within-the-bound"));
}

// Kills: completions that repeat the text before the ':'.
TEST(Completion, OffersBackendsBehindTheColon) {
  EXPECT_THAT(completions({"probe", "c"}), Contains("cpu:output=framebuffer"));
  EXPECT_THAT(completions("run --backend method:q-", {"run", "--backend", "method", ":", "q-"}),
              UnorderedElementsAre("q-matrix", "q-matrix-float"));
  const TemporaryFolder folder;
  folder.put("mine.so", "");
  EXPECT_THAT(completions("run --backend plugin:m", {"run", "--backend", "plugin", ":", "m"},
                          folder.path("")),
              ElementsAre("mine.so"));
}

TEST(Completion, OffersFilesAndFolders) {
  const TemporaryFolder folder;
  folder.put("case one.json", "");
  folder.put("cases/two.json", "");
  EXPECT_THAT(completions({"oracle", "case"}, folder.path("")),
              UnorderedElementsAre("case one.json", "cases"));
  EXPECT_THAT(completions({"run", "--corpus", "case"}, folder.path("")), ElementsAre("cases"));
}

TEST(Completion, RefusesAnotherShell) {
  EXPECT_TRUE(is_failure(run_program({"completion", "tcsh"}), 2));
}

}  // namespace
}  // namespace rastercheck::cli::completion_test
