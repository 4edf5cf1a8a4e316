#include "gate/internal/bisect_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "cases/contract_json.h"
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
  EXPECT_EQ(to_string(full.error()), path + ": is not empty; give a new or empty folder");
  EXPECT_FALSE(BisectFolder::make(temporary.path("a/b/file")));
  EXPECT_TRUE(fs::exists(path + "/file"));
}

// Kills: leaving files behind after a refusal, which make the next bisection refuse, too.
TEST(BisectFolder, IsAsItWasOnceItIsDiscarded) {
  const TemporaryFolder temporary;
  fs::create_directories(temporary.path("there/empty"));
  for (const char* name : {"there/new/deep/", "there/./empty"}) {
    const auto folder = BisectFolder::make(temporary.path(name));
    ASSERT_TRUE(folder);
    temporary.put("tree/file", "");
    records::Plan plan;
    plan.corpus = temporary.path("tree");
    EXPECT_TRUE(folder->with_copies(plan, temporary.path("tree")));
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

// Kills: drawing cases of another commit; copying files that no commit changes.
TEST(BisectFolder, CopiesWhatThePlanNamesOfTheWorkTree) {
  const TemporaryFolder temporary;
  temporary.put("tree/corpus/deep/case.json", "{}");
  temporary.put("treeless/known/case.json", "{}");
  const auto folder = BisectFolder::make(temporary.path("output"));
  ASSERT_TRUE(folder);
  records::Plan plan;
  plan.corpus = temporary.path("tree/corpus");
  temporary.put("tree/lists/known.json", "{}");
  temporary.put("tree/lists/known/mine-1.json", "{}");
  plan.known = {temporary.path("treeless/known"), temporary.path("tree/lists/known.json")};
  plan.contract.emplace().file = temporary.path("tree/contract.json");
  plan.contract->terms.keeps_constants = false;
  const auto copied = folder->with_copies(plan, temporary.path("tree"));
  ASSERT_TRUE(copied);
  fs::remove_all(temporary.path("tree"));
  EXPECT_TRUE(fs::exists(fs::path(copied->corpus) / "deep/case.json"));
  ASSERT_EQ(copied->known.size(), 2U);
  EXPECT_EQ(copied->known[0], plan.known[0]);
  const fs::path list = copied->known[1];
  EXPECT_EQ(list.filename(), "known.json");
  EXPECT_TRUE(fs::exists(list));
  EXPECT_TRUE(fs::exists(list.parent_path() / "known/mine-1.json"));
  EXPECT_EQ(cases::read_contract(copied->contract->file), plan.contract->terms);
}

TEST(BisectFolder, LeavesAPlanWithoutFilesAsItIs) {
  const TemporaryFolder temporary;
  const auto folder = BisectFolder::make(temporary.path("output"));
  EXPECT_EQ(folder->with_copies({}, temporary.path()).value(), records::Plan());
  EXPECT_TRUE(fs::is_empty(folder->path()));
}

}  // namespace
}  // namespace rastercheck::gate::bisect_folder_test
