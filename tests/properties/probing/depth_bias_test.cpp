// A probe finds how depths are biased and stored. The backends are `cpu` and one that biases and
// stores depths by a calculation of its own, wrong in one way.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "backends/factory.h"
#include "properties/probing/measures.h"
#include "tests/properties/probing/own_bias.h"
#include "tests/properties/probing/probe_rows.h"

namespace rastercheck::properties::depth_bias_test {
namespace {

using cases::BiasExponent;
using cases::BiasPromise;
using cases::BiasSlope;
using cases::BiasUnit;
using cases::DepthStore;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;

/// The two measures' results.
records::Probe measured_of(backends::Backend& backend) {
  Subject subject("own", backend, {});
  EXPECT_TRUE(subject.choose_rules().has_value());
  Sight sight;
  measure_depth_store(subject, sight);
  measure_depth_bias(subject, sight);
  return subject.result;
}

records::Probe measured_of(const OwnBias& wrong) {
  OwnBiasBackend backend(wrong);
  return measured_of(backend);
}

void expect_right(const records::Probe& probe) {
  EXPECT_EQ(measured(probe, "rounding to unorm16"), "the nearest");
  EXPECT_EQ(measured(probe, "rounding to unorm24"), "the nearest");
  EXPECT_EQ(measured(probe, "unit of bias in float32"), "2^(e-23)");
  EXPECT_EQ(measured(probe, "unit of bias in unorm16"), "2^-16");
  EXPECT_EQ(measured(probe, "unit of bias in unorm24"), "2^-24");
  EXPECT_EQ(measured(probe, "slope of bias"), "the greater of |z_x|, |z_y|");
  EXPECT_EQ(measured(probe, "clamp of bias"), "limits on its own side");
  for (const char* where : {"inside the viewport", "cut at the viewport's sides",
                            "cut at the far plane", "under depth clamp"}) {
    EXPECT_EQ(measured(probe, std::string("exponent of bias, ") + where),
              "the greatest of the vertices");
  }
  EXPECT_EQ(measured(probe, "limits of biased depths"), "0 to 1, after the bias");
  EXPECT_EQ(measured(probe, "limits of biased depths, range 1/4 to 3/4"), "0 to 1, after the bias");
  EXPECT_EQ(measured(probe, "limits of biased depths, depth clamp"),
            "the depth range, after the bias");
  EXPECT_EQ(measured(probe, "biased depths as measured"), "hold");
  EXPECT_THAT(against(probe), IsEmpty());
  EXPECT_FALSE(probe.terms.depth_bias);
  EXPECT_FALSE(probe.terms.depth_store);
  for (const records::Measured& one : probe.rows) {
    EXPECT_GT(one.sureness.in_favour, 90U) << one.what;
    EXPECT_EQ(one.sureness.against, 0U) << one.what;
  }
}

TEST(DepthBias, IsAsAskedOfCpu) {
  const auto cpu = backends::make_backend("cpu");
  const records::Probe probe = measured_of(**cpu);
  expect_right(probe);
  // Direct3D's unit is another.
  EXPECT_EQ(measured(probe, "unit of bias in unorm16, d3d"), "1/(2^16 - 1)");
  EXPECT_EQ(measured(probe, "unit of bias in unorm24, d3d"), "1/(2^24 - 1)");
  EXPECT_EQ(measured(probe, "unit of bias in unorm16, opengl"), "no such row");
  EXPECT_LT(probe.drawings, 64U);  // a user waits
}

// A second calculation, without an error.
TEST(DepthBias, IsAsAskedOfTheCalculationBelow) { expect_right(measured_of(OwnBias())); }

// Kills: a contract that leaves open what a backend does exactly.
TEST(DepthBias, IsProposedIfABackendDeclaresLess) {
  OwnBiasBackend backend({});
  backend.declares = [](cases::Contract& contract) {
    contract.depth_store = DepthStore::either;
    contract.depth_bias = {BiasSlope::between, BiasUnit::open, BiasExponent::open};
  };
  const records::Probe probe = measured_of(backend);
  EXPECT_THAT(against(probe), IsEmpty());
  EXPECT_EQ(probe.terms.depth_store, DepthStore::nearest);
  EXPECT_EQ(probe.terms.depth_bias, BiasPromise());
}

TEST(DepthBias, IsNotAskedOfABackendThatLacksIt) {
  OwnBiasBackend backend({});
  backend.description.capabilities.lacks = {cases::Feature::depth_bias,
                                            cases::Feature::unorm_depth};
  const records::Probe probe = measured_of(backend);
  EXPECT_EQ(measured(probe, "unorm depth"), "not measured");
  EXPECT_EQ(measured(probe, "depth bias"), "not measured");
  EXPECT_EQ(probe.rows.size(), 2U);
  EXPECT_THAT(probe.rows[1].detail, HasSubstr("draws no such cases"));
  EXPECT_EQ(probe.drawings, 1U);  // to choose the rules
}

TEST(DepthBias, IsMeasuredInFloatsWithoutUnormDepth) {
  OwnBiasBackend backend({});
  backend.description.capabilities.lacks = {cases::Feature::unorm_depth};
  const records::Probe probe = measured_of(backend);
  EXPECT_EQ(measured(probe, "unit of bias in float32"), "2^(e-23)");
  EXPECT_EQ(measured(probe, "unit of bias in unorm16"), "no such row");
  EXPECT_THAT(against(probe), IsEmpty());
}

// ---- Storing.

void expect_store(double (*store)(double steps), const char* words, DepthStore proposed) {
  OwnBias wrong;
  wrong.store = store;
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "rounding to unorm16"), words);
  EXPECT_EQ(measured(probe, "rounding to unorm24"), words);
  EXPECT_EQ(probe.terms.depth_store, proposed) << words;
  EXPECT_THAT(against(probe), IsSupersetOf({"rounding to unorm16", "rounding to unorm24"}));
  // How depths are stored does not hide r.
  EXPECT_EQ(measured(probe, "unit of bias in unorm16"), "2^-16") << words;
}

