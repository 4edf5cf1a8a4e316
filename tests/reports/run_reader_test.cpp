#include "reports/run_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cases/case_writer.h"
#include "cases/files.h"
#include "reports/format.h"
#include "tests/records/random_inspection.h"
#include "tests/records/random_record.h"
#include "tests/records/sample_look.h"
#include "tests/records/sample_shard.h"
#include "tests/reports/sample_run.h"

namespace rastercheck::reports::run_reader_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string written(const records::Run& run) { return find_format("json").value().write(run); }

TEST(ParseRun, ReadsWhatWasWritten) {
  const std::string text = written(sample_run());
  const Result<records::Run> again = parse_run(text, "run.json");
  ASSERT_TRUE(again.has_value()) << to_string(again.error());
  EXPECT_EQ(*again, sample_run());
  EXPECT_EQ(written(*again), text);
  // Zeros of different sign compare equal, but differ in case files.
  EXPECT_EQ(cases::to_json(again->counterexamples[0].source),
            cases::to_json(sample_run().counterexamples[0].source));
}

TEST(ParseRun, ReadsWhatIsKnownOfDrivers) {
  records::Run run = sample_run();
  add_known_defects(run);
  EXPECT_EQ(parse_run(written(run), "run.json").value(), run);
}

TEST(ParseRun, ReadsAShard) {
  records::Run run = sample_run();
  run.shard = records::sample_shard();
  run.plan.shard = {2, 7};
  EXPECT_EQ(parse_run(written(run), "run.json").value(), run);
}

TEST(ParseRun, ReadsWhatWasDrawn) {
  records::Run run = sample_run();
  run.specimens = {records::sample_specimen(), records::sample_specimen()};
  const std::string text = written(run);
  EXPECT_THAT(text, HasSubstr("\"rows\":[\"3e800000:3efffffc -\"]"));
  EXPECT_EQ(parse_run(text, "run.json").value(), run);
}

TEST(ParseRun, ReadsAnEmptyRun) {
  EXPECT_EQ(parse_run(written({}), "run.json").value(), records::Run());
}

// Kills: leaving out a member of the run.
RC_GTEST_PROP(ParseRun, GivesBackAnyRun, ()) {
  records::Run run;
  run.plan.seed = *rc::gen::arbitrary<std::uint64_t>();
  run.plan.cases_per_law = *rc::gen::arbitrary<std::uint64_t>();
  run.records = records::records_of(records::random_observations());
  run.plan.scene = records::one_of<std::string>({"", "bunny", "\"\n\\"});
  run.plan.laws = {run.plan.scene, "b"};
  if (*rc::gen::arbitrary<bool>()) run.sentences = {{run.plan.scene, "a \"b\""}, {"b", ""}};
  run.plan.backends = {"cpu", run.plan.scene};
  run.environment[run.plan.scene] = "x";
  for (auto left = *rc::gen::inRange(0, 3); left > 0; --left) {
    records::Counterexample counterexample =
        sample_counterexample(*rc::gen::arbitrary<std::uint64_t>());
    counterexample.violation_count = *rc::gen::arbitrary<std::uint64_t>();
    counterexample.origin = *rc::gen::element(records::Origin::corpus, records::Origin::random);
    if (*rc::gen::arbitrary<bool>()) {
      counterexample.shrinking = {*rc::gen::arbitrary<std::uint64_t>(),
                                  *rc::gen::arbitrary<bool>()};
      counterexample.close_up.clear();
    } else {
      counterexample.shrinking.reset();
    }
    records::Violation& violation = counterexample.violations[0];
    violation.fragment_class = records::random_class();
    violation.error = records::random_error();
    if (*rc::gen::arbitrary<bool>()) violation.attribute.reset();
    if (*rc::gen::arbitrary<bool>()) violation.bound.reset();
    if (*rc::gen::arbitrary<bool>()) counterexample.explanation.reset();
    run.counterexamples.push_back(counterexample);
    run.causes.push_back({run.plan.scene, "a", {}, {}, {run.causes.size()}});
    run.inspections.push_back(records::random_inspection());
    records::Picture picture;
    picture.name = run.plan.scene;
    picture.width = *rc::gen::inRange(0, 20000);
    picture.height = *rc::gen::inRange(0, 20000);
    picture.png = *rc::gen::arbitrary<std::string>();
    run.pictures.push_back(picture);
  }
  run.cases_left = *rc::gen::element<std::uint64_t>(0, 1, 1000);
  if (*rc::gen::arbitrary<bool>()) run.plan.contract.emplace().file = "a \"b\".json";
  if (*rc::gen::arbitrary<bool>()) {
    run.plan.shrinking.seconds = *rc::gen::element(0.25, 1e-9, 3600.0);
  }
  const std::string text = written(run);
  const Result<records::Run> again = parse_run(text, "run.json");
  RC_ASSERT(again.has_value());
  RC_ASSERT(*again == run);
  RC_ASSERT(written(*again) == text);
}

// Everything that depends on the machine is under one key. Kills: a date or a duration elsewhere.
TEST(RunJson, AllButTheEnvironmentIsOfTheRunAlone) {
  records::Run elsewhere = sample_run();
  elsewhere.environment = {{"machine", "another"}};
  json here = json::parse(written(sample_run()));
  json there = json::parse(written(elsewhere));
  EXPECT_NE(here, there);
  here.erase("environment");
  there.erase("environment");
  EXPECT_EQ(here, there);
}

