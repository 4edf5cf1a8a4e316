// Textures (rasterizer/texture.h): their levels, wraps and filters, checked by hand.

#include "rasterizer/texture.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/rasterizer/failing_allocator.h"
#include "tests/rasterizer/fragment_batch.h"
#include "tests/rasterizer/textures.h"
#include "tests/simd_targets.h"

namespace rastercheck::rasterizer::texture_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A texture with each texel's number, modulo 256 in red and divided by 256 in green.
Texture numbered_texture(int width, int height) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < width * height; ++i) {
    for (const int byte : {i % 256, i / 256, 7, 255}) {
      bytes.push_back(static_cast<std::uint8_t>(byte));
    }
  }
  return made(width, height, bytes);
}

int number_at(const ShadedLanes& out, std::size_t lane) {
  return static_cast<int>(std::lround(out(0, lane) * 255) + 256 * std::lround(out(1, lane) * 255));
}

// Kills: accepting an invalid width, height or number of bytes; a texture lost on an error.
TEST(Texture, RefusesWhatIsNone) {
  Random random(1);
  const std::vector<std::uint8_t> bytes = random_bytes(random, 4, 2);
  Texture texture = made(4, 2, bytes);
  EXPECT_EQ(Texture::make(0, 2, {}, texture), Error::target_size);
  EXPECT_EQ(Texture::make(2, -1, bytes, texture), Error::target_size);
  EXPECT_EQ(Texture::make(kMaxSize + 1, 1, bytes, texture), Error::target_size);
  EXPECT_EQ(Texture::make(1, kMaxSize + 1, bytes, texture), Error::target_size);
  EXPECT_EQ(Texture::make(4, 3, bytes, texture), Error::attribute_values);
  EXPECT_EQ(Texture::make(4, 1, bytes, texture), Error::attribute_values);
  EXPECT_EQ(texture.width(), 4);
  EXPECT_EQ(texture.height(), 2);
  EXPECT_EQ(texture.level_count(), 3U);
  EXPECT_EQ(byte_at(texture, 0, 3, 1, 2), bytes[4 * 7 + 2]);
}

// Kills: an exception; a texture that is half old and half new.
TEST(Texture, RunningOutOfMemoryLeavesTheOld) {
  if (!kCanRunOutOfMemory) GTEST_SKIP() << "ThreadSanitizer has operators of its own";
  Random random(1);
  Texture texture = random_texture(random, 2, 2);
  const std::vector<std::uint8_t> bytes = random_bytes(random, 16, 16);
  int allocations = 0;
  for (;; ++allocations) {
    const std::optional<Error> error =
        with_allocations(allocations, [&] { return Texture::make(16, 16, bytes, texture); });
    if (!error) break;
    EXPECT_EQ(error, Error::out_of_memory);
    EXPECT_EQ(texture.width(), 2);
    EXPECT_EQ(texture.level_count(), 2U);
  }
  EXPECT_GT(allocations, 1);
  EXPECT_EQ(texture.level_count(), 5U);
}

/// The length that [first, first + length) and texel i have in common.
Rational overlap(const Rational& first, const Rational& length, int i) {
  const Rational end = first + length;
  const Rational begin = first < i ? Rational(i) : first;
  const Rational common = (end < i + 1 ? end : Rational(i + 1)) - begin;
  return common > 0 ? common : Rational(0);
}

/// The mean of the part of the previous level that a texel covers, rounded to nearest, halves up.
int mean_of(const Texture& texture, std::size_t level, int x, int y, std::size_t channel) {
  const int width = texture.width(level - 1);
  const int height = texture.height(level - 1);
  const Rational across = Rational(width) / texture.width(level);
  const Rational down = Rational(height) / texture.height(level);
  Rational sum = 0;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      sum += overlap(across * x, across, i) * overlap(down * y, down, j) *
             byte_at(texture, level - 1, i, j, channel);
    }
  }
  return static_cast<int>(floor_of(sum / (across * down) + Rational(1, 2)).get_si());
}