TEST(DepthStore, IsFound) {
  expect_store([](double steps) { return std::floor(steps); }, "the lower neighbour",
               DepthStore::either);
  expect_store([](double steps) { return std::ceil(steps); }, "the upper neighbour",
               DepthStore::either);
  expect_store([](double steps) { return std::floor(steps + 0.42); }, "within 0.6",
               DepthStore::nearly_nearest);
  expect_store([](double steps) { return std::floor(steps + 0.25); }, "either neighbour",
               DepthStore::either);
}

TEST(DepthStore, MayBeNeitherNeighbour) {
  OwnBias wrong;
  wrong.store = [](double steps) { return std::round(steps) + 1; };
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "rounding to unorm16"), "neither neighbour");
  EXPECT_THAT(against(probe), IsSupersetOf({"rounding to unorm16"}));
}

// Kills: believing in a format that was not used.
TEST(DepthStore, MayBeInNoFormat) {
  class Unstored : public OwnBiasBackend {
   public:
    Unstored() : OwnBiasBackend({}) {}

   private:
    Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
      const auto cpu = backends::make_backend("cpu");
      cases::Case plain = c;
      plain.depth_format = cases::DepthFormat::float32;
      return backends::fragments_of((*cpu)->draw(plain));
    }
  };
  Unstored backend;
  EXPECT_EQ(measured(measured_of(backend), "rounding to unorm16"), "not stored in the format");
}

// ---- The unit.

void expect_unit(double unit, const std::string& words, BiasUnit proposed, bool is_permitted) {
  OwnBiasBackend backend({.unit = unit});
  backend.declares = [](cases::Contract& contract) { contract.depth_bias.unit = BiasUnit::open; };
  const records::Probe probe = measured_of(backend);
  EXPECT_EQ(measured(probe, "unit of bias in unorm16"), words);
  ASSERT_TRUE(probe.terms.depth_bias || proposed == BiasUnit::open) << words;
  if (probe.terms.depth_bias) {
    EXPECT_EQ(probe.terms.depth_bias->unit, proposed) << words;
  }
  EXPECT_EQ(against(probe).empty(), is_permitted) << words;
}

TEST(BiasUnit, OfUnormFormatsIsFound) {
  expect_unit(1, "2^-16", BiasUnit::power, true);
  expect_unit(2, "2^-15", BiasUnit::double_power, true);
  expect_unit(1.01, "1.01 · 2^-16", BiasUnit::either_power, true);
  expect_unit(0.5, "0.5 · 2^-16", BiasUnit::open, true);
  expect_unit(0x1p16 / 65535, "1/(2^16 - 1)", BiasUnit::either_power, true);
}

