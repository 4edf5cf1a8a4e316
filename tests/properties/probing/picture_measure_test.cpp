// A probe finds how pictures are stored, blended, resolved and textured. The backends are `cpu` and
// one that makes pictures of cpu's fragments by a calculation of its own, wrong in one way.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "backends/factory.h"
#include "properties/probing/measures.h"
#include "tests/properties/probing/bent.h"
#include "tests/properties/probing/own_picture.h"
#include "tests/properties/probing/probe_rows.h"

namespace rastercheck::properties::picture_measure_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// The two measures' results.
records::Probe measured_of(backends::Backend& backend) {
  Subject subject("own", backend, {});
  EXPECT_TRUE(subject.choose_rules().has_value());
  measure_pictures(subject);
  measure_textures(subject);
  return subject.result;
}

records::Probe measured_of(const OwnPicture& wrong) {
  OwnPictureBackend backend(wrong);
  return measured_of(backend);
}

/// Promises what a driver promises that computes in float32.
void declare_as_driver(cases::Contract& contract) {
  contract.picture_bounds = {.float_error = 4,
                             .byte_store = 0.6F,
                             .byte_blend = 2,
                             .byte_mean = 2,
                             .texel_share = 0x1p-22F,
                             .texel_distance = 0x1p-8F};
  contract.texture_bounds = {.coordinate_share = 0x1p-22F, .bilinear = 0x1p18F};
}

records::Probe measured_of_driver(const OwnPicture& wrong) {
  OwnPictureBackend backend(wrong);
  backend.declares = &declare_as_driver;
  return measured_of(backend);
}

void expect_right(const records::Probe& probe) {
  EXPECT_EQ(measured(probe, "fragments of pictures"), "as drawn alone");
  EXPECT_EQ(measured(probe, "differences along x"), "fine: each row its own");
  EXPECT_EQ(measured(probe, "differences along y"), "fine: each column its own");
  for (const char* what : {"storing in bytes", "blending over in bytes", "adding in bytes"}) {
    EXPECT_EQ(measured(probe, what), "the nearest") << what;
  }
  for (const char* what : {"blending over in float32", "adding in float32"}) {
    EXPECT_EQ(measured(probe, what), "the nearest float") << what;
  }
  EXPECT_EQ(measured(probe, "resolve of bytes"), "the mean: the nearest");
  EXPECT_EQ(measured(probe, "resolve of float32"), "the mean: the nearest float");
  EXPECT_EQ(measured(probe, "weights of the bilinear filter"), "on no grid down to 2^-16");
  EXPECT_EQ(measured(probe, "texel choice near borders"), "exact");
  EXPECT_EQ(measured(probe, "texel at a border"), "the one beyond");
  EXPECT_THAT(against(probe), IsEmpty());
  EXPECT_EQ(probe.rows.size(), 13U);
  for (const records::Measured& one : probe.rows) {
    EXPECT_NE(one.declared, "–") << one.what;
    EXPECT_GE(one.sureness.in_favour, 4U) << one.what;
    EXPECT_EQ(one.sureness.against, 0U) << one.what;
  }
}

TEST(Pictures, AreAsPromisedOfCpu) {
  const auto cpu = backends::make_backend("cpu");
  const records::Probe probe = measured_of(**cpu);
  expect_right(probe);
  EXPECT_LT(probe.drawings, 64U);  // a user waits
}

// A second calculation, without an error.
TEST(Pictures, AreAsPromisedOfTheCalculationBelow) { expect_right(measured_of(OwnPicture())); }

TEST(Pictures, MayBeBetterThanADriverPromises) {
  const records::Probe probe = measured_of_driver({});
  expect_right(probe);
  EXPECT_EQ(row(probe, "storing in bytes").declared, "within 0.6 steps");
  EXPECT_EQ(row(probe, "texel at a border").declared, "either");
}

