// The hunt: its archive, that it depends on seed and steps alone, and that it finds what as many
// random cases do not.

#include "properties/campaign/hunt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "properties/campaign/campaign.h"
#include "properties/campaign/check_case.h"
#include "properties/campaign/workers.h"
#include "properties/float_numbers.h"
#include "records/record.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::hunt_test {
namespace {

using records::AttributeKind;
using records::Stratum;
using testing::ElementsAre;
using testing::IsEmpty;

// ---- the archive

/// An entry with an excess of `share` of a bound of 4.
HuntEntry entry(double share, std::uint64_t root, std::uint64_t step,
                Stratum stratum = Stratum::ordinary) {
  HuntEntry made;
  made.error.kind = AttributeKind::smooth;
  made.error.stratum = stratum;
  made.error.excess = {4 * share, 4 * share};
  made.error.ideal = made.error.excess;
  made.error.bound = records::Enclosure{4, 4};
  made.root = root;
  made.step = step;
  return made;
}

std::vector<std::uint64_t> steps_of(const HuntArchive& archive,
                                    Stratum stratum = Stratum::ordinary) {
  std::vector<std::uint64_t> steps;
  const auto niche = archive.niches().find({AttributeKind::smooth, stratum});
  if (niche == archive.niches().end()) return steps;
  for (const HuntEntry& one : niche->second) steps.push_back(one.step);
  return steps;
}

TEST(HuntArchive, OrdersTheEntriesOfANiche) {
  HuntArchive archive(Guide::share);
  EXPECT_TRUE(archive.offer(entry(0.25, 1, 1)));
  EXPECT_TRUE(archive.offer(entry(0.75, 2, 2)));
  EXPECT_TRUE(archive.offer(entry(0.5, 3, 3)));
  EXPECT_TRUE(archive.offer(entry(0.5, 4, 4)));
  EXPECT_THAT(steps_of(archive), ElementsAre(2, 3, 4, 1));
}

TEST(HuntArchive, KeepsNichesApart) {
  HuntArchive archive(Guide::share);
  for (std::uint64_t i = 0; i < 20; ++i) archive.offer(entry(0.5 + 0.01 * double(i), i, i));
  EXPECT_TRUE(archive.offer(entry(0.001, 50, 50, Stratum::sliver)));
  EXPECT_EQ(steps_of(archive).size(), HuntArchive::kMostEntries);
  EXPECT_THAT(steps_of(archive, Stratum::sliver), ElementsAre(50));
  std::set<Stratum> chosen;
  for (std::uint64_t i = 0; i < 50; ++i) {
    Draw draw(1, "test", i);
    chosen.insert(archive.choose(draw)->error.stratum);
  }
  EXPECT_EQ(chosen.size(), 2U);
}

// Kills: steps spent evenly on niches that cannot get worse; niches left out for good.
TEST(HuntArchive, PrefersNichesWhoseMovesAreKept) {
  HuntArchive archive(Guide::share);
  archive.offer(entry(0.5, 1, 1));
  archive.offer(entry(0.5, 2, 2, Stratum::sliver));
  const auto times_ordinary = [&archive] {
    int times = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      Draw draw(1, "test", i);
      times += archive.choose(draw)->error.stratum == Stratum::ordinary ? 1 : 0;
    }
    return times;
  };
  const HuntArchive::Niche ordinary{AttributeKind::smooth, Stratum::ordinary};
  const HuntArchive::Niche sliver{AttributeKind::smooth, Stratum::sliver};
  for (int i = 0; i < 50; ++i) archive.note(ordinary, false);
  for (int i = 0; i < 50; ++i) archive.note(sliver, i % 10 == 0);
  // One of two draws of two niches has both the same; of these, half are ordinary. Six standard
  // deviations are 82.
  EXPECT_NEAR(times_ordinary(), 250, 82);
  // What was long ago is forgotten.
  for (int i = 0; i < 500; ++i) archive.note(sliver, false);
  for (int i = 0; i < 500; ++i) archive.note(ordinary, i % 10 == 0);
  EXPECT_NEAR(times_ordinary(), 750, 82);
}

TEST(HuntArchive, KeepsTheWorstOfARoot) {
  HuntArchive archive(Guide::share);
  archive.offer(entry(0.5, 7, 7));
  EXPECT_FALSE(archive.offer(entry(0.4, 7, 8)));
  EXPECT_TRUE(archive.offer(entry(0.6, 7, 9)));
  EXPECT_FALSE(archive.offer(entry(0.6, 7, 10)));
  EXPECT_THAT(steps_of(archive), ElementsAre(9));
}