// Kills: a contract for r that no contract permits, without a word.
TEST(BiasUnit, BeyondAllContractsContradictsThem) {
  const auto beyond = [](double unit) {
    OwnBiasBackend backend({.unit = unit});
    backend.declares = [](cases::Contract& contract) {
      contract.depth_bias.unit = BiasUnit::either_power;
    };
    return measured_of(backend);
  };
  const records::Probe four = beyond(3);
  EXPECT_EQ(measured(four, "unit of bias in unorm16"), "3 · 2^-16");
  EXPECT_THAT(against(four), IsSupersetOf({"unit of bias in unorm16", "unit of bias in unorm24"}));
  const records::Probe mesa = beyond(2 * 0x1p16 / 65535);
  EXPECT_EQ(measured(mesa, "unit of bias in unorm16"), "2/(2^16 - 1)");
  EXPECT_THAT(against(mesa), IsSupersetOf({"unit of bias in unorm16"}));
}

TEST(BiasUnit, OfDoubleWhatIsDeclaredContradicts) {
  const records::Probe probe = measured_of({.unit = 2});
  EXPECT_THAT(against(probe), ElementsAre("unit of bias in unorm16", "unit of bias in unorm24"));
  EXPECT_EQ(probe.terms.depth_bias->unit, BiasUnit::double_power);
}

TEST(BiasUnit, OfFloatsIsFound) {
  const records::Probe probe = measured_of({.float_unit = 2});
  EXPECT_EQ(measured(probe, "unit of bias in float32"), "2 · 2^(e-23)");
  EXPECT_THAT(against(probe),
              IsSupersetOf({"unit of bias in float32", "biased depths as measured"}));
  // The exponent is right even so.
  EXPECT_EQ(measured(probe, "exponent of bias, inside the viewport"),
            "the greatest of the vertices");
  // The same r for all depths.
  OwnBias fixed;
  fixed.exponent_of = [](const std::array<double, 3>& /*z*/, double /*drawn*/) { return 0.5; };
  const records::Probe same = measured_of(fixed);
  EXPECT_THAT(measured(same, "unit of bias in float32"), HasSubstr(" to "));
  EXPECT_EQ(measured(same, "exponent of bias, inside the viewport"), "no such row");
}

// ---- The slope.

void expect_slope(double (*slope)(double x, double y), const std::string& words,
                  BiasSlope proposed) {
  OwnBias wrong;
  wrong.slope = slope;
  const records::Probe probe = measured_of(wrong);
  EXPECT_THAT(measured(probe, "slope of bias"), ::testing::StartsWith(words));
  EXPECT_THAT(against(probe), IsSupersetOf({"slope of bias"}));
  ASSERT_TRUE(probe.terms.depth_bias) << words;
  EXPECT_EQ(probe.terms.depth_bias->slope, proposed) << words;
  EXPECT_EQ(measured(probe, "clamp of bias"), "limits on its own side") << words;
}

TEST(BiasSlope, IsFound) {
  expect_slope([](double x, double y) { return std::hypot(x, y); }, "the root of z_x² + z_y²",
               BiasSlope::root);
  expect_slope([](double x, double y) { return (std::hypot(x, y) + std::max(x, y)) / 2; },
               "from the greater to the root", BiasSlope::between);
  expect_slope([](double x, double y) { return x + y; }, "|z_x| + |z_y|", BiasSlope::between);
  expect_slope([](double x, double y) { return 2 * std::max(x, y); }, "2 to 2 times",
               BiasSlope::between);
}

// ---- The clamp.

void expect_clamp(double (*clamp)(double offset, double clamp), const std::string& words) {
  OwnBias wrong;
  wrong.clamp = clamp;
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "clamp of bias"), words);
  EXPECT_THAT(against(probe), IsSupersetOf({"clamp of bias", "biased depths as measured"}));
}

TEST(BiasClamp, IsFound) {
  expect_clamp([](double offset,
                  double clamp) { return std::clamp(offset, -std::fabs(clamp), std::fabs(clamp)); },
               "limits on both sides");
  expect_clamp([](double offset, double /*clamp*/) { return offset; }, "limits nothing");
  expect_clamp([](double /*offset*/, double clamp) { return clamp; }, "of another kind");
}

// ---- The exponent.

records::Probe probe_of_exponent(double (*exponent_of)(const std::array<double, 3>& z,
                                                       double drawn)) {
  OwnBias wrong;
  wrong.exponent_of = exponent_of;
  return measured_of(wrong);
}

TEST(BiasExponent, OfOneVertexIsFound) {
  const records::Probe first =
      probe_of_exponent([](const std::array<double, 3>& z, double) { return z[0]; });
  const records::Probe last =
      probe_of_exponent([](const std::array<double, 3>& z, double) { return z[2]; });
  for (const char* where : {"inside the viewport", "cut at the far plane"}) {
    const std::string what = std::string("exponent of bias, ") + where;
    EXPECT_EQ(measured(first, what), "the first vertex");
    EXPECT_EQ(measured(last, what), "the last vertex");
    EXPECT_THAT(against(first), IsSupersetOf({what}));
  }
  EXPECT_EQ(first.terms.depth_bias->exponent, BiasExponent::open);
}

