#include "reports/internal/metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::metrics_test {
namespace {

records::Run run_of(const records::ErrorSizes& sizes) {
  records::Run run;
  run.plan.laws = {"a law"};
  run.plan.backends = {"cpu"};
  records::Record record;
  record.errors.ideal = sizes;
  run.records[{"a law", "cpu", records::AttributeKind::smooth, "any"}] = record;
  return run;
}

records::ErrorSizes sizes_of(double below, double above) {
  records::ErrorSizes sizes;
  for (const double error : {below, above}) {
    sizes.histogram.add(error);
    keep(sizes.extremes, sample_worst(error));
  }
  return sizes;
}

const Metric& metric(const std::vector<MeteredEntry>& entries, std::string_view name) {
  for (const Metric& one : entries.at(0).metrics) {
    if (one.name == name) return one;
  }
  throw std::out_of_range("no metric of that name");
}

// Kills: taking the greatest signed error as the worst one.
TEST(MeteredEntries, TheWorstIsTheLargestMagnitude) {
  const auto entries = metered_entries(run_of(sizes_of(-3, 0.25)));
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].name, "a law on cpu: smooth, all");
  EXPECT_EQ(metric(entries, "worst").value, (records::Enclosure{3, 3}));
  EXPECT_EQ(metric(metered_entries(run_of(sizes_of(-0.25, 3))), "worst").value,
            (records::Enclosure{3, 3}));
}

// One of two values is off by more than one half.
TEST(MeteredEntries, MisroundedIsAShare) {
  const auto entries = metered_entries(run_of(sizes_of(-3, 0.25)));
  EXPECT_EQ(metric(entries, "misrounded").value, (records::Enclosure{0.5, 0.5}));
}

// JSON has no infinity. Kills: "value": null.
TEST(MeteredEntries, LeaveOutWhatIsNotFinite) {
  records::ErrorSizes sizes = sizes_of(-1, 1);
  sizes.histogram.add(0x1p60);
  keep(sizes.extremes, sample_worst(std::numeric_limits<double>::infinity()));
  const std::vector<MeteredEntry> entries = metered_entries(run_of(sizes));
  for (const Metric& one : entries.at(0).metrics) {
    EXPECT_NE(one.name, "worst");
  }
}

}  // namespace
}  // namespace rastercheck::reports::metrics_test
