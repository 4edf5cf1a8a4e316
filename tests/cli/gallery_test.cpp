#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::gallery_test {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

TEST(Gallery, WritesAPageAndItsPictures) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_program({"gallery", "--size", "64", "--output", folder.path("deep/out"), "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  const std::vector<std::string> files = folder.files("deep/out");
  EXPECT_THAT(files, Contains("index.html"));
  const json pictures = json::parse(outcome.out).at("pictures");
  EXPECT_GE(pictures.size(), 14U);
  for (const json& picture : pictures) {
    if (picture.contains("missing")) continue;
    const std::string name = picture.at("picture");
    EXPECT_THAT(files, Contains(name + ".png"));
    EXPECT_THAT(files, Contains(name + "-errors.png"));
    EXPECT_GT(picture.at("samples"), 0) << name;
    EXPECT_EQ(picture.at("violations"), 0) << name;
  }
  const std::string page = folder.content("deep/out/index.html");
  EXPECT_THAT(page, HasSubstr("figures 2 (left) and 3 (right)"));
  for (const char* from_elsewhere : {"http:", "https:", "<script", "<link"}) {
    EXPECT_THAT(page, Not(HasSubstr(from_elsewhere)));
  }
}

TEST(Gallery, PrintsATableAndWhereThePageIs) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program({"gallery", "--size", "64", "--output", folder.path("out")});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("picture  "));
  EXPECT_THAT(outcome.out, HasSubstr("000-6-1-facing"));
  EXPECT_THAT(outcome.out, HasSubstr("Gallery: " + folder.path("out/index.html") + "\n"));
}

TEST(Gallery, RefusesAFolderThatCannotBeMade) {
  const TemporaryFolder folder;
  folder.put("file", "");
  const Outcome outcome = run_program({"gallery", "--output", folder.path("file/out")});
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr(folder.path("file/out") + ": cannot be created: "));
}

// Kills: pictures that are lost without a message.
TEST(Gallery, SaysWhichFileCannotBeWritten) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("out/index.html"));
  const Outcome outcome = run_program({"gallery", "--size", "64", "--output", folder.path("out")});
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("index.html"));
}

TEST(Gallery, RefusesSizesThatAreNone) {
  for (const char* size : {"0", "63", "4000", "x"}) {
    EXPECT_TRUE(is_failure(run_program({"gallery", "--size", size}), 2)) << size;
  }
}

}  // namespace
}  // namespace rastercheck::cli::gallery_test