// As SwiftShader does.
TEST(BiasExponent, OfDifferencesIsFound) {
  OwnBias wrong;
  wrong.exponent_of = [](const std::array<double, 3>& z, double) {
    return std::max({std::fabs(z[1]), std::fabs(z[2] - z[1]), std::fabs(z[0] - z[1])});
  };
  OwnBiasBackend backend(wrong);
  backend.declares = [](cases::Contract& contract) {
    contract.depth_bias.exponent = BiasExponent::open;
  };
  const records::Probe probe = measured_of(backend);
  EXPECT_EQ(measured(probe, "exponent of bias, inside the viewport"),
            "the greatest of one vertex and the differences from it");
  EXPECT_THAT(against(probe), IsSupersetOf({"exponent of bias, inside the viewport"}));
}

TEST(BiasExponent, OfUnclampedVerticesIsFound) {
  const records::Probe probe = probe_of_exponent([](const std::array<double, 3>& z, double) {
    return std::max({std::fabs(z[0]), std::fabs(z[1]), std::fabs(z[2])});
  });
  EXPECT_EQ(measured(probe, "exponent of bias, inside the viewport"),
            "the greatest of the vertices");
  EXPECT_EQ(measured(probe, "exponent of bias, cut at the far plane"),
            "the greatest of the unclamped vertices");
  EXPECT_EQ(measured(probe, "exponent of bias, under depth clamp"),
            "the greatest of the unclamped vertices");
  EXPECT_EQ(probe.terms.depth_bias->exponent, BiasExponent::open);
}

// As llvmpipe does; permitted by a contract that leaves the exponent open.
TEST(BiasExponent, OfTheClippedTriangleIsFound) {
  OwnBias clipped;
  clipped.exponent_of = [](const std::array<double, 3>& z, double drawn) {
    // The inner triangles of the probe have no vertex at 1/16 twice.
    const bool is_inside = std::count(z.begin(), z.end(), 0.0625) < 2;
    return is_inside ? *std::max_element(z.begin(), z.end()) : drawn;
  };
  OwnBiasBackend backend(clipped);
  backend.declares = [](cases::Contract& contract) {
    contract.depth_bias.exponent = BiasExponent::open;
  };
  const records::Probe probe = measured_of(backend);
  const std::string what = "exponent of bias, cut at the viewport's sides";
  EXPECT_EQ(measured(probe, what), "the greatest of the clipped triangle");
  EXPECT_THAT(against(probe), ::testing::Not(::testing::Contains(what)));
}

TEST(BiasExponent, MayBeOfNoKindTried) {
  const records::Probe probe = probe_of_exponent([](const std::array<double, 3>& z, double) {
    return 4 * std::max({z[0], z[1], z[2]});
  });
  // Planes of constant depth have the same factor, so r takes it.
  EXPECT_EQ(measured(probe, "unit of bias in float32"), "4 · 2^(e-23)");
  const records::Probe middle = probe_of_exponent([](const std::array<double, 3>& z, double) {
    return z[0] == z[1] && z[1] == z[2] ? z[0] : 8 * z[0];
  });
  EXPECT_EQ(measured(middle, "exponent of bias, inside the viewport"), "of no kind tried");
}

// ---- Limits.

void expect_limits(OwnBias::Limit limit, const std::array<const char*, 3>& words) {
  OwnBias wrong;
  wrong.limit = limit;
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "limits of biased depths"), words[0]);
  EXPECT_EQ(measured(probe, "limits of biased depths, range 1/4 to 3/4"), words[1]);
  EXPECT_EQ(measured(probe, "limits of biased depths, depth clamp"), words[2]);
  EXPECT_THAT(against(probe),
              IsSupersetOf({"limits of biased depths", "limits of biased depths, range 1/4 to 3/4",
                            "limits of biased depths, depth clamp"}));
}

TEST(BiasLimits, AreFound) {
  // As softpipe does.
  expect_limits(OwnBias::Limit::at_vertices, {"0 to 1, at the vertices", "0 to 1, at the vertices",
                                              "the depth range, at the vertices"});
  expect_limits(OwnBias::Limit::never, {"nothing", "nothing", "nothing"});
  // Where no depth is beyond the range, limits before the bias are none.
  expect_limits(OwnBias::Limit::before, {"nothing", "nothing", "the depth range, before the bias"});
}

}  // namespace
}  // namespace rastercheck::properties::depth_bias_test