/// A fault that must be refused: the value at a place in a good document is replaced.
struct Fault {
  std::string pointer;
  std::string value;  ///< JSON text; empty: the value is removed
  std::string place;
  std::string reason;  ///< part of the expected reason
};

/// Used in the test's name, which would otherwise contain addresses that differ in every run.
void PrintTo(const Fault& fault, std::ostream* out) {
  *out << (fault.value.empty() ? "without " + fault.pointer : fault.pointer + " = " + fault.value);
}

class BadRun : public ::testing::TestWithParam<Fault> {};

TEST_P(BadRun, IsRefusedWithItsPlace) {
  const Fault& fault = GetParam();
  json document = json::parse(written(sample_run()));
  const json::json_pointer pointer(fault.pointer);
  if (fault.value.empty()) {
    document[pointer.parent_pointer()].erase(pointer.back());
  } else {
    document[pointer] = json::parse(fault.value);
  }
  const Result<records::Run> run = parse_run(document.dump(), "run.json");
  ASSERT_FALSE(run.has_value());
  EXPECT_EQ(run.error().file, "run.json");
  EXPECT_EQ(run.error().place, fault.place);
  EXPECT_THAT(run.error().reason, HasSubstr(fault.reason));
}

const Fault kFaults[] = {
    {"", "[]", "/", "must be an object"},
    {"/format", R"("rastercheck-case")", "/format",
     "must be \"rastercheck-run\", not \"rastercheck-case\""},
    {"/format", "", "/", "missing key 'format'"},
    {"/version", "1", "/version", "version must be 3"},
    {"/more", "1", "/more", "unknown key 'more'"},
    {"/plan/seed", "-1", "/plan/seed", "must be an integer from 0"},
    {"/plan/seed", "1.0", "/plan/seed", "must be an integer from 0"},
    {"/plan/cases_per_property", "", "/plan", "missing key 'cases_per_property'"},
    {"/plan/backends", R"("cpu")", "/plan/backends", "must be an array"},
    {"/plan/backends/1", "7", "/plan/backends/1", "must be a string"},
    {"/plan/properties/0", "null", "/plan/properties/0", "must be a string"},
    {"/plan/scene", "null", "/plan/scene", "must be a string"},
    {"/records", "{}", "/records", "must be an array"},
    {"/records/0/property", "", "/records/0", "missing key 'property'"},
    {"/counterexamples/0/more", "1", "/counterexamples/0/more", "unknown key"},
    {"/counterexamples/1/case/version", "2", "/counterexamples/1/case/version", "must be 1"},
    {"/counterexamples/1/case/vertices/2/position/0", "0.1",
     "/counterexamples/1/case/vertices/2/position/0", "not exactly a float32"},
    {"/counterexamples/0/violation_count", "-3", "/counterexamples/0/violation_count",
     "must be an integer"},
    {"/counterexamples/0/violations/0/class", R"("late")", "/counterexamples/0/violations/0/class",
     "must be correct, beyond bound"},
    {"/counterexamples/0/violations/0/error", "[1, 0]", "/counterexamples/0/violations/0/error",
     "lower end"},
    {"/counterexamples/0/violations/1/note", "", "/counterexamples/0/violations/1",
     "missing key 'note'"},
    {"/pictures/0/png", R"("Zg=")", "/pictures/0/png", "must be base64"},
    {"/pictures/0/width", "2147483648", "/pictures/0/width", "from 0 to 2147483647"},
    {"/pictures/1/caption", "", "/pictures/1", "missing key 'caption'"},
    {"/counterexamples/0/origin", R"("yesterday")", "/counterexamples/0/origin", "must be "},
    {"/causes/0/counterexamples/0", "2", "/causes", "each must name counterexamples of the run"},
    {"/counterexamples/0/shrinking/tries", "-1", "/counterexamples/0/shrinking/tries", "must be "},
    {"/counterexamples/0/shrinking/is_least", "1", "/counterexamples/0/shrinking/is_least",
     "must be "},
    {"/counterexamples/0/close_up/0", "1", "/counterexamples/0/close_up/0", "must be a string"},
    {"/environment/version", "1", "/environment/version", "must be a string"},
    {"/environment", "[]", "/environment", "must be an object"},
};

INSTANTIATE_TEST_SUITE_P(ParseRun, BadRun, ::testing::ValuesIn(kFaults));

TEST(ReadRun, NamesAFileThatIsNotThere) {
  const Result<records::Run> run = read_run("no/such/run.json");
  ASSERT_FALSE(run.has_value());
  EXPECT_EQ(to_string(run.error()), "no/such/run.json: cannot be read: No such file or directory");
}

TEST(ReadRun, LeavesOutInspectionsIfAsked) {
  const records::Run whole = sample_run();
  const std::string file = testing::TempDir() + "/run_without_inspections.json";
  ASSERT_TRUE(cases::write_file(file, written(whole)));
  EXPECT_EQ(read_run(file).value(), whole);
  records::Run rest = whole;
  ASSERT_FALSE(rest.inspections.empty());
  rest.inspections.clear();
  EXPECT_EQ(read_run_without_inspections(file).value(), rest);
}

}  // namespace
}  // namespace rastercheck::reports::run_reader_test
