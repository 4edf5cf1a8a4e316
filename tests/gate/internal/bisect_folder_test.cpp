#include "gate/internal/bisect_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "tests/temporary_folder.h"

namespace rastercheck::gate::bisect_folder_test {
namespace {

namespace fs = std::filesystem;

TEST(BisectFolder, WithoutANameIsGoneInTheEnd) {
  std::string path;
  {
    Result<BisectFolder> made = BisectFolder::make("");
    ASSERT_TRUE(made);
    const BisectFolder folder = *std::move(made);
    path = folder.path();
    EXPECT_TRUE(fs::path(path).is_absolute());
    EXPECT_TRUE(fs::is_empty(path));
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(BisectFolder, WithANameStays) {
  const TemporaryFolder temporary;
  const std::string path = temporary.path("a/b");
  EXPECT_TRUE(BisectFolder::make(path));
  EXPECT_TRUE(BisectFolder::make(path));  // still empty
  temporary.put("a/b/file", "");
  const auto full = BisectFolder::make(path);
  ASSERT_FALSE(full);
  EXPECT_EQ(to_string(full.error()), path + ": is not empty; it has to be new");
  EXPECT_FALSE(BisectFolder::make(temporary.path("a/b/file")));
  EXPECT_TRUE(fs::exists(path + "/file"));
}

// Kills: what a refusal leaves behind, so that the next bisection is refused for it.
TEST(BisectFolder, IsAsItWasOnceItIsDiscarded) {
  const TemporaryFolder temporary;
  fs::create_directories(temporary.path("there/empty"));
  for (const char* name : {"there/new/deep/", "there/./empty"}) {
    const auto folder = BisectFolder::make(temporary.path(name));
    ASSERT_TRUE(folder);
    temporary.put("tree/file", "");
    EXPECT_TRUE(folder->with_copies({"--contract", temporary.path("tree/file")}, {"--contract"},
                                    temporary.path("tree")));
    EXPECT_FALSE(fs::is_empty(folder->path()));
    folder->discard();
  }
  EXPECT_FALSE(fs::exists(temporary.path("there/new")));
  EXPECT_TRUE(fs::is_empty(temporary.path("there/empty")));
  {
    const auto folder = BisectFolder::make(temporary.path("new/deep"));
    temporary.put("new/of-others", "");
    folder->discard();
  }
  EXPECT_FALSE(fs::exists(temporary.path("new/deep")));
  EXPECT_TRUE(fs::exists(temporary.path("new/of-others")));
}

// Kills: cases of another commit; copies of what no commit changes.
TEST(BisectFolder, CopiesWhatOptionsNameOfTheWorkTree) {
  const TemporaryFolder temporary;
  const std::string inside = temporary.path("tree/corpus");
  temporary.put("tree/corpus/deep/case.json", "{}");
  temporary.put("tree/contract.json", "a contract");
  temporary.put("treeless/corpus/case.json", "{}");
  const auto folder = BisectFolder::make(temporary.path("output"));
  ASSERT_TRUE(folder);
  const std::vector<std::string> words{"--corpus",   temporary.path("treeless/corpus"),
                                       "--corpus",   inside,
                                       "--contract", temporary.path("tree/contract.json"),
                                       "--backend",  temporary.path("tree/contract.json")};
  const auto copied =
      folder->with_copies(words, {"--corpus", "--contract"}, temporary.path("tree"));
  ASSERT_TRUE(copied);
  fs::remove_all(temporary.path("tree"));
  EXPECT_EQ(copied->at(1), words.at(1));
  EXPECT_TRUE(fs::exists(fs::path(copied->at(3)) / "deep/case.json"));
  EXPECT_EQ(temporary.content(fs::relative(copied->at(5), temporary.path()).string()),
            "a contract");
  EXPECT_EQ(copied->at(7), words.at(7));
}

}  // namespace
}  // namespace rastercheck::gate::bisect_folder_test
