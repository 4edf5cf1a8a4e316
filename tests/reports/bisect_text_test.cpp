// Tests the texts of a bisection. tests/cli/bisect_test.py searches whole repositories.

#include "reports/bisect_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::bisect_text_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

records::CommitTitle title(char letter) {
  return {std::string(40, letter), "2026-01-02", "Some Body", std::string("Subject ") + letter};
}

records::Comparison worse(std::size_t entries) {
  records::Comparison comparison;
  comparison.backend = "plugin:./mine.so";
  for (std::size_t i = 0; i < entries; ++i) {
    records::EntryChange entry;
    entry.key.law = "law " + std::to_string(i);
    entry.change = records::Change::worse;
    records::FigureChange figure;
    figure.figure = records::Figure::violations;
    figure.change = records::Change::worse;
    figure.after.count = 3;
    entry.figures = {figure};
    comparison.entries.push_back(entry);
  }
  records::EntryChange better;
  better.key.law = "a better law";
  better.change = records::Change::better;
  comparison.entries.push_back(better);
  records::CaseGrowth growth;
  growth.law = "law 0";
  growth.index = 12;
  growth.kind = records::AttributeKind::smooth;
  growth.stratum = records::Stratum::sliver;
  growth.before = sample_worst(0.25);
  growth.after = sample_worst(-4);
  comparison.growths = {growth};
  return comparison;
}

records::BisectOutcome outcome(std::size_t here, std::size_t later) {
  records::BisectOutcome found;
  found.good = title('a');
  found.bad = title('b');
  found.of_bad = {worse(later)};
  found.first = {title('c')};
  found.of_first = {worse(here)};
  found.commits = 8;
  found.tried = 5;
  found.skipped = 1;
  return found;
}

TEST(BisectText, NamesTheCommitAndTheCase) {
  const std::string text = bisect_text(outcome(2, 2));
  EXPECT_THAT(text, StartsWith("First worse: cccccccccc 2026-01-02 Subject c (Some Body)\n"
                               "  plugin:./mine.so: 2 entries are worse\n"));
  EXPECT_THAT(text, AllOf(HasSubstr("  most in: law 0, random case 12\n"),
                          HasSubstr("error 0.25 → 4 ULP\n"), HasSubstr("exact 1/3"),
                          HasSubstr("Judged 5 of 9 commits, skipped 1.\n"
                                    "See: git show cccccccccc\n"),
                          Not(HasSubstr("better")), Not(HasSubstr("in the end"))));
}

// Kills: reporting only the first worse commit, although more became worse later.
TEST(BisectText, SaysWhereMoreIsWorseInTheEnd) {
  const std::string text = bisect_text(outcome(7, 9));
  EXPECT_THAT(text, AllOf(HasSubstr("    … and 2 more\n"),
                          HasSubstr("Of the 9 entries that are worse in the end, these are 7.\n")));
}

TEST(BisectText, NamesAllThatItMayBe) {
  records::BisectOutcome found = outcome(1, 1);
  found.first.push_back(title('d'));
  const std::string text = bisect_text(found);
  EXPECT_THAT(text, AllOf(StartsWith("First worse is one of these"), HasSubstr("\n  cccccccccc "),
                          HasSubstr("\n  dddddddddd ")));
}

TEST(BisectText, SaysThatNothingIsWorse) {
  records::BisectOutcome found = outcome(0, 0);
  found.first.clear();
  EXPECT_EQ(bisect_text(found),
            "Not worse: bbbbbbbbbb 2026-01-02 Subject b (Some Body)\n"
            "     than: aaaaaaaaaa 2026-01-02 Subject a (Some Body)\n");
}

TEST(BisectJson, HasAllOfIt) {
  const nlohmann::json json = nlohmann::json::parse(bisect_json(outcome(7, 9)));
  EXPECT_EQ(json.at("first").at(0).at("commit"), std::string(40, 'c'));
  EXPECT_EQ(json.at("worse").at(0).at("worse").size(), 7U);
  EXPECT_EQ(json.at("worse_in_the_end").at(0).at("worse").size(), 9U);
  EXPECT_EQ(json.at("worse").at(0).at("case").at("index"), 12);
  EXPECT_EQ(json.at("worse").at(0).at("case").at("after").at("error"),
            nlohmann::json::parse("[-4.0, -4.0]"));
  EXPECT_EQ(json.at("judged"), 5);
}

}  // namespace
}  // namespace rastercheck::reports::bisect_text_test
