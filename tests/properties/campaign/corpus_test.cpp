#include "properties/campaign/corpus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/case_writer.h"
#include "tests/properties/damaged_backend.h"
#include "tests/temporary_folder.h"

namespace rastercheck::properties::corpus_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kCoverage = "coverage-obeys-the-contract";
constexpr const char* kValues = "values-stay-within-the-bound";

cases::Case named(const std::string& name) {
  cases::Case c = square();
  c.name = name;
  return c;
}

// Kills: cases ordered by when their files were made, or by the cases' names.
TEST(ReadCorpus, GoesByTheNamesOfFiles) {
  const TemporaryFolder folder;
  for (const char* name : {"5", "3", "8", "1", "9", "0", "7", "2", "6", "4"}) {
    folder.put(std::string(name) + ".json", cases::to_json(named(name[0] == '3' ? "z" : "")));
  }
  const auto corpus = read_corpus(folder.path());
  ASSERT_TRUE(corpus) << to_string(corpus.error());
  std::string names;
  for (const cases::Case& c : *corpus) names += c.name;
  EXPECT_EQ(names, "012z456789");
}

TEST(ReadCorpus, NamesCasesThatHaveNoName) {
  const TemporaryFolder folder;
  folder.put("b.json", cases::to_json(named("its own name")));
  folder.put("a.json", cases::to_json(named("")));
  folder.put("c\xff.json", cases::to_json(named("")));
  folder.put("notes.txt", "no case");
  const auto corpus = read_corpus(folder.path());
  ASSERT_TRUE(corpus) << to_string(corpus.error());
  std::vector<std::string> names;
  for (const cases::Case& c : *corpus) names.push_back(c.name);
  // The last name is as read back from a file, so that its records are the same in every process.
  EXPECT_THAT(names, ElementsAre("a", "its own name", "c\ufffd"));
}

TEST(ReadCorpus, MayBeEmpty) {
  const TemporaryFolder folder;
  EXPECT_THAT(read_corpus(folder.path()).value(), IsEmpty());
}

TEST(ReadCorpus, NamesWhatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_EQ(to_string(read_corpus(folder.path("none")).error()),
            folder.path("none") + ": cannot be read: No such file or directory");
  const std::string file = folder.put("x/broken.json", "{");
  EXPECT_THAT(to_string(read_corpus(folder.path("x")).error()), testing::StartsWith(file + ": 1:"));
  EXPECT_EQ(to_string(read_corpus(file).error()), file + ": cannot be read: Not a directory");
}

cases::Case found_by(const std::string& law, const std::string& backend) {
  cases::Case c = square();
  c.found = {law, backend, "missing", 3, 4};
  return c;
}

// Kills: a broken file that ends the run or is not reported; cases that nobody asked for.
TEST(ReadSaved, TakesWhatThisRunCanCheckAgain) {
  const TemporaryFolder folder;
  const std::vector<std::string> laws{kCoverage, kValues};
  const std::vector<std::string> backends{"cpu", "damaged"};
  folder.put("1.json", cases::to_json(found_by(kCoverage, "damaged")));
  folder.put("2.json", cases::to_json(found_by(kValues, "cpu")));
  folder.put("3.json", cases::to_json(found_by(kValues, "gl")));
  folder.put("4.json", cases::to_json(found_by("constants-stay-constant", "cpu")));
  folder.put("5.json", cases::to_json(square()));
  const std::string broken = folder.put("6.json", "{");
  folder.put("notes.txt", "{");
  const SavedCases saved = read_saved(folder.path(), laws, backends);
  EXPECT_THAT(saved.cases, ElementsAre(found_by(kCoverage, "damaged"), found_by(kValues, "cpu")));
  ASSERT_THAT(saved.unreadable, SizeIs(1));
  EXPECT_THAT(to_string(saved.unreadable[0]), testing::StartsWith(broken + ": 1:"));
  EXPECT_THAT(read_saved(folder.path("none"), laws, backends).cases, IsEmpty());
  EXPECT_THAT(read_saved(folder.path("none"), laws, backends).unreadable, IsEmpty());
}

}  // namespace
}  // namespace rastercheck::properties::corpus_test