TEST(HuntArchive, DropsTheLeastBadOfAFullNiche) {
  HuntArchive archive(Guide::share);
  for (std::uint64_t i = 0; i < HuntArchive::kMostEntries; ++i) {
    archive.offer(entry(0.5 - 0.01 * double(i), i, i));
  }
  EXPECT_FALSE(archive.offer(entry(0.43, 20, 20)));
  EXPECT_TRUE(archive.offer(entry(0.7, 21, 21)));
  EXPECT_THAT(steps_of(archive), ElementsAre(21, 0, 1, 2, 3, 4, 5, 6));
}

TEST(HuntArchive, TakesNoViolationAndNoRightValue) {
  HuntArchive archive(Guide::share);
  EXPECT_FALSE(archive.offer(entry(1.01, 1, 1)));
  EXPECT_FALSE(archive.offer(entry(0, 2, 2)));
  HuntEntry unbounded = entry(0.5, 3, 3);
  unbounded.error.bound.reset();
  EXPECT_FALSE(archive.offer(unbounded));
  EXPECT_THAT(archive.niches(), IsEmpty());
  EXPECT_TRUE(archive.offer(entry(1, 4, 4)));
  Draw draw(1, "test", 0);
  EXPECT_EQ(archive.choose(draw)->step, 4U);
  EXPECT_EQ(HuntArchive(Guide::share).choose(draw), nullptr);
}

TEST(HuntArchive, IsGuidedAsAsked) {
  HuntEntry steep = entry(0.1, 1, 1);
  steep.error.ideal = records::Enclosure{-100, -100};
  HuntArchive by_share(Guide::share);
  HuntArchive by_error(Guide::error);
  for (HuntArchive* const archive : {&by_share, &by_error}) {
    archive->offer(entry(0.5, 2, 2));
    archive->offer(steep);
  }
  EXPECT_THAT(steps_of(by_share), ElementsAre(2, 1));
  EXPECT_THAT(steps_of(by_error), ElementsAre(1, 2));
}

// ---- the search

const Law& values_law() { return *find_law(kValuesLaw); }

HuntPlan plan_of(const std::string& backend, std::uint64_t steps, std::uint64_t seed = 1) {
  HuntPlan plan;
  plan.law = kValuesLaw;
  plan.backend = backend;
  plan.seed = seed;
  plan.steps = steps;
  return plan;
}

/// Hunts in this process.
HuntOutcome hunt_here(const HuntPlan& plan, backends::BackendFactory factory = {},
                      const std::vector<cases::Case>& corpus = {}) {
  records::Plan tasks;
  tasks.seed = plan.seed;
  tasks.backends = {plan.backend};
  TaskRunner runner(tasks, {}, {}, factory);
  const auto backend = factory.make(plan.backend).value();
  return hunt(plan, corpus, *backend,
              [&runner](const std::vector<Task>& all, const TaskDone& done) {
                return run_tasks(runner, all, done);
              })
      .value();
}

double worst_share(const HuntOutcome& outcome) {
  double worst = 0;
  for (const auto& [niche, entries] : outcome.archive.niches()) {
    worst = std::max(worst, entries.front().error.score(Guide::share));
  }
  return worst;
}

TEST(Hunt, FindsTheSameForTheSameSeedAndSteps) {
  const HuntPlan plan = plan_of("cpu:precision=float32", 192);
  const HuntOutcome first = hunt_here(plan, {}, {square()});
  EXPECT_EQ(first, hunt_here(plan, {}, {square()}));
  EXPECT_EQ(first.steps, 192U);
  EXPECT_GT(first.sources.at(HuntSource::random), 0U);
  EXPECT_GT(first.sources.at(HuntSource::corpus), 0U);
  EXPECT_GT(first.sources.at(HuntSource::moved), 0U);
  EXPECT_GT(first.archive.niches().size(), 3U);
  EXPECT_FALSE(first.archive == hunt_here(plan_of("cpu:precision=float32", 192, 2)).archive);
}

// Kills: a worker process that is given other cases, and results that enter in the order in which
// they come.
TEST(Hunt, FindsTheSameInSeveralProcesses) {
  HuntPlan plan = plan_of("damaged:flipped", 128);
  const HuntOutcome alone = hunt_here(plan);
  EXPECT_GT(alone.violations, 0U);
  const auto backend = backends::make_backend("damaged:flipped").value();
  const std::vector<std::string> command{
      RASTERCHECK_DAMAGED_PROGRAM, "task-worker", "--plan",
      R"({"seed": 1, "cases_per_property": 1, "backends": ["damaged:flipped"],
          "properties": ["values-stay-within-the-bound"]})"};
  const auto together =
      hunt(plan, {}, *backend, [&](const std::vector<Task>& all, const TaskDone& done) {
        return run_tasks_in_processes(command, 3, all, done);
      });
  ASSERT_TRUE(together) << to_string(together.error());
  EXPECT_EQ(*together, alone);
}

