#include "cases/files.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace rastercheck::cases::files_test {
namespace {

TEST(ReadText, GivesTheBytesAsTheyAre) {
  const TemporaryFolder folder;
  const std::string bytes("a\r\n\0\xff", 5);
  EXPECT_EQ(read_text(folder.put("bytes", bytes)).value_or("?"), bytes);
}

TEST(ReadText, AnEmptyFileIsAnEmptyText) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_text(folder.put("empty", "")).value_or("?"), "");
}

// Kills: filling the memory with a file that has no end.
TEST(ReadText, RefusesWhatHasNoEnd) {
  const Result<std::string> text = read_text("/dev/zero", 100000);
  ASSERT_FALSE(text.has_value());
  EXPECT_EQ(to_string(text.error()), "/dev/zero: has more than 100000 bytes");
  const TemporaryFolder folder;
  const std::string file = folder.put("ten", "0123456789");
  EXPECT_TRUE(read_text(file, 10).has_value());
  EXPECT_FALSE(read_text(file, 9).has_value());
}

TEST(WriteFile, PutsTheBytesInPlaceOfWhatWasThere) {
  const TemporaryFolder folder;
  const std::string bytes("a\r\n\0\xff", 5);
  const std::string file = folder.put("file", "longer than what comes");
  ASSERT_TRUE(write_file(file, bytes).has_value());
  EXPECT_EQ(folder.content("file"), bytes);
  EXPECT_EQ(folder.files(), std::vector<std::string>{"file"});
}

// Kills: writing over the file itself; leaving an unfinished file behind.
TEST(WriteFile, ThatFailsLeavesWhatWasThere) {
  const TemporaryFolder folder;
  folder.put("taken/file", "kept");
  const Result<void> written = write_file(folder.path("taken"), "new");
  ASSERT_FALSE(written.has_value());
  EXPECT_EQ(written.error().file, folder.path("taken"));
  EXPECT_TRUE(written.error().reason.starts_with("cannot be written: "));
  EXPECT_EQ(folder.files(), std::vector<std::string>{"taken/file"});
  EXPECT_FALSE(write_file(folder.path("no such folder/file"), "new").has_value());
}

}  // namespace
}  // namespace rastercheck::cases::files_test
