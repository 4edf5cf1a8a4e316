#include "properties/campaign/power.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "properties/campaign/campaign.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::power_test {
namespace {

using records::Defect;

const std::string kCoverage(kCoverageLaw);
const std::string kValues(kValuesLaw);

records::Plan plan_of(std::vector<std::string> laws) {
  records::Plan plan;
  plan.seed = 5;
  plan.laws = std::move(laws);
  plan.power = 1;
  return plan;
}

records::Power measured(const records::Plan& plan, const std::string& law,
                        backends::Backend& backend, const cases::Case& source = square()) {
  records::Power power;
  measure_power(plan, *find_law(law), backend, source, power);
  return power;
}

// Kills: a wrong share, such as all cases or none; sabotaged cases of laws that draw twice.
TEST(IsSabotaged, SelectsTheRequestedShareOfTwoLaws) {
  records::Plan plan = plan_of({kCoverage, kValues});
  const auto count = [&plan](const std::string& law) {
    int sabotaged = 0;
    for (std::uint64_t i = 0; i < 5000; ++i) {
      sabotaged += is_sabotaged(plan, *find_law(law), i) ? 1 : 0;
    }
    return sabotaged;
  };
  EXPECT_EQ(count(kValues), 5000);
  EXPECT_EQ(count("constants-stay-constant"), 0);
  plan.power = 50;
  // 100, plus or minus six times its standard deviation of 10: one seed in 10^8 lies beyond.
  EXPECT_NEAR(count(kValues), 100, 60);
  EXPECT_NEAR(count(kCoverage), 100, 60);
  plan.power = 0;
  EXPECT_EQ(count(kValues), 0);
}

TEST(MeasurePower, NoticesEachDefectOfAnExactBackend) {
  DamagedBackend backend({}, "cpu");
  const records::Plan plan = plan_of({kCoverage, kValues});
  records::Power power = measured(plan, kCoverage, backend);
  EXPECT_EQ(power.at(Defect::moved_half), (records::Noticed{1, 1}));
  EXPECT_EQ(power.at(Defect::missing_pixel), (records::Noticed{1, 1}));
  EXPECT_FALSE(power.contains(Defect::values_nan));
  power = measured(plan, kValues, backend);
  EXPECT_EQ(power.at(Defect::values_nan), (records::Noticed{1, 1}));
  EXPECT_EQ(power.at(Defect::depth_2_ulp), (records::Noticed{1, 1}));
  EXPECT_FALSE(power.contains(Defect::moved_half));
  EXPECT_FALSE(power.contains(Defect::missing_pixel));
}

// Values show what samples do not. Kills: looking at values in a run without the law of values;
// counting values as noticed that were wrong before the defect was added.
TEST(MeasurePower, NoticesMovedValuesWhereTheRunLooksAtThemAndTheyWereRight) {
  const auto noticed = [](const Damage& damage, std::vector<std::string> laws) {
    DamagedBackend backend(damage, "cpu");
    cases::Case c = square();
    for (cases::ClipVertex& p : c.positions) p.x += 0.03125F;  // edges beside samples, by 1/8 pixel
    return measured(plan_of(std::move(laws)), kCoverage, backend, c)
        .at(Defect::moved_1024th)
        .noticed;
  };
  const Damage wrong_depth = [](const cases::Case&, cases::Fragments& drawn) {
    for (float& depth : drawn.depth) depth = 2;
  };
  EXPECT_EQ(noticed({}, {kCoverage, kValues}), 1U);
  EXPECT_EQ(noticed({}, {kCoverage}), 0U);
  EXPECT_EQ(noticed(wrong_depth, {kCoverage, kValues}), 0U);
}

// Kills: a power that depends on how the run was split into tasks.
TEST(MeasurePower, IsTheSameHoweverTheCasesAreCut) {
  records::Plan plan = plan_of({kCoverage, kValues});
  plan.power = 3;
  TaskRunner runner(plan, {});
  const auto run = [&runner](std::uint64_t first, std::uint64_t last) {
    return *runner.run({"cpu", kValues, TaskKind::random, first, last});
  };
  const Findings whole = run(0, 20);
  Findings parts = run(0, 7);
  merge(parts, run(7, 20));
  EXPECT_EQ(parts, whole);
  records::Power power;
  for (const auto& [key, record] : whole.records) records::merge(power, record.power);
  EXPECT_GT(records::total(power).drawings, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::power_test
