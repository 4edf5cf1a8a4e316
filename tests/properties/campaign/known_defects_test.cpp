#include "properties/campaign/known_defects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backends/factory.h"
#include "properties/campaign/campaign.h"
#include "properties/campaign/check_case.h"
#include "properties/campaign/workers.h"
#include "tests/properties/campaign/known_list.h"

namespace rastercheck::properties::known_defects_test {
namespace {

using records::Staleness;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kCoverage = "coverage-obeys-the-contract";

std::unique_ptr<backends::Backend> driver(const std::string& name = "driver") {
  return backends::make_backend("damaged:" + name).value();
}

/// The list as read from a folder, for the backend's driver.
KnownDefects known_defects(backends::Backend& backend) {
  const TemporaryFolder folder;
  put_known(folder);
  return read_known_defects({folder.path()}, "damaged", backend).value().value();
}

std::string refusal(const TemporaryFolder& folder) {
  const auto read = read_known_defects({folder.path()}, "damaged", *driver());
  return read ? "was read" : read.error().place + ": " + read.error().reason;
}

TEST(KnownDefects, AreReadWithTheirCases) {
  const KnownDefects known = known_defects(*driver());
  EXPECT_THAT(known.defects, SizeIs(1));
  EXPECT_THAT(known.cases(), ElementsAre(scissored_square()));
  EXPECT_EQ(known.defects[0].staleness, Staleness::wrong_list);
  EXPECT_EQ(known_defects(*driver("newer")).defects[0].staleness, Staleness::other_version);
}

TEST(KnownDefects, AreNoneWhereThereIsNoListOrNoDriver) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_known_defects({folder.path()}, "damaged", *driver()).value().has_value(), false);
  put_known(folder);
  EXPECT_EQ(read_known_defects({}, "damaged", *driver()).value().has_value(), false);
  EXPECT_EQ(read_known_defects({folder.path()}, "cpu", *backends::make_backend("cpu").value())
                .value()
                .has_value(),
            false);
}

TEST(KnownDefects, AreRefusedWhereTheyDoNotFit) {
  const TemporaryFolder folder;
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  put_known(folder, replaced(kKnownList, "\"name\": \"damaged\"", "\"name\": \"other\""));
  EXPECT_EQ(refusal(folder), "/driver/name: is not the name of its folder");
  put_known(folder,
            replaced(kKnownList, "\"properties\": [\"cov", "\"properties\": [\"no law\", \"cov"));
  EXPECT_EQ(refusal(folder), "/entries/0/properties: no property is called 'no law'");
  cases::Case c = scissored_square();
  c.found->law = "values-stay-within-the-bound";
  put_known(folder, kKnownList, c);
  EXPECT_EQ(refusal(folder), "/found: violates a property that its entry does not name");
  c = scissored_square();
  c.found->verdict = "extra";
  put_known(folder, kKnownList, c);
  EXPECT_EQ(refusal(folder), "/found: has a verdict that its entry does not name");
  c.found.reset();
  put_known(folder, kKnownList, c);
  EXPECT_EQ(refusal(folder), "/found: has no 'found'");
}

// Kills: a driver's name that leads out of the folder of lists.
TEST(KnownDefects, AreNotReadFromElsewhere) {
  class Elsewhere : public DamagedBackend {
   public:
    backends::About about() const override {
      return {.driver = backends::Driver{"../damaged", "1"}};
    }
  };
  const TemporaryFolder folder;
  put_known(folder);
  folder.put("inner/file", "");
  Elsewhere elsewhere;
  EXPECT_EQ(read_known_defects({folder.path("inner")}, "damaged", elsewhere).value().has_value(),
            false);
}

/// The findings for the scissored square on a backend with this damage.
Findings checked(const Damage& damage, const KnownDefects& known) {
  DamagedBackend backend(damage);
  Findings findings;
  check_case(*find_law(kCoverage), "damaged", backend, 1, {scissored_square(), "here", 4}, findings,
             &known);
  return findings;
}

TEST(KnownDefects, AreCountedByThemselvesAndMakeNoCounterexample) {
  const Findings findings =
      checked([](const auto&, auto& d) { drop(d, 0, 1, 1); }, known_defects(*driver()));
  const records::Record& record = findings.records.begin()->second;
  EXPECT_EQ(record.cases, (records::CaseCounts{1, 0, 0, 1}));
  EXPECT_EQ(record.known, (std::map<std::string, std::uint64_t>{{"damaged-1", 1}}));
  EXPECT_THAT(findings.counterexamples, IsEmpty());
}

// Kills: a case that counts as known because one of its violations is known; a counterexample that
// shows a known violation.
TEST(KnownDefects, DoNotExplainWhatElseIsWrongWithACase) {
  const auto damage = [](const auto& c, auto& d) {
    if (c.triangles.size() < 2) return;
    drop(d, 0, 1, 1);
    add(d, 1, 2, 2);
  };
  const Findings findings = checked(damage, known_defects(*driver()));
  EXPECT_EQ(findings.records.begin()->second.cases, (records::CaseCounts{1, 0, 1, 0}));
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  const records::Counterexample& found = findings.counterexamples[0];
  EXPECT_EQ(found.source.found->verdict, "extra");
  EXPECT_EQ(found.violations[0].fragment_class, records::FragmentClass::extra);
}