// Kills: a promise without slack, as plugins make, that only numbers without rounding keep.
TEST(Pictures, AreRoundedByABackendThatPromisesNoError) {
  OwnPictureBackend backend({});
  backend.declares = [](cases::Contract& contract) {
    contract.picture_bounds = cases::PictureBounds{};
  };
  const records::Probe probe = measured_of(backend);
  expect_right(probe);
  EXPECT_EQ(row(probe, "adding in float32").declared, "the nearest float");
  EXPECT_EQ(row(probe, "texel choice near borders").declared, "exact");
  EXPECT_EQ(row(probe, "texel at a border").declared, "the one beyond");
}

TEST(Pictures, AreNotAskedOfABackendThatDrawsNone) {
  Bent backend({});
  const records::Probe probe = measured_of(backend);
  ASSERT_EQ(probe.rows.size(), 2U);
  for (const char* what : {"pictures", "textures"}) {
    EXPECT_EQ(measured(probe, what), "not measured");
    EXPECT_EQ(row(probe, what).detail, "the backend draws no pictures");
  }
  EXPECT_EQ(probe.drawings, 1U);  // to choose the rules
}

// Kills: rows that vanish if a backend refuses their pictures.
TEST(Pictures, ThatAreRefusedHaveRows) {
  OwnPictureBackend backend({});
  backend.refuses = [](const cases::Case&, const cases::Pipeline&) { return true; };
  const records::Probe none = measured_of(backend);
  for (const records::Measured& one : none.rows) EXPECT_EQ(one.measured, "not drawn") << one.what;
  EXPECT_GE(none.rows.size(), 11U);
  EXPECT_THAT(against(none), IsEmpty());
  backend.refuses = [](const cases::Case& c, const cases::Pipeline&) {
    return c.framebuffer.samples > 1;
  };
  const records::Probe single = measured_of(backend);
  EXPECT_EQ(single.rows.size(), 13U);
  EXPECT_EQ(measured(single, "resolve of bytes"), "not drawn");
  EXPECT_EQ(measured(single, "storing in bytes"), "the nearest");
}

TEST(Pictures, OfOtherFragmentsContradictThePromise) {
  OwnPicture wrong;
  wrong.value = [](float value) { return value * (1 + 0x1p-23F); };
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "fragments of pictures"), "other values or depths");
  EXPECT_THAT(against(probe), ElementsAre("fragments of pictures"));
  OwnPictureBackend backend(wrong);
  backend.declares = [](cases::Contract& contract) {
    declare_as_driver(contract);
    contract.picture_bounds->keeps_fragments = false;
  };
  EXPECT_THAT(against(measured_of(backend)), IsEmpty());
}

// ---- Bytes.

void expect_store(double (*store)(double steps), const std::string& words) {
  OwnPicture wrong;
  wrong.store = store;
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "storing in bytes"), words);
  EXPECT_EQ(measured(probe, "blending over in bytes"), "the nearest");
  EXPECT_THAT(against(probe), ElementsAre("storing in bytes")) << words;
  // The same with blending, and without it as asked.
  OwnPicture blended;
  blended.store_blended = store;
  const records::Probe other = measured_of(blended);
  EXPECT_EQ(measured(other, "blending over in bytes"), words);
  EXPECT_EQ(measured(other, "adding in bytes"), words);
  EXPECT_EQ(measured(other, "storing in bytes"), "the nearest");
  EXPECT_THAT(against(other), ElementsAre("blending over in bytes", "adding in bytes")) << words;
}

TEST(StoringInBytes, IsFound) {
  expect_store([](double steps) { return std::floor(steps); }, "the lower neighbour");
  expect_store([](double steps) { return std::ceil(steps); }, "the upper neighbour");
  expect_store([](double steps) { return std::floor(steps + 0.25); }, "either neighbour");
}

TEST(StoringInBytes, MayBeMoreThanAStepOff) {
  OwnPicture wrong;
  wrong.store = [](double steps) { return 2 * std::round(steps / 2) + 1; };
  const records::Probe probe = measured_of(wrong);
  EXPECT_THAT(measured(probe, "storing in bytes"), StartsWith("up to "));
  EXPECT_THAT(measured(probe, "storing in bytes"), HasSubstr(" steps off"));
}