// What time ends is the outcome of fewer steps.
TEST(Hunt, EndsWithAWholeRound) {
  const HuntPlan plan = plan_of("cpu", 256);
  records::Plan tasks;
  tasks.backends = {"cpu"};
  TaskRunner runner(tasks, {}, {}, {});
  const auto backend = backends::make_backend("cpu").value();
  std::uint64_t checked = 0;
  const IsToEnd is_to_end = [&checked] { return ++checked > 3 * kStepsPerRound; };
  const auto ended =
      hunt(plan, {}, *backend, [&](const std::vector<Task>& all, const TaskDone& done) {
        return run_tasks(runner, all, done, is_to_end);
      });
  ASSERT_TRUE(ended);
  EXPECT_GT(ended->steps, 0U);
  EXPECT_LT(ended->steps, 256U);
  EXPECT_EQ(ended->steps % kStepsPerRound, 0U);
  HuntPlan shorter = plan;
  shorter.steps = ended->steps;
  EXPECT_EQ(*ended, hunt_here(shorter));
}

TEST(Hunt, BeginsWithTheGivenCases) {
  HuntPlan plan = plan_of("cpu:precision=float32", 64);
  const HuntOutcome earlier = hunt_here(plan_of("cpu:precision=float32", 192));
  for (const auto& [niche, entries] : earlier.archive.niches()) {
    plan.given.push_back(entries.front().source);
  }
  const HuntOutcome later = hunt_here(plan);
  EXPECT_EQ(later.sources.at(HuntSource::given), plan.given.size());
  // What was found once is not lost.
  for (const auto& [niche, entries] : earlier.archive.niches()) {
    ASSERT_TRUE(later.archive.niches().contains(niche));
    EXPECT_GE(later.archive.niches().at(niche).front().error.score(Guide::share),
              entries.front().error.score(Guide::share));
  }
  plan.is_guided = false;
  EXPECT_EQ(hunt_here(plan).sources,
            (std::map<HuntSource, std::uint64_t>{{HuntSource::random, 64}}));
}

TEST(Hunt, EndsAtTheFirstViolationIfAsked) {
  HuntPlan plan = plan_of("damaged:flipped", 256);
  EXPECT_EQ(hunt_here(plan).steps, 256U);
  plan.fail_fast = true;
  const HuntOutcome ended = hunt_here(plan);
  EXPECT_GT(ended.violations, 0U);
  EXPECT_EQ(ended.steps, kStepsPerRound);
}

TEST(Hunt, CountsCasesThatABackendRefuses) {
  class NarrowBackend : public DamagedBackend {
   public:
    NarrowBackend() : DamagedBackend({}, "cpu") {}

   private:
    Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
      if (c.framebuffer.samples == 1) return DamagedBackend::draw_fragments(c);
      return tl::unexpected(Error{"", "", "several samples", Failure::unsupported});
    }
  };
  backends::BackendFactory factory;
  factory.wrap = [](auto /*backend*/) { return std::make_unique<NarrowBackend>(); };
  const HuntOutcome found = hunt_here(plan_of("cpu", 64), factory);
  ASSERT_EQ(found.not_applicable_because.count("several samples"), 1U);
  EXPECT_EQ(found.checked + found.not_applicable_because.at("several samples"), 64U);
  EXPECT_EQ(found.violations, 0U);
}

/// Draws like `cpu`, with a bound of kRareBound scale ULP, and errors that add up from three causes
/// that each give at most 10: a steep triangle, a value that cancels, vertex values of equal
/// magnitude. Each is common alone; only all three together exceed the bound.
constexpr float kRareBound = 27;

double part_of_ten(double amount, double most) { return 10 * std::clamp(amount / most, 0.0, 1.0); }