// Kills: the last texel of odd sizes left out; weights of the other end; halves rounded to even;
// sizes rounded up; levels that end when one side is 1.
TEST(Texture, LevelsAreMeansOfWhatTheyCover) {
  Random random(2);
  const std::vector<std::array<int, 2>> sizes{{8, 8}, {7, 5}, {13, 4}, {1, 9}, {3, 1}, {2, 31}};
  for (const auto& [width, height] : sizes) {
    SCOPED_TRACE(testing::Message() << width << " x " << height);
    const Texture texture = random_texture(random, width, height);
    int longer = std::max(width, height);
    std::size_t levels = 1;
    for (; longer > 1; longer /= 2) ++levels;
    ASSERT_EQ(texture.level_count(), levels);
    for (std::size_t level = 1; level < levels; ++level) {
      ASSERT_EQ(texture.width(level), std::max(1, width >> level));
      ASSERT_EQ(texture.height(level), std::max(1, height >> level));
      for (int y = 0; y < texture.height(level); ++y) {
        for (int x = 0; x < texture.width(level); ++x) {
          for (std::size_t k = 0; k < 4; ++k) {
            ASSERT_EQ(byte_at(texture, level, x, y, k), mean_of(texture, level, x, y, k))
                << level << ": " << x << ", " << y;
          }
        }
      }
    }
  }
}

// Kills: a level made of the first texel only; halves rounded down.
TEST(Texture, LevelsByHand) {
  // Red is 0, 1, 2; green is 0, 0, 4; blue is 5; alpha is 0, 0, 1.
  const std::array<std::uint8_t, 12> row{0, 0, 5, 0, 1, 0, 5, 0, 2, 4, 5, 1};
  const Texture three = made(3, 1, row);
  EXPECT_EQ(three.texels(1)[0], 0x00050101U);  // 1, 4/3, 5, 1/3
  const Texture two = made(2, 1, std::span(row).subspan(4));
  EXPECT_EQ(two.texels(1)[0], 0x01050202U);  // 1.5, 2, 5, 0.5
}

class Sampling : public testing::TestWithParam<std::int64_t> {};
INSTANTIATE_TEST_SUITE_P(AllTargets, Sampling, testing::ValuesIn(all_targets()), target_name);

/// A coordinate and the texel, of eight, that contains it.
struct Placed {
  double s;
  int texel;
};

void expect_texels(Wrap wrap, const std::vector<Placed>& all) {
  const Texture texture = numbered_texture(8, 2);
  KnownBatch known(2);
  for (std::size_t lane = 0; lane < all.size(); ++lane) {
    known.set(0, lane, all[lane].s);
    known.set(1, lane, lane % 2 == 0 ? 0.25 : 0.75);
  }
  ShadedLanes out;
  sample(texture, {wrap, Wrap::repeat, Filter::nearest}, known.batch(), 0, 1, out.colors());
  for (std::size_t lane = 0; lane < all.size(); ++lane) {
    const int row = lane % 2 == 0 ? 0 : 8;
    EXPECT_EQ(number_at(out, lane), all[lane].texel + row) << all[lane].s;
  }
}

// Kills: negative numbers rounded towards 0; a lost period; texels fetched for NaN or out of range.
TEST_P(Sampling, NearestTexelsWhenRepeated) {
  const OnTarget on_target(GetParam());
  expect_texels(Wrap::repeat, {{0, 0},         {0.124, 0},       {0.125, 1},
                               {0.999, 7},     {1, 0},           {-0.01, 7},
                               {-0.125, 7},    {-0.126, 6},      {-7.25, 6},
                               {-7.26, 5},     {1e9 + 0.625, 5}, {-1e9 - 0.0625, 7},
                               {-0x1p-60, 7},  {-0x1p-1074, 7},  {0x1.fffffffffffffp-1, 7},
                               {-1e30, 0},     {0x1p52 + 1, 0},  {1e300, 0},
                               {kInfinity, 0}, {-kInfinity, 0},  {kNaN, 0}});
}

TEST_P(Sampling, NearestTexelsWhenClamped) {
  const OnTarget on_target(GetParam());
  expect_texels(Wrap::clamp, {{-1e30, 0},
                              {-0.01, 0},
                              {-0.0, 0},
                              {0.12, 0},
                              {0.125, 1},
                              {0.874, 6},
                              {0.875, 7},
                              {1, 7},
                              {1.125, 7},
                              {1e30, 7},
                              {kInfinity, 7},
                              {-kInfinity, 0},
                              {kNaN, 0}});
}

// Kills: mirroring that begins at 0 instead of 1; borders that belong to the other texel in
// mirrored parts.
TEST_P(Sampling, NearestTexelsWhenMirrored) {
  const OnTarget on_target(GetParam());
  expect_texels(Wrap::mirror,
                {{0, 0},      {0.999, 7},      {1, 7},          {1.124, 7},     {1.125, 6},
                 {1.999, 0},  {2, 0},          {2.13, 1},       {-0.01, 0},     {-0.125, 0},
                 {-0.126, 1}, {-1, 7},         {-1.001, 7},     {-2, 0},        {-7.25, 6},
                 {-1e30, 0},  {1e9 + 1.25, 5}, {-0x1p-1074, 0}, {kInfinity, 0}, {kNaN, 0}});
}