// A promise of 0.6 steps permits 0.58 and not 1.
TEST(StoringInBytes, IsHeldToWhatIsDeclared) {
  OwnPicture wrong;
  wrong.store = [](double steps) { return std::floor(steps + 0.42); };
  const records::Probe near = measured_of_driver(wrong);
  EXPECT_EQ(measured(near, "storing in bytes"), "either neighbour");
  EXPECT_THAT(against(near), IsEmpty());
  wrong.store = [](double steps) { return std::floor(steps); };
  EXPECT_THAT(against(measured_of_driver(wrong)), ElementsAre("storing in bytes"));
}

// Kills: believing in bytes that are floats.
TEST(StoringInBytes, MayNotHappen) {
  OwnPicture wrong;
  wrong.store = [](double steps) { return steps; };
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "storing in bytes"), "not stored in bytes");
  // Bytes would have another mean than these.
  EXPECT_THAT(against(probe), ElementsAre("storing in bytes", "resolve of bytes"));
}

TEST(Blending, InFloatsIsMeasured) {
  OwnPicture wrong;
  wrong.blended = [](double color) { return color * (1 + 0x1p-22); };  // 4 units, and a rounding
  const records::Probe probe = measured_of(wrong);
  for (const char* what : {"blending over in float32", "adding in float32"}) {
    EXPECT_THAT(measured(probe, what),
                ::testing::AnyOf(StartsWith("up to 4."), StartsWith("up to 5 ")));
  }
  EXPECT_THAT(against(probe), ElementsAre("blending over in float32", "adding in float32"));
  wrong.blended = [](double color) { return color * (1 + 0x1p-21); };
  EXPECT_THAT(against(measured_of_driver(wrong)),
              ElementsAre("blending over in float32", "adding in float32"));
  wrong.blended = [](double color) { return color * (1 + 0x1p-23); };
  EXPECT_THAT(against(measured_of_driver(wrong)), IsEmpty());
}

// ---- Resolve.

void expect_resolve(double (*resolve)(const std::vector<double>& samples), const std::string& bytes,
                    const std::string& floats) {
  OwnPicture wrong;
  wrong.resolve = resolve;
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "resolve of bytes"), bytes);
  EXPECT_EQ(measured(probe, "resolve of float32"), floats);
  EXPECT_THAT(against(probe), ElementsAre("resolve of bytes", "resolve of float32")) << bytes;
}

double mean_of(const std::vector<double>& samples) {
  double sum = 0;
  for (const double sample : samples) sum += sample;
  return sum / static_cast<double>(samples.size());
}

TEST(Resolve, IsFound) {
  expect_resolve([](const std::vector<double>& samples) { return samples[0]; }, "sample 0",
                 "sample 0");
  expect_resolve([](const std::vector<double>& samples) { return samples[1]; }, "sample 1",
                 "sample 1");
  expect_resolve(
      [](const std::vector<double>& samples) {
        return *std::max_element(samples.begin(), samples.end());
      },
      "between the least and the greatest", "between the least and the greatest");
  expect_resolve([](const std::vector<double>& samples) { return mean_of(samples) + 200; },
                 "beyond the samples", "beyond the samples");
}

TEST(Resolve, OfBytesMayRoundDown) {
  OwnPicture wrong;
  wrong.resolve = [](const std::vector<double>& samples) {
    return samples[0] == std::floor(samples[0]) ? std::floor(mean_of(samples)) : mean_of(samples);
  };
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "resolve of bytes"), "the mean: the lower neighbour");
  EXPECT_EQ(measured(probe, "resolve of float32"), "the mean: the nearest float");
  EXPECT_THAT(against(probe), ElementsAre("resolve of bytes"));
  EXPECT_THAT(against(measured_of_driver(wrong)), IsEmpty());
}

