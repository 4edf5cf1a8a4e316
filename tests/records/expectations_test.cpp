#include "records/expectations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "records/summary.h"

namespace rastercheck::records::expectations_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Expectations, AreToldByTheNameOfTheFile) {
  EXPECT_EQ(expected_by("ci/llvmpipe-fails.txt"), Expected::fail);
  EXPECT_EQ(expected_by("llvmpipe-flakes.txt"), Expected::flake);
  EXPECT_EQ(expected_by("llvmpipe-skips.txt"), Expected::skip);
  EXPECT_EQ(expected_by("llvmpipe-fails.json"), std::nullopt);
  EXPECT_EQ(expected_by("fails.txt"), std::nullopt);
}

TEST(Expectations, AreOneNameALine) {
  const KnownList list =
      parse_expectations("# Of Mesa 22.\n\n  a-law  # always\r\ngl:softpipe/*edge*,Fail\nb-law",
                         Expected::fail, "f")
          .value();
  EXPECT_EQ(list.driver, std::nullopt);
  ASSERT_THAT(list.entries, SizeIs(3));
  EXPECT_EQ(list.entries[0].id, "a-law");
  EXPECT_THAT(list.entries[0].laws, ElementsAre("a-law"));
  EXPECT_THAT(list.entries[0].backends, IsEmpty());
  EXPECT_EQ(list.entries[0].expected, Expected::fail);
  EXPECT_EQ(list.entries[1].id, "gl:softpipe/*edge*");
  EXPECT_THAT(list.entries[1].laws, ElementsAre("*edge*"));
  EXPECT_THAT(list.entries[1].backends, ElementsAre("gl:softpipe"));
  EXPECT_EQ(list.entries[2].id, "b-law");
  EXPECT_TRUE(is_of_law(list.entries[1], "a-shared-edge-covers-each-sample-once"));
  EXPECT_FALSE(is_of_law(list.entries[0], "b-law"));
}

TEST(Expectations, AreRefusedWithANameTwice) {
  const Result<KnownList> list = parse_expectations("a\nb\n a,Crash\n", Expected::skip, "f.txt");
  ASSERT_FALSE(list);
  EXPECT_EQ(to_string(list.error()), "f.txt: line 3: repeats the name of another line");
}

/// A run of three laws on a backend. Some of them are violated, and some are known to be.
Run run_of(const std::string& backend, const std::vector<std::string>& violated,
           const std::vector<std::string>& known = {}) {
  Run run;
  run.plan.backends = {backend};
  run.plan.laws = {"a", "b", "c"};
  for (const std::string& law : run.plan.laws) {
    Record& record = run.records[{law, backend, AttributeKind::coverage, ""}];
    record.cases.checked = 9;
    record.cases.violations = static_cast<std::uint64_t>(std::ranges::count(violated, law));
    record.cases.known = static_cast<std::uint64_t>(std::ranges::count(known, law));
  }
  return run;
}

TEST(Expectations, OfOneRunAreWhatItViolated) {
  const ExpectationTexts texts = expectations_of({run_of("cpu", {"c", "a"})});
  EXPECT_EQ(texts.fails, "a\nc\n");
  EXPECT_EQ(texts.flakes, "");
  EXPECT_EQ(texts.skips, "");
}

// Kills: dropping the expectations that the run itself was given (known failures, skips) when lists
// are made from the run.
TEST(Expectations, KeepWhatWasExpected) {
  records::Run run = run_of("cpu", {}, {"b"});
  KnownList list;
  list.entries = {{.id = "a", .reason = "R", .laws = {"a"}, .expected = Expected::skip}};
  run.known = {{"cpu", "x-skips.txt", "", list, {}}};
  run.records.erase({"a", "cpu", AttributeKind::coverage, ""});
  const ExpectationTexts texts = expectations_of({run});
  EXPECT_EQ(texts.fails, "b\n");
  EXPECT_EQ(texts.skips, "a\n");
}

TEST(Expectations, OfSeveralRunsTellFlakesByWhatHeldAtTimes) {
  const ExpectationTexts texts = expectations_of({run_of("cpu", {"a", "b"}), run_of("cpu", {"b"})});
  EXPECT_EQ(texts.fails, "b\n");
  EXPECT_EQ(texts.flakes, "a\n");
}

TEST(Expectations, NameTheBackendWhereThereAreSeveral) {
  const ExpectationTexts texts =
      expectations_of({run_of("cpu", {"a"}), run_of("gl:softpipe", {"b"})});
  EXPECT_EQ(texts.fails, "cpu/a\ngl:softpipe/b\n");
  const KnownList read = parse_expectations(texts.fails, Expected::fail, "f").value();
  EXPECT_THAT(read.entries.at(1).backends, ElementsAre("gl:softpipe"));
}

// Kills: a list that its own reader misreads.
TEST(Expectations, AreReadBackWhateverABackendIsCalled) {
  const std::string odd = "plugin:/a b/x[1],y=2/lib#.so";
  const ExpectationTexts texts = expectations_of({run_of(odd, {"a"}), run_of("cpu", {"b"})});
  const KnownList read = parse_expectations(texts.fails, Expected::fail, "f").value();
  ASSERT_THAT(read.entries, SizeIs(2));
  EXPECT_THAT(read.entries[1].laws, ElementsAre("a"));
  EXPECT_TRUE(is_of_backend(read.entries[1], {odd}));
  EXPECT_FALSE(is_of_backend(read.entries[1], {"plugin:/a b/x1,y=2/lib#.so"}));
}

}  // namespace
}  // namespace rastercheck::records::expectations_test