// Kills: not asking exact arithmetic, or asking it for helpers or where double decides; a call with
// another lane, attribute or size; an answer that is wrapped in float32.
TEST_P(Sampling, DoubtsAreDecidedByExactArithmetic) {
  const OnTarget on_target(GetParam());
  const Texture texture = numbered_texture(8, 3);
  KnownBatch known(3);
  known.errors = {0, 1e-10, 1e-10};
  for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
    known.set(1, lane, 0.4);
    known.set(2, lane, 0.2);
  }
  const auto nudge = [&](std::size_t attribute, std::size_t lane, double value, double exact) {
    known.set(attribute, lane, value);
    known.exact[attribute][lane] = Rational(value) + Rational(exact);
  };
  nudge(1, 3, 0.25, -0x1p-80);       // 2 in double, 1 exactly
  nudge(1, 4, 0.25 - 1e-11, 1e-10);  // 1 in double, 2 exactly
  nudge(2, 64, 2, -1e-100);          // row 0 in double, 2 exactly
  nudge(1, 100, 0.25, -0x1p-80);     // a helper
  nudge(2, 127, 2.0 / 3, 0);         // a little less than two thirds
  nudge(1, 126, 0.25 + 2e-10, 0);    // no doubt
  known.cells[100 / 16].covered = static_cast<std::uint16_t>(~(1U << 100 % 16));
  ShadedLanes out;
  sample(texture, {Wrap::repeat, Wrap::repeat, Filter::nearest}, known.batch(), 1, 2, out.colors());
  using Call = KnownBatch::Call;
  const std::vector<Call> expected{{1, 3, 8}, {1, 4, 8}, {2, 64, 3}, {2, 127, 3}};
  EXPECT_EQ(known.calls, expected);
  EXPECT_EQ(number_at(out, 0), 3);
  EXPECT_EQ(number_at(out, 3), 1);
  EXPECT_EQ(number_at(out, 4), 2);
  EXPECT_EQ(number_at(out, 64), 2 * 8 + 3);
  EXPECT_EQ(number_at(out, 126), 2);
  EXPECT_EQ(number_at(out, 127), 8 + 3);
}

// Kills: asking exact arithmetic for every lane at the edges of a clamped texture.
TEST_P(Sampling, WhereBothSidesAreTheSameTexelThereIsNoDoubt) {
  const OnTarget on_target(GetParam());
  const Texture texture = numbered_texture(8, 1);
  KnownBatch known(2);
  known.errors = {1e-12, 1e-12};
  for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
    known.set(0, lane, static_cast<double>(lane) - 64);
    known.set(1, lane, static_cast<double>(lane));
  }
  ShadedLanes out;
  for (const Wrap wrap : {Wrap::clamp, Wrap::mirror}) {
    sample(texture, {wrap, Wrap::repeat, Filter::nearest}, known.batch(), 0, 1, out.colors());
    EXPECT_TRUE(known.calls.empty());
    EXPECT_EQ(number_at(out, 65), 7);
  }
  // With such large errors nothing is certain.
  for (const double error : {0.1, kInfinity, kNaN}) {
    known.errors[0] = error;
    known.calls.clear();
    sample(texture, {Wrap::clamp, Wrap::repeat, Filter::nearest}, known.batch(), 0, 1,
           out.colors());
    EXPECT_EQ(known.calls.size(), KnownBatch::kLanes);
  }
}

// Kills: a multiplication by a rounded 1/255.
TEST_P(Sampling, ColorsAreRoundedOnce) {
  const OnTarget on_target(GetParam());
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 1024; ++i) bytes.push_back(static_cast<std::uint8_t>(i / 4));
  const Texture texture = made(256, 1, bytes);
  for (const int first : {0, 128}) {
    KnownBatch known(2);
    for (int i = 0; i < 128; ++i) {
      known.set(0, static_cast<std::size_t>(i), (first + i + 0.5) / 256);
    }
    for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear}) {
      ShadedLanes out;
      sample(texture, {Wrap::repeat, Wrap::repeat, filter}, known.batch(), 0, 1, out.colors());
      for (int i = 0; i < 128; ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
          EXPECT_EQ(out(k, static_cast<std::size_t>(i)), static_cast<float>(first + i) / 255);
        }
      }
    }
  }
}