// As pairwise means that are rounded upwards make it.
TEST(Resolve, OfBytesMayBeRoundedSeveralTimes) {
  OwnPicture wrong;
  wrong.resolve = [](std::vector<double> samples) {
    if (samples[0] != std::floor(samples[0])) return mean_of(samples);
    while (samples.size() > 1) {
      for (std::size_t i = 0; i < samples.size() / 2; ++i) {
        samples[i] = std::ceil((samples[2 * i] + samples[2 * i + 1]) / 2);
      }
      samples.resize(samples.size() / 2);
    }
    return samples[0];
  };
  const records::Probe probe = measured_of(wrong);
  EXPECT_THAT(measured(probe, "resolve of bytes"), StartsWith("the mean: up to 1."));
  EXPECT_THAT(against(probe), ElementsAre("resolve of bytes"));
  EXPECT_THAT(against(measured_of_driver(wrong)), IsEmpty());
}

// Kills: a mean that is demanded of a backend that promises none.
TEST(Resolve, MayBeAnythingBetween) {
  OwnPicture wrong;
  wrong.resolve = [](const std::vector<double>& samples) { return samples[0]; };
  OwnPictureBackend backend(wrong);
  backend.declares = [](cases::Contract& contract) {
    declare_as_driver(contract);
    contract.picture_bounds->resolves_to_mean = false;
  };
  const records::Probe probe = measured_of(backend);
  EXPECT_EQ(row(probe, "resolve of bytes").declared, "between the least and the greatest");
  EXPECT_THAT(against(probe), IsEmpty());
}

// ---- Differences across quads.

TEST(Differences, MayBeCoarse) {
  OwnPicture wrong;
  wrong.difference = [](double, double even, double) { return even; };
  const records::Probe even = measured_of(wrong);
  EXPECT_EQ(measured(even, "differences along x"), "coarse: those of the even row");
  EXPECT_EQ(measured(even, "differences along y"), "coarse: those of the even column");
  EXPECT_THAT(against(even), ElementsAre("differences along x", "differences along y"));
  EXPECT_THAT(against(measured_of_driver(wrong)),
              ElementsAre("differences along x", "differences along y"));
  wrong.difference = [](double, double, double odd) { return odd; };
  EXPECT_EQ(measured(measured_of(wrong), "differences along x"), "coarse: those of the odd row");
  wrong.difference = [](double, double even, double odd) { return (even + odd) / 2; };
  EXPECT_EQ(measured(measured_of(wrong), "differences along y"), "neither fine nor coarse");
}

TEST(Differences, HaveErrors) {
  OwnPicture wrong;
  wrong.difference = [](double own, double, double) {
    const auto nearest = static_cast<float>(own);
    return double{std::nextafter(nearest, double{nearest} > own ? -2.0F : 2.0F)};
  };
  EXPECT_EQ(row(measured_of(wrong), "differences along x").detail,
            "neighbours of those of the values drawn");
  wrong.difference = [](double own, double, double) { return own + 0x1p-20; };
  const records::Probe far = measured_of_driver(wrong);
  EXPECT_THAT(row(far, "differences along x").detail, HasSubstr("2^-24 of the two values' sizes"));
  EXPECT_EQ(measured(far, "differences along x"), "fine: each row its own");
  EXPECT_THAT(against(far), ElementsAre("differences along x", "differences along y"));
  wrong.difference = [](double own, double, double) { return own; };
  EXPECT_EQ(row(measured_of(wrong), "differences along x").detail,
            "the nearest floats to those of the values drawn");
}

// ---- Textures.

void expect_weights(const std::function<double(double share)>& weight, const std::string& words,
                    const std::string& detail) {
  OwnPicture wrong;
  wrong.weight = weight;
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "weights of the bilinear filter"), words);
  EXPECT_THAT(row(probe, "weights of the bilinear filter").detail, HasSubstr(detail));
  EXPECT_THAT(against(probe), ElementsAre("weights of the bilinear filter")) << words;
}

