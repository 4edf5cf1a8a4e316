#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::plugin_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string source(const std::string& name) {
  std::ifstream stream(RASTERCHECK_SOURCE_DIR "/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Plugin : public testing::Test {
 protected:
  TemporaryFolder folder_;
};

// tests/plugins checks that the projects build and that their laws hold. Kills: a project in the
// wrong language; a project that differs from the tested example.
TEST_F(Plugin, NewWritesTheExample) {
  const std::string c = folder_.path("in/c");
  const Outcome in_c = run_program({"plugin", "new", c});
  EXPECT_EQ(in_c.code, 0) << in_c;
  EXPECT_EQ(in_c.out, c + "/CMakeLists.txt\n" + c + "/README.md\n" + c + "/plugin.c\n" + c +
                          "/rastercheck/barycentrics.h\n" + c + "/rastercheck/plugin.h\n");
  EXPECT_THAT(folder_.files("in/c"),
              ElementsAre("CMakeLists.txt", "README.md", "plugin.c", "rastercheck/barycentrics.h",
                          "rastercheck/plugin.h"));
  EXPECT_EQ(folder_.content("in/c/plugin.c"), source("docs/examples/plugin/little.c"));
  EXPECT_EQ(folder_.content("in/c/rastercheck/plugin.h"), source("backends/plugin/plugin.h"));
  EXPECT_THAT(folder_.content("in/c/CMakeLists.txt"), HasSubstr("LANGUAGES C)"));

  const Outcome in_cxx =
      run_program({"plugin", "new", folder_.path("cxx"), "--language", "c++", "--quiet"});
  EXPECT_EQ(in_cxx.code, 0) << in_cxx;
  EXPECT_EQ(in_cxx.out, "");
  EXPECT_EQ(folder_.content("cxx/plugin.cpp"), source("docs/examples/plugin/little.cpp"));
  EXPECT_THAT(folder_.content("cxx/CMakeLists.txt"), HasSubstr("LANGUAGES CXX)"));
}

TEST_F(Plugin, NewTakesAnEmptyGitRepository) {
  folder_.put("mine/.git/HEAD", "ref: refs/heads/main\n");
  const Outcome made = run_program({"plugin", "new", folder_.path("mine")});
  EXPECT_EQ(made.code, 0) << made;
  EXPECT_EQ(folder_.content("mine/plugin.c"), source("docs/examples/plugin/little.c"));
}

// Kills: a project that overwrites somebody's files.
TEST_F(Plugin, NewLosesNothing) {
  folder_.put("mine/notes.txt", "mine");
  const Outcome there = run_program({"plugin", "new", folder_.path("mine")});
  EXPECT_TRUE(is_failure(there, 2)) << there;
  EXPECT_THAT(there.err, HasSubstr("mine: already exists and is not empty"));
  EXPECT_THAT(folder_.files("mine"), ElementsAre("notes.txt"));

  const Outcome file = run_program({"plugin", "new", folder_.path("mine/notes.txt")});
  EXPECT_TRUE(is_failure(file, 2)) << file;
  EXPECT_EQ(folder_.content("mine/notes.txt"), "mine");
}

// Kills: a program's project that differs from the tested example.
TEST_F(Plugin, NewWritesTheExamplesOfPrograms) {
  for (const auto& [language, suffix] :
       {std::pair("python", ".py"), {"javascript", ".mjs"}, {"rust", ".rs"}}) {
    const std::string name = language;
    const Outcome made = run_program({"plugin", "new", folder_.path(name), "--language", name});
    EXPECT_EQ(made.code, 0) << made;
    for (const std::string file : {"draws", "little"}) {
      EXPECT_EQ(folder_.content(name + "/" + file + suffix),
                source("docs/examples/exec/" + name + "/" + file + suffix));
    }
  }
}

TEST_F(Plugin, NewRefusesOtherLanguages) {
  const Outcome swift =
      run_program({"plugin", "new", folder_.path("swift"), "--language", "swift"});
  EXPECT_TRUE(is_failure(swift, 2)) << swift;
  const Outcome image =
      run_program({"plugin", "new", folder_.path("rust"), "--from", "image", "--language", "rust"});
  EXPECT_TRUE(is_failure(image, 2)) << image;
  EXPECT_THAT(folder_.files(), ElementsAre());
}

}  // namespace
}  // namespace rastercheck::cli::plugin_test
