#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/case_reader.h"
#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::corpus_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kFound = R"("found": {"property": "coverage-obeys-the-contract",
    "backend": "gl:softpipe", "verdict": "missing", "seed": 5, "index": 77}, )";

class Corpus : public testing::Test {
 protected:
  Corpus() { folder_.put("corpus/first.json", square_case()); }

  Outcome add(std::vector<std::string> arguments, const std::string& input = "") const {
    arguments.insert(arguments.begin(), {"corpus", "add", "--corpus", folder_.path("corpus")});
    return run_program(arguments, input);
  }

  TemporaryFolder folder_;
};

// Kills: a case that keeps its `found`, and so is checked by one law only.
TEST_F(Corpus, TakesACounterexample) {
  const std::string file = folder_.put("lost-corner.json", square_case(kFound));
  const Outcome outcome = add({file});
  EXPECT_EQ(outcome.code, 0) << outcome;
  const std::string added = folder_.path("corpus/lost-corner.json");
  EXPECT_EQ(outcome.out, added + "\n");
  const auto c = cases::read_case(added);
  ASSERT_TRUE(c) << to_string(c.error());
  cases::Case expected = cases::read_case(file).value();
  expected.found.reset();
  expected.name = "gl:softpipe violated \"coverage obeys the contract\": missing";
  EXPECT_EQ(*c, expected);
}

TEST_F(Corpus, TakesAWordAndASentence) {
  const Outcome outcome = add({"-", "--as", "corner-2", "--name", "The last corner is lost", "-q"},
                              square_case(kFound));
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(cases::read_case(folder_.path("corpus/corner-2.json")).value().name,
            "The last corner is lost");
}

// Kills: a case of the corpus replaced without a message; a file written anywhere else.
TEST_F(Corpus, LosesNothing) {
  const std::string file = folder_.put("first.json", square_case(kFound));
  const std::string before = folder_.content("corpus/first.json");
  const Outcome there = add({file});
  EXPECT_TRUE(is_failure(there, 2)) << there;
  EXPECT_THAT(there.err, HasSubstr("first.json: already exists"));
  EXPECT_EQ(folder_.content("corpus/first.json"), before);
  for (const char* word : {"../x", "a b", "A", "", "x.json"}) {
    const Outcome outcome = add({"-", "--as", word}, square_case());
    EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  }
  EXPECT_TRUE(is_failure(add({"-", "--as", "broken"}, "{"), 2));
  EXPECT_THAT(folder_.files("corpus"), ElementsAre("first.json"));
}

TEST_F(Corpus, MayBeAFolderOfOnesOwn) {
  const auto add_to = [this](const std::string& folder) {
    return run_program({"corpus", "add", "-", "--as", "x", "--corpus", folder_.path(folder)},
                       square_case());
  };
  EXPECT_EQ(add_to("mine/own").code, 0);
  EXPECT_THAT(folder_.files("mine/own"), ElementsAre("x.json"));
  const Outcome outcome = add_to("corpus/first.json");
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("first.json: cannot be created: Not a directory"));
}

}  // namespace
}  // namespace rastercheck::cli::corpus_test