// Kills: texels of the far side beyond an edge that does not repeat; texels of the edge itself
// beyond one that repeats.
TEST_P(Sampling, BilinearByHand) {
  const OnTarget on_target(GetParam());
  const std::array<std::uint8_t, 8> bytes{0, 0, 0, 0, 255, 255, 255, 255};
  const Texture texture = made(2, 1, bytes);
  KnownBatch known(2);
  const std::vector<double> s{0, 0.25, 0.375, 0.5, 0.75, 1, -0.125, 1.125, kInfinity, kNaN, -1e30};
  for (std::size_t i = 0; i < s.size(); ++i) known.set(0, i, s[i]);
  const auto expect_reds = [&](Wrap wrap, const std::vector<float>& reds) {
    ShadedLanes out;
    sample(texture, {wrap, Wrap::repeat, Filter::bilinear}, known.batch(), 0, 1, out.colors());
    for (std::size_t i = 0; i < s.size(); ++i) EXPECT_EQ(out(0, i), reds[i]) << s[i];
  };
  expect_reds(Wrap::repeat, {0.5F, 0, 0.25F, 0.5F, 1, 0.5F, 0.75F, 0.25F, 0.5F, 0.5F, 0.5F});
  expect_reds(Wrap::clamp, {0, 0, 0.25F, 0.5F, 1, 1, 0, 1, 1, 0, 0});
  expect_reds(Wrap::mirror, {0, 0, 0.25F, 0.5F, 1, 1, 0, 1, 0, 0, 0});
}

// Kills: levels off by one at powers of two; smaller levels for a magnified texture; lengths that
// overflow or are NaN.
TEST_P(Sampling, LevelsOfDetailByHand) {
  const OnTarget on_target(GetParam());
  // The first column is white, so that the first texel is darker in each further level.
  std::vector<std::uint8_t> bytes(16 * 4 * 4);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = i / 4 % 16 == 0 ? 255 : 0;
  const Texture texture = made(16, 4, bytes);
  KnownBatch known(2);
  const auto red = [&](double s_u, double s_v, double t_u, double t_v) {
    known.set_slopes(0, s_u, s_v);
    known.set_slopes(1, t_u, t_v);
    ShadedLanes out;
    sample(texture, {Wrap::clamp, Wrap::clamp, Filter::trilinear}, known.batch(), 0, 1,
           out.colors());
    for (std::size_t lane = 1; lane < KnownBatch::kLanes; ++lane) {
      EXPECT_EQ(out(0, lane), out(0, 0));
    }
    return out(0, 0);
  };
  const std::array<float, 5> levels{1, 128 / 255.0F, 64 / 255.0F, 32 / 255.0F, 16 / 255.0F};
  EXPECT_EQ(red(0, 0, 0, 0), levels[0]);
  EXPECT_EQ(red(1 / 16.0, 0, 0, 1 / 4.0), levels[0]);
  EXPECT_LT(red(0x1.000001p-4, 0, 0, 0), levels[0]);
  EXPECT_EQ(red(0, -2 / 16.0, 0, 0), levels[1]);
  EXPECT_EQ(red(0, 0, 1, 0), levels[2]);
  EXPECT_EQ(red(1 / 16.0, 0, 0, 8 / 4.0), levels[3]);
  EXPECT_EQ(red(1, 0, 0, 0), levels[4]);
  EXPECT_EQ(red(100, 3, 2, 1), levels[4]);
  // A length of √2 texels gives half a level.
  EXPECT_NEAR(red(1 / 16.0, 0, 1 / 4.0, 0), 191.5F / 255, 1e-6F);
  EXPECT_NEAR(red(3 / 16.0, 0, 0, 0), (128 - 64 * (std::log2(3.0) - 1)) / 255, 1e-6);
  EXPECT_EQ(red(1e300, 0, 0, 0), levels[4]);
  EXPECT_EQ(red(kInfinity, 0, 0, 0), levels[4]);
  EXPECT_EQ(red(1e-300, 1e-300, 0, 0), levels[0]);
  EXPECT_EQ(red(kNaN, kNaN, kNaN, kNaN), levels[0]);
  EXPECT_EQ(red(kNaN, 2 / 16.0, 0, 0), levels[1]);
}

}  // namespace
}  // namespace rastercheck::rasterizer::texture_test