// Kills: shrinking a new failure into a known one, which is smaller here because it has no scissor.
TEST(KnownDefects, NewFailuresAreNotShrunkIntoKnownOnes) {
  KnownDefects known = known_defects(*driver());
  known.defects[0].entry.when.facts = {{records::KnownFact::scissor, false}};
  DamagedBackend backend([](const auto&, auto& d) {
    if (d.size() > 0) drop(d, d.triangle.back(), d.x.back(), d.y.back());
  });
  Findings found;
  check_case(*find_law(kCoverage), "damaged", backend, 1, {scissored_square(), "here", 4}, found,
             &known);
  ASSERT_THAT(found.counterexamples, SizeIs(1));
  Findings shrunk;
  shrink_counterexample(*find_law(kCoverage), backend, found.counterexamples[0], {1000, {}}, shrunk,
                        &known);
  EXPECT_TRUE(shrunk.counterexamples.at(0).source.scissor.has_value());
  EXPECT_THAT(shrunk.counterexamples.at(0).source.attributes, IsEmpty());  // it is smaller
}

Findings checked_entry(const std::string& name) {
  const auto backend = driver(name);
  Findings findings;
  check_known_case(*find_law(kCoverage), "damaged:" + name, *backend, 1, known_defects(*backend), 0,
                   findings);
  return findings;
}

TEST(KnownDefects, AreExpectedOfTheirOwnCases) {
  const Findings findings = checked_entry("driver");
  EXPECT_EQ(findings.records.begin()->second.cases, (records::CaseCounts{1, 0, 0, 1}));
  EXPECT_EQ(findings.records.begin()->first.stratum, "known");
  EXPECT_THAT(findings.unexpected, IsEmpty());
}

TEST(KnownDefects, ThatAreGoneAreViolationsUnderTheirVersionOnly) {
  const Findings same = checked_entry("mended");
  EXPECT_EQ(same.records.begin()->second.cases, (records::CaseCounts{1, 0, 1, 0}));
  EXPECT_THAT(same.unexpected,
              ElementsAre(records::UnexpectedPass{"damaged:mended", "damaged-1", kCoverage,
                                                  Staleness::wrong_list}));
  EXPECT_THAT(same.counterexamples, IsEmpty());
  const Findings other = checked_entry("newer");
  EXPECT_EQ(other.records.begin()->second.cases, (records::CaseCounts{1, 0, 0, 0}));
  EXPECT_THAT(other.unexpected,
              ElementsAre(records::UnexpectedPass{"damaged:newer", "damaged-1", kCoverage,
                                                  Staleness::other_version}));
}

TEST(KnownDefects, AreTasksOfTheLawsThatAreRun) {
  const KnownByBackend known{{"damaged:driver", known_defects(*driver())}};
  const records::Plan options{1, 0, {"damaged:driver"}, {kCoverage}};
  EXPECT_THAT(tasks_of(options, 0, {}, known),
              ElementsAre(Task{"damaged:driver", kCoverage, TaskKind::known, 0, 1}));
  EXPECT_THAT(tasks_of({1, 0, {"damaged:driver"}, {"another law"}}, 0, {}, known), IsEmpty());
}

TEST(KnownDefects, AreReadByWhoRunsTheTasks) {
  const TemporaryFolder folder;
  put_known(folder);
  TaskRunner runner({.seed = 1, .backends = {"damaged:driver", "cpu"}}, {}, {folder.path()});
  EXPECT_THAT(runner.known().value(), SizeIs(1));
  const Findings findings =
      runner.run({"damaged:driver", kCoverage, TaskKind::known, 0, 1}).value();
  EXPECT_EQ(findings.records.begin()->second.cases.known, 1U);
  EXPECT_FALSE(runner.run({"damaged:driver", kCoverage, TaskKind::known, 1, 2}));
  EXPECT_FALSE(runner.run({"cpu", kCoverage, TaskKind::known, 0, 1}));
}

TEST(KnownDefects, AreToldApartByADigest) {
  const KnownDefects known = known_defects(*driver());
  EXPECT_EQ(digest_of_known({}), "");
  const std::string digest = digest_of_known({{"damaged:driver", known}});
  EXPECT_EQ(digest, digest_of_known({{"damaged:driver", known}}));
  KnownDefects other = known;
  other.defects[0].shown->positions[0].x = 0;
  EXPECT_NE(digest, digest_of_known({{"damaged:driver", other}}));
  EXPECT_NE(digest, digest_of_known({{"damaged:newer", known_defects(*driver("newer"))}}));
}

}  // namespace
}  // namespace rastercheck::properties::known_defects_test