void err_rarely(const cases::Case& c, cases::Fragments& drawn) {
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const cases::Triangle& triangle = c.triangles[drawn.triangle[i]];
    const auto [least_w, most_w] = std::minmax(
        {c.positions[triangle[0]].w, c.positions[triangle[1]].w, c.positions[triangle[2]].w});
    const double steep =
        least_w > 0 ? part_of_ten(std::log2(double{most_w} / double{least_w}), 8) : 0;
    for (std::size_t a = 0; a < c.attributes.size(); ++a) {
      if (c.attributes[a].interpolation != cases::Interpolation::smooth) continue;
      const auto size = [&](std::size_t corner) {
        return double{std::fabs(c.attributes_of(triangle[corner])[a])};
      };
      const auto [least, most] = std::minmax({size(0), size(1), size(2)});
      float& value = drawn.attributes[i * drawn.attribute_count + a];
      if (least == 0 || value == 0 || most > 1e30) continue;
      const double equal = part_of_ten(4 - std::log2(most / least), 4);
      const double cancelled = part_of_ten(std::log2(most / std::fabs(double{value})), 18);
      value = to_float(double{value} + (steep + equal + cancelled) * ulp_of(most));
    }
  }
}

class RareBackend : public DamagedBackend {
 public:
  RareBackend() : DamagedBackend(&err_rarely, "cpu") {}
  cases::Contract promise(const cases::Case& c) const override {
    cases::Contract contract = DamagedBackend::promise(c);
    contract.bounds.smooth = {.constant = kRareBound};
    return contract;
  }
};

// Kills: a hunt that chooses parents whatever their errors.
TEST(Hunt, FindsADefectThatSamplingDoesNot) {
  backends::BackendFactory factory;
  factory.wrap = [](auto /*backend*/) { return std::make_unique<RareBackend>(); };
  constexpr std::uint64_t kSteps = 1536;
  HuntPlan plan = plan_of("cpu", kSteps, 4);
  const HuntOutcome hunted = hunt_here(plan, factory);
  plan.is_guided = false;
  const HuntOutcome sampled = hunt_here(plan, factory);
  EXPECT_EQ(sampled.violations, 0U) << worst_share(sampled);
  EXPECT_EQ(sampled.sources.at(HuntSource::random), kSteps);
  EXPECT_GT(hunted.violations, 0U) << worst_share(hunted);
  ASSERT_FALSE(hunted.counterexamples.empty());
  const records::Counterexample& found = hunted.counterexamples.front();
  EXPECT_EQ(found.source.found->kind, "smooth");
  // The counterexample says in which step it was found, and fails when checked again.
  EXPECT_LT(found.source.found->index, kSteps);
  RareBackend backend;
  EXPECT_GT(check_or_note(values_law(), found.source, backend, 0).violation_count, 0U);
}

// ---- the trophies

TEST(Hunt, ShrinksAWorstCaseThatKeepsItsError) {
  const HuntPlan plan = plan_of("cpu:precision=float32", 192);
  const HuntOutcome found = hunt_here(plan);
  const auto niche = found.archive.niches().find({AttributeKind::smooth, Stratum::ordinary});
  ASSERT_NE(niche, found.archive.niches().end());
  const HuntEntry& worst = niche->second.front();
  const auto backend = backends::make_backend(plan.backend).value();
  const HuntTrophy trophy = trophy_of(values_law(), plan, worst, *backend, {60, {}});
  EXPECT_TRUE(trophy.errs_again);
  EXPECT_GE(trophy.entry.error.score(plan.guide), worst.error.score(plan.guide));
  EXPECT_EQ(trophy.entry.error.stratum, Stratum::ordinary);
  ASSERT_TRUE(trophy.shrinking);
  EXPECT_GT(trophy.shrinking->tries, 0U);
  EXPECT_LE(trophy.entry.source.triangles.size(), worst.source.triangles.size());
  EXPECT_TRUE(trophy.kappa);
  ASSERT_TRUE(trophy.split);
  EXPECT_FALSE(trophy.split->parts.empty());
  // The file that replay reads names backend, property and step, and has the error again.
  const auto read = cases::parse_case(cases::to_json(trophy.entry.source), "trophy");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->found->index, worst.step);
  EXPECT_EQ(read->found->verdict, "held");
  const Check check = check_or_note(values_law(), *read, *backend, worst.step);
  const records::WorstError* const error =
      records::worst_of(check.judgement.errors.at(AttributeKind::smooth).ideal.extremes);
  ASSERT_NE(error, nullptr);
  EXPECT_GE(records::magnitude(error->error).hi, records::magnitude(*worst.error.ideal).lo);
}

TEST(Hunt, SaysThatACaseDoesNotErrAgain) {
  const HuntPlan plan = plan_of("cpu", 64);
  HuntEntry invented = entry(0.99, 0, 0);
  invented.source = square();
  const auto backend = backends::make_backend("cpu").value();
  const HuntTrophy trophy = trophy_of(values_law(), plan, invented, *backend, {10, {}});
  EXPECT_FALSE(trophy.errs_again);
  EXPECT_EQ(trophy.entry.error, invented.error);
}

}  // namespace
}  // namespace rastercheck::properties::hunt_test
