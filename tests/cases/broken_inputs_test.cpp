// The corpus of broken case files: tests/cases/broken, with one fault per file, and the table
// expected.tsv beside it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cases/case_reader.h"

namespace rastercheck::cases::broken_inputs_test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

const std::filesystem::path kBroken =
    std::filesystem::path(RASTERCHECK_SOURCE_DIR) / "tests" / "cases" / "broken";

/// A row of expected.tsv, whose header says what the columns mean.
struct Row {
  std::string file;
  std::string place;
  std::string reason;
  std::string by;
};

std::vector<std::string> split_at_tabs(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == '\t') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

std::vector<Row> expected_rows() {
  std::vector<Row> rows;
  std::ifstream table(kBroken / "expected.tsv", std::ios::binary);
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string> fields = split_at_tabs(line);
    EXPECT_THAT(fields, SizeIs(4)) << line;
    if (fields.size() == 4) rows.push_back({fields[0], fields[1], fields[2], fields[3]});
  }
  return rows;
}

std::set<std::string> broken_files() {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kBroken)) {
    if (entry.path().extension() == ".json") files.insert(entry.path().filename().string());
  }
  return files;
}

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

TEST(BrokenInputs, AreAtLeastForty) { EXPECT_GE(broken_files().size(), 40U); }

TEST(BrokenInputs, EveryFileHasOneRowAndEveryRowAFile) {
  std::multiset<std::string> listed;
  for (const Row& row : expected_rows()) listed.insert(row.file);
  const std::set<std::string> files = broken_files();
  EXPECT_THAT(listed, ::testing::ElementsAreArray(files.begin(), files.end()));
}

// Kills: a reader that accepts or repairs a faulty file, or refuses it for another reason.
TEST(BrokenInputs, EachIsRefusedWhereAndWhyTheTableSays) {
  for (const Row& row : expected_rows()) {
    SCOPED_TRACE(row.file);
    const std::string file = (kBroken / row.file).string();
    const Result<Case> read = read_case(file);
    EXPECT_FALSE(read.has_value());
    if (read) continue;
    EXPECT_EQ(read.error().file, file);
    if (row.place != "*") {
      EXPECT_EQ(read.error().place, row.place);
    }
    EXPECT_THAT(read.error().reason, HasSubstr(row.reason));
    EXPECT_FALSE(read.error().reason.empty());
  }
}

TEST(BrokenInputs, EachErrorNamesThePlace) {
  for (const Row& row : expected_rows()) {
    SCOPED_TRACE(row.file);
    const Result<Case> read = read_case((kBroken / row.file).string());
    EXPECT_FALSE(read.has_value());
    if (read) continue;
    EXPECT_THAT(read.error().place, ::testing::AnyOf(StartsWith("/"), HasSubstr(":")));
  }
}

// Kills: an error that quotes bytes of the file unescaped.
TEST(BrokenInputs, EachErrorIsOneLineWithoutControlCharactersThatBeginsWithTheFile) {
  for (const Row& row : expected_rows()) {
    SCOPED_TRACE(row.file);
    const std::string file = (kBroken / row.file).string();
    const Result<Case> read = read_case(file);
    EXPECT_FALSE(read.has_value());
    if (read) continue;
    const std::string line = to_string(read.error());
    EXPECT_THAT(line, StartsWith(file + ": "));
    EXPECT_TRUE(std::none_of(line.begin(), line.end(), is_control)) << line;
  }
}

}  // namespace
}  // namespace rastercheck::cases::broken_inputs_test