TEST(FilterWeights, AreFoundOnTheirGrid) {
  expect_weights([](double share) { return std::round(share * 16) / 16; }, "multiples of 2^-4",
                 ", the nearest");
  expect_weights([](double share) { return std::floor(share * 256) / 256; }, "multiples of 2^-8",
                 ", the lower neighbour");
  expect_weights([](double share) { return std::round(share * 0x1p16) * 0x1p-16; },
                 "multiples of 2^-16", ", the nearest");
  expect_weights([](double share) { return std::round(share * 255) / 255; }, "multiples of 1/255",
                 ", the nearest");
  expect_weights([](double share) { return std::round(share); }, "0 and 1 only: not filtered",
                 "off the exact weights");
  // A step of the smoothness that some shaders take.
  expect_weights([](double share) { return share * share * (3 - 2 * share); },
                 "on no grid down to 2^-16", "off the exact weights");
}

TEST(FilterWeights, AreHeldToWhatIsDeclared) {
  OwnPicture wrong;
  wrong.weight = [](double share) { return std::round(share * 256) / 256; };
  EXPECT_THAT(against(measured_of_driver(wrong)), IsEmpty());  // 2^-6
  wrong.weight = [](double share) { return std::round(share * 16) / 16; };
  EXPECT_THAT(against(measured_of_driver(wrong)), ElementsAre("weights of the bilinear filter"));
}

TEST(TexelChoice, MayBeEarlyOrLate) {
  OwnPicture wrong;
  wrong.texel = [](double place) { return place + 0x1p-9; };
  const records::Probe early = measured_of(wrong);
  EXPECT_EQ(measured(early, "texel choice near borders"), "up to 0.00195 texels early");
  EXPECT_EQ(measured(early, "texel at a border"), "the one beyond");
  EXPECT_THAT(against(early), ElementsAre("texel choice near borders"));
  // 2^-13 of a texture of 16 texels, whose floats just before the first border are 2^-28 apart.
  EXPECT_EQ(row(early, "texel choice near borders").detail, "up to 3.28e+04 float32 steps early");
  wrong.texel = [](double place) { return place - 0x1p-9; };
  const records::Probe late = measured_of(wrong);
  EXPECT_EQ(measured(late, "texel choice near borders"), "up to 0.00195 texels late");
  EXPECT_EQ(measured(late, "texel at a border"), "the one before");
  EXPECT_THAT(against(late), ElementsAre("texel choice near borders", "texel at a border"));
  EXPECT_THAT(against(measured_of_driver(wrong)), IsEmpty());
  wrong.texel = [](double place) { return place - 0x1p-7; };
  EXPECT_THAT(against(measured_of_driver(wrong)), ElementsAre("texel choice near borders"));
}

// As a product that is rounded to float32 makes it.
TEST(TexelChoice, IsFoundToTheFloat) {
  OwnPicture wrong;
  wrong.texel = [](double place) {
    return static_cast<double>(std::round(place * 0x1p19) * 0x1p-19);
  };
  const records::Probe probe = measured_of(wrong);
  EXPECT_THAT(measured(probe, "texel choice near borders"),
              ::testing::MatchesRegex("up to 9\\.[0-9]+e-07 texels early"));
  EXPECT_THAT(against(probe), ElementsAre("texel choice near borders"));
}

// Kills: a row that looks at one side of the border only.
TEST(TexelChoice, OwnerOfABorderIsFound) {
  OwnPicture wrong;
  wrong.texel = [](double place) { return place == std::floor(place) ? place - 0.5 : place; };
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "texel choice near borders"), "exact");
  EXPECT_EQ(measured(probe, "texel at a border"), "the one before");
  EXPECT_THAT(against(probe), ElementsAre("texel at a border"));
  wrong.texel = [](double place) { return place == 5 ? 4.5 : place; };
  EXPECT_EQ(measured(measured_of(wrong), "texel at a border"), "either");
}

TEST(TexelChoice, MayBeOfAnotherTexel) {
  OwnPicture wrong;
  wrong.texel = [](double /*place*/) { return 7.5; };  // at none of the borders
  const records::Probe probe = measured_of(wrong);
  EXPECT_EQ(measured(probe, "texel choice near borders"), "other texels");
  EXPECT_EQ(measured(probe, "texel at a border"), "not drawn");
  EXPECT_THAT(against(probe), ElementsAre("texel choice near borders"));
}

}  // namespace
}  // namespace rastercheck::properties::picture_measure_test
