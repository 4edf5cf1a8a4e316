// A probe finds the known defect of a mutant from the mutant's drawings alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/error.h"
#include "properties/probing/probe.h"

namespace rastercheck::mutants::probing_test {
namespace {

using cases::Coverage;
using cases::Snapping;

struct Known {
  const char* mutant;
  Coverage coverage;  ///< what the cases ask for
  cases::Basis basis;
  const char* what;         ///< name of the row
  const char* measured;     ///< how the mutant's measurement begins
  const char* unharmed;     ///< how the measurement of cpu begins
  bool contradicts = true;  ///< false if contracts do not cover the row
};
std::ostream& operator<<(std::ostream& stream, const Known& known) {
  return stream << known.mutant;
}

constexpr auto kIdeal = cases::Basis::ideal;
constexpr auto kSnapped = cases::Basis::snapped;

Result<records::Probe> probe_of(const std::string& specification, const Coverage& coverage,
                                cases::Basis basis) {
  const auto backend = backends::make_backend(specification);
  if (!backend) return tl::unexpected(backend.error());
  properties::ProbeOptions options;
  options.cases = 4;
  options.asked = {coverage, basis, cases::TieRule::top_left};
  return properties::probe(specification, **backend, options, {});
}

class ProbeOfMutant : public ::testing::TestWithParam<Known> {
 protected:
  static records::Measured measured(const std::string& specification) {
    const Known& known = GetParam();
    const auto probe = probe_of(specification, known.coverage, known.basis);
    if (!probe) return {"", "", to_string(probe.error()), ""};
    for (const records::Measured& row : probe->rows) {
      if (row.what == known.what) return row;
    }
    return {"", "", "no such row", ""};
  }
};

TEST_P(ProbeOfMutant, FindsItsDefect) {
  const Known& known = GetParam();
  const records::Measured harmed = measured(std::string("mutant:") + known.mutant);
  EXPECT_THAT(harmed.measured, ::testing::StartsWith(known.measured));
  EXPECT_EQ(harmed.contradicts, known.contradicts);
  const records::Measured unharmed = measured("cpu");
  EXPECT_THAT(unharmed.measured, ::testing::StartsWith(known.unharmed));
  EXPECT_FALSE(unharmed.contradicts);
}

// A common fault, which ends the probe.
TEST(ProbeOfTiesAlwaysInside, NamesInclusiveEdges) {
  const auto probe = probe_of("mutant:ties-always-inside", Coverage(), kIdeal);
  ASSERT_TRUE(probe.has_value()) << to_string(probe.error());
  ASSERT_EQ(probe->faults.size(), 1U);
  EXPECT_EQ(probe->faults[0].id, "inclusive-edges");
}

INSTANTIATE_TEST_SUITE_P(
    Mutants, ProbeOfMutant,
    ::testing::Values(
        Known{"snap-truncates", Snapping{8}, kIdeal, "subpixel grid", "8 bits, down",
              "8 bits, nearest_even"},
        Known{"snap-halves-up", Snapping{8}, kIdeal, "subpixel grid", "8 bits, half_up",
              "8 bits, nearest_even"},
        Known{"snap-ties-turned", Snapping{8}, kIdeal, "tie rule", "bottom_left", "top_left"},
        Known{"snap-values-of-clip-positions", Snapping{8}, kSnapped, "basis of smooth attributes",
              "ideal", "snapped"},
        Known{"snap-facing-of-clip-positions", Snapping{8}, kSnapped, "basis of facing", "ideal",
              "snapped"},
        Known{"snap-positions-in-24-bits", Snapping{8}, kIdeal, "greatest coordinate drawn right",
              "30720 pixels", "2^96 pixels or more", false},
        Known{"vertex-value-interpolated", Coverage(), kIdeal, "values at vertices to the bit",
              "not kept", "kept"},
        Known{"rows-of-the-draw-before", Coverage(), kIdeal, "drawing twice", "other bits",
              "the same bits", false}));

}  // namespace
}  // namespace rastercheck::mutants::probing_test
