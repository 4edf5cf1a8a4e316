#include "properties/campaign/internal/findings_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::findings_json_test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kCoverage = "coverage-obeys-the-contract";
constexpr const char* kOdd = "a \"b\"\\\n\t\x01 \u00fc \U0001f4d0";

/// The findings for the square on a damaged backend, under odd names.
Findings some_findings() {
  DamagedBackend backend([](const cases::Case&, cases::Fragments& d) {
    if (find(d, d.triangle.front(), 1, 1) < d.size()) drop(d, d.triangle.front(), 1, 1);
    if (d.triangle.back() == 1) add(d, 1, 2, 2);
  });
  cases::Case c = square();
  c.name = kOdd;
  c.attributes[0].name = kOdd;
  Findings findings;
  check_case(*find_law(kCoverage), kOdd, backend, std::numeric_limits<std::uint64_t>::max(),
             {c, kOdd, std::numeric_limits<std::uint64_t>::max()}, findings);
  return findings;
}

Error error_of(const std::string& line) {
  const Result<Findings> read = findings_from_line(line);
  return read ? Error{"", "", "was read"} : read.error();
}

TEST(FindingsLine, ComesBackAsItWas) {
  Findings findings = some_findings();
  ASSERT_FALSE(findings.counterexamples.empty());
  keep(findings,
       records::UnexpectedPass{kOdd, "driver-1", kCoverage, records::Staleness::wrong_list});
  const std::string line = findings_to_line(findings);
  EXPECT_THAT(line, Not(HasSubstr("\n")));
  EXPECT_EQ(findings_from_line(line).value(), findings);
}

TEST(FindingsLine, MayHoldNothing) {
  EXPECT_EQ(findings_from_line(findings_to_line(Findings())).value(), Findings());
}

TEST(FindingsLine, CarriesAFault) {
  Findings findings;
  findings.fault = kOdd;
  EXPECT_EQ(findings_from_line(findings_to_line(findings)).value(), findings);
  findings.fault = "";  // an empty text is a fault too
  EXPECT_EQ(findings_from_line(findings_to_line(findings)).value(), findings);
}

// Kills: an exception if a backend's name is not UTF-8.
TEST(FindingsLine, TakesAnyBytes) {
  Findings findings = some_findings();
  findings.records.begin()->second.labels["\xff"] = 1;
  findings.counterexamples[0].violations[0].note = "\xc3(";
  findings.fault = "\xe2\x82";
  const Findings read = findings_from_line(findings_to_line(findings)).value();
  EXPECT_EQ(read.counterexamples[0].violations[0].note, "\ufffd(");
  EXPECT_EQ(read.fault, "\ufffd");
}

TEST(FindingsLine, CarriesAnErrorWithItsPlace) {
  const Error error{"a/file\n", "/triangles/0", kOdd};
  const Error read = error_of(findings_to_line(tl::unexpected(error)));
  EXPECT_EQ(read.file, error.file);
  EXPECT_EQ(read.place, error.place);
  EXPECT_EQ(read.reason, error.reason);
}

TEST(FindingsLine, IsRefusedWhereItIsNone) {
  for (const char* line :
       {"", "rubbish", "{", "null", "[]", "{}", "17", R"({"records": []})",
        R"({"records": [], "counterexamples": {}})", R"({"records": 1, "counterexamples": []})",
        R"({"records": [{}], "counterexamples": []})", R"({"records": [], "counterexamples": [1]})",
        R"({"records": [], "counterexamples": [], "fault": 1})",
        R"({"records": [], "counterexamples": [], "more": 1})", R"({"error": "text"})",
        R"({"error": {"file": "f", "place": "p"}})",
        R"({"error": {"file": "", "place": "", "reason": ""}})",
        R"({"error": {"file": "", "place": "", "reason": ""}, "records": []})", "\xff"}) {
    EXPECT_EQ(error_of(line).file, "worker") << line;
    EXPECT_NE(error_of(line).reason, "") << line;
  }
}

// Kills: ordering counterexamples by a key that one of them lacks.
TEST(FindingsLine, IsRefusedWithACounterexampleFoundNowhere) {
  Findings findings = some_findings();
  findings.counterexamples[0].source.found.reset();
  EXPECT_EQ(to_string(error_of(findings_to_line(findings))),
            "worker: /counterexamples/0: its case has no 'found'");
}

TEST(TaskLine, ComesBackAsItWas) {
  Findings found = some_findings();
  found.counterexamples[0].shrinking = {3, true};
  found.counterexamples[0].close_up = {"[#]", ""};
  found.counterexamples[0].origin = records::Origin::scene;
  constexpr std::uint64_t kLast = std::numeric_limits<std::uint64_t>::max();
  for (const Task& task : {Task{"cpu", kCoverage, TaskKind::corpus, 0, 10},
                           Task{kOdd, kOdd, TaskKind::random, kLast - 1, kLast},
                           Task{"cpu", kCoverage, TaskKind::known, 3, 4},
                           Task{"cpu", kCoverage, TaskKind::saved, 0, 1, found.counterexamples[0]},
                           shrink_tasks(some_findings()).at(0)}) {
    const std::string line = task_to_line(task);
    EXPECT_THAT(line, Not(HasSubstr("\n")));
    EXPECT_EQ(task_from_line(line), task);
  }
}

TEST(TaskLine, IsNothingWhereItIsNone) {
  for (
      const char* line :
      {"", "rubbish", "[]", "{}",
       R"({"backend": "cpu", "property": "l", "kind": "corpus", "first": 0})",
       R"({"backend": "cpu", "property": "l", "kind": "corpus", "first": -1, "last": 1})",
       R"({"backend": "cpu", "property": "l", "kind": "all", "first": 0, "last": 1})",
       R"({"backend": "cpu", "property": "l", "kind": "shrink", "first": 0, "last": 1})",
       R"({"backend": "cpu", "property": "l", "kind": "corpus", "first": 0, "last": 1, "x": 1})"}) {
    EXPECT_EQ(task_from_line(line), std::nullopt) << line;
  }
}

}  // namespace
}  // namespace rastercheck::properties::findings_json_test
