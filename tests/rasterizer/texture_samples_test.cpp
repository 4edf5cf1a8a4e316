// Samples of textures (rasterizer/texture.h), compared with exact rationals. Most tests use only
// one SIMD target, since the last test checks that all targets give the same bits.

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <optional>

#include "rasterizer/texture.h"
#include "tests/rasterizer/fragment_batch.h"
#include "tests/rasterizer/textures.h"
#include "tests/simd_targets.h"

namespace rastercheck::rasterizer::texture_samples_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// k modulo `period`, never negative.
int modulo(const mpz_class& k, int period) {
  mpz_class rest;
  mpz_fdiv_r_ui(rest.get_mpz_t(), k.get_mpz_t(), static_cast<unsigned long>(period));
  return static_cast<int>(rest.get_si());
}

int texel_of(const mpz_class& k, int size, Wrap wrap) {
  if (wrap == Wrap::repeat) return modulo(k, size);
  if (wrap == Wrap::clamp) {
    return k < 0 ? 0 : k >= size ? size - 1 : static_cast<int>(k.get_si());
  }
  const int m = modulo(k, 2 * size);
  return m < size ? m : 2 * size - 1 - m;
}

/// A random coordinate: on a border or near the centre of a texel, in the texture, or far away.
double random_coordinate(Random& random, int size) {
  const double whole = random.between(-3 * size, 4 * size);
  switch (random.between(0, 4)) {
    case 0:
      return whole / size;
    case 1:
      return (whole + 0.5) / size + random.number(20, -60, -20);
    case 2:
      return random.number(53, -20, 4);
    case 3:
      return random.number(53, 4, 40);
    default:
      return random.number(53, -1000, 120);
  }
}

constexpr std::array<Wrap, 3> kWraps{Wrap::repeat, Wrap::clamp, Wrap::mirror};
constexpr std::array<std::array<int, 2>, 8> kSizes{
    {{8, 8}, {7, 5}, {1, 1}, {16384, 1}, {1, 300}, {64, 3}, {2, 2}, {33, 31}}};

/// The greatest error that a lane's coordinate may have.
Rational error_of(const KnownBatch& known, std::size_t i, std::size_t lane) {
  const double own = FragmentBatch::kErrorShare * std::abs(known.lines[i].value[lane]);
  return Rational(std::max(known.errors[i], own));
}

/// Random coordinates with errors of up to error_of().
KnownBatch random_coordinates(Random& random, const Texture& texture) {
  KnownBatch known(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const int size = i == 0 ? texture.width() : texture.height();
    known.errors[i] = random.one_in(3) ? 0 : std::ldexp(1.0, -random.between(10, 60));
    for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
      known.set(i, lane, random_coordinate(random, size));
      known.exact[i][lane] += error_of(known, i, lane) * random.between(-8, 8) / 8;
    }
  }
  return known;
}

// Kills: a margin that is too small; rounding where numbers near 2^53 are wrapped.
TEST(Samples, AreOfTheExactTexelWhenNearest) {
  Random random(3);
  for (const auto& [width, height] : kSizes) {
    const Texture texture = random_texture(random, width, height);
    for (int i = 0; i < 27; ++i) {
      const Sampler sampler{kWraps[static_cast<std::size_t>(i % 3)],
                            kWraps[static_cast<std::size_t>(i / 3 % 3)], Filter::nearest};
      KnownBatch known = random_coordinates(random, texture);
      ShadedLanes out;
      sample(texture, sampler, known.batch(), 0, 1, out.colors());
      for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
        const mpz_class s = floor_of(known.exact[0][lane] * width);
        const mpz_class t = floor_of(known.exact[1][lane] * height);
        // Exact arithmetic returns a double, which holds at most 53 bits.
        if (mpz_sizeinbase(s.get_mpz_t(), 2) > 53 || mpz_sizeinbase(t.get_mpz_t(), 2) > 53)
          continue;
        const int x = texel_of(s, width, sampler.wrap_s);
        const int y = texel_of(t, height, sampler.wrap_t);
        for (std::size_t k = 0; k < 4; ++k) {
          const auto byte = static_cast<float>(byte_at(texture, 0, x, y, k));
          ASSERT_EQ(out(k, lane), byte / 255) << known.lines[0].value[lane];
        }
      }
    }
  }
}

/// The wrapped coordinate (texture.h).
Rational wrapped(const Rational& s, Wrap wrap) {
  if (wrap == Wrap::repeat) return s - floor_of(s);
  if (wrap == Wrap::clamp) return s < 0 ? Rational(0) : s > 1 ? Rational(1) : s;
  const Rational m = s - 2 * floor_of(s / 2);
  return m < 1 ? m : 2 - m;
}

/// The two neighbouring texels along an axis, and the position between them.
struct Along {
  std::array<int, 2> texels;
  Rational fraction;
};

Along along(const Rational& s, int size, Wrap wrap) {
  const Rational x = wrapped(s, wrap) * size - Rational(1, 2);
  const mpz_class low = floor_of(x);
  const Wrap beyond = wrap == Wrap::repeat ? wrap : Wrap::clamp;
  return {{texel_of(low, size, beyond), texel_of(low + 1, size, beyond)}, x - low};
}

using Colors = std::array<Rational, 4>;

Colors bilinear(const Texture& texture, std::size_t level, const Sampler& sampler,
                const KnownBatch& known, std::size_t lane) {
  const Along s = along(known.exact[0][lane], texture.width(level), sampler.wrap_s);
  const Along t = along(known.exact[1][lane], texture.height(level), sampler.wrap_t);
  Colors colors;
  for (std::size_t y = 0; y < 2; ++y) {
    for (std::size_t x = 0; x < 2; ++x) {
      const Rational along_s = x == 0 ? Rational(1 - s.fraction) : s.fraction;
      const Rational along_t = y == 0 ? Rational(1 - t.fraction) : t.fraction;
      const Rational share = along_s * along_t / 255;
      for (std::size_t k = 0; k < 4; ++k) {
        colors[k] += share * byte_at(texture, level, s.texels[x], t.texels[y], k);
      }
    }
  }
  return colors;
}

void expect_within(const ShadedLanes& out, std::size_t lane, const Colors& expected,
                   const Rational& most) {
  for (std::size_t k = 0; k < 4; ++k) {
    const float color = out(k, lane);
    ASSERT_TRUE(color >= 0 && color <= 1);
    ASSERT_LE(abs(Rational(color) - expected[k]), most) << lane << ": " << color;
  }
}

/// The greatest error that bilinear and trilinear colours may have (texture.h).
Rational bound(const Texture& texture, const KnownBatch& known, std::size_t lane, int units) {
  const Rational s = error_of(known, 0, lane) + power_of_two(-51);
  const Rational t = error_of(known, 1, lane) + power_of_two(-51);
  return texture.width() * s + texture.height() * t + units * power_of_two(-24);
}

// Kills: fractions rounded before the wrap; neighbours beyond an edge; texel centres at whole
// numbers.
TEST(Samples, AreWithinTheirBoundWhenBilinear) {
  Random random(4);
  for (const auto& [width, height] : kSizes) {
    SCOPED_TRACE(testing::Message() << width << " x " << height);
    const Texture texture = random_texture(random, width, height);
    for (int i = 0; i < 9; ++i) {
      const Sampler sampler{kWraps[static_cast<std::size_t>(i % 3)],
                            kWraps[static_cast<std::size_t>(i / 3)], Filter::bilinear};
      KnownBatch known = random_coordinates(random, texture);
      ShadedLanes out;
      sample(texture, sampler, known.batch(), 0, 1, out.colors());
      EXPECT_TRUE(known.calls.empty());
      for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
        expect_within(out, lane, bilinear(texture, 0, sampler, known, lane),
                      bound(texture, known, lane, 6));
        if (HasFatalFailure()) return;
      }
    }
  }
}

/// λ in long double, from the derivatives as they are given.
Rational level_of_detail(const Texture& texture, const KnownBatch& known, std::size_t lane) {
  const auto length = [&](double s, double t) {
    return std::hypot(static_cast<long double>(s) * texture.width(),
                      static_cast<long double>(t) * texture.height());
  };
  const KnownBatch::Line& s = known.lines[0];
  const KnownBatch::Line& t = known.lines[1];
  const long double rho =
      std::max(length(s.along_u[lane], t.along_u[lane]), length(s.along_v[lane], t.along_v[lane]));
  const long double lambda =
      std::clamp(std::log2(rho), 0.0L, static_cast<long double>(texture.level_count() - 1));
  const auto high = static_cast<double>(lambda);
  return Rational(high) + Rational(static_cast<double>(lambda - high));
}

Colors trilinear(const Texture& texture, const Sampler& sampler, const KnownBatch& known,
                 std::size_t lane) {
  const Rational lambda = level_of_detail(texture, known, lane);
  const auto level = static_cast<std::size_t>(floor_of(lambda).get_si());
  const Rational fraction = lambda - static_cast<int>(level);
  Colors colors = bilinear(texture, level, sampler, known, lane);
  if (fraction == 0) return colors;
  const Colors next = bilinear(texture, level + 1, sampler, known, lane);
  for (std::size_t k = 0; k < 4; ++k) colors[k] += fraction * (next[k] - colors[k]);
  return colors;
}

/// Sets derivatives of all sizes, some of them powers of two.
void randomize_slopes(Random& random, KnownBatch& known) {
  for (KnownBatch::Line& line : known.lines) {
    for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
      line.along_u[lane] = random.number(53, -18, 3);
      line.along_v[lane] = random.number(random.one_in(2) ? 1 : 53, -18, 3);
    }
  }
}

// Kills: using the level of the shorter axis, of one direction alone, or the next level; using the
// size of another level; a series that is cut short.
TEST(Samples, AreWithinTheirBoundWhenTrilinear) {
  Random random(5);
  for (const auto& [width, height] : kSizes) {
    SCOPED_TRACE(testing::Message() << width << " x " << height);
    const Texture texture = random_texture(random, width, height);
    for (int i = 0; i < 9; ++i) {
      const Sampler sampler{kWraps[static_cast<std::size_t>(i % 3)],
                            kWraps[static_cast<std::size_t>(i / 3)], Filter::trilinear};
      KnownBatch known = random_coordinates(random, texture);
      randomize_slopes(random, known);
      ShadedLanes out;
      sample(texture, sampler, known.batch(), 0, 1, out.colors());
      for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
        expect_within(out, lane, trilinear(texture, sampler, known, lane),
                      bound(texture, known, lane, 8));
        if (HasFatalFailure()) return;
      }
    }
  }
}

bool is_covered(const KnownBatch& known, std::size_t lane) {
  const std::uint32_t covered = known.cells[lane / FragmentBatch::kCellLanes].covered;
  return (covered >> lane % FragmentBatch::kCellLanes & 1) != 0;
}

/// True if a lane's quad has a covered lane.
bool is_in_seen_quad(const KnownBatch& known, std::size_t lane) {
  return is_covered(known, lane) || is_covered(known, lane ^ 1) || is_covered(known, lane ^ 8) ||
         is_covered(known, lane ^ 9);
}

void randomize_coverage(Random& random, KnownBatch& known) {
  for (FragmentBatch::Cell& cell : known.cells) {
    cell.covered = 0xffff;
    for (int i = random.between(0, 5); i > 0; --i) {
      cell.covered &= static_cast<std::uint16_t>(random.between(0, 0xffff));
    }
  }
}

// Kills: other quads' lanes used instead of the wanted ones; reads beyond the last texel, which
// AddressSanitizer sees on the simplest target.
TEST(Samples, OfQuadsAreThoseOfAllLanes) {
  Random random(7);
  std::size_t unseen = 0;
  for (const auto& [width, height] : kSizes) {
    const Texture texture = random_texture(random, width, height);
    for (int i = 0; i < 30; ++i) {
      KnownBatch known = random_coordinates(random, texture);
      randomize_slopes(random, known);
      const auto wrap = [&] { return kWraps[static_cast<std::size_t>(random.between(0, 2))]; };
      const Sampler sampler{wrap(), wrap(),
                            random.pick({Filter::nearest, Filter::bilinear, Filter::trilinear})};
      ShadedLanes all;
      sample(texture, sampler, known.batch(), 0, 1, all.colors());
      randomize_coverage(random, known);
      for (const std::int64_t target : all_targets()) {
        const OnTarget on_target(target);
        ShadedLanes out;
        sample(texture, sampler, known.batch(), 0, 1, out.colors());
        for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
          // The nearest texels of helpers are not decided exactly.
          const bool is_known = sampler.filter == Filter::nearest ? is_covered(known, lane)
                                                                  : is_in_seen_quad(known, lane);
          if (!is_known) ++unseen;
          for (std::size_t channel = 0; channel < 4; ++channel) {
            const float color = out(channel, lane);
            ASSERT_TRUE(is_known ? color == all(channel, lane) : color >= 0 && color <= 1);
          }
        }
      }
    }
  }
  EXPECT_GT(unseen, 1000U);
}

// Kills: products fused with sums on processors that can fuse them.
TEST(Samples, AreTheSameOnAllTargets) {
  Random random(6);
  for (const auto& [width, height] : kSizes) {
    const Texture texture = random_texture(random, width, height);
    for (int i = 0; i < 9; ++i) {
      KnownBatch known = random_coordinates(random, texture);
      randomize_slopes(random, known);
      if (i % 2 == 0) randomize_coverage(random, known);
      for (KnownBatch::Line& line : known.lines) {
        for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
          if (random.one_in(9)) line.along_v[lane] = random.pick({kNaN, kInfinity, 0.0});
          if (random.one_in(40))
            line.value[lane] = random.pick({kInfinity, kNaN, -kInfinity, -0.0});
        }
      }
      for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear}) {
        const Sampler sampler{kWraps[static_cast<std::size_t>(i % 3)],
                              kWraps[static_cast<std::size_t>(i / 3)], filter};
        std::optional<std::vector<float>> first;
        for (const std::int64_t target : all_targets()) {
          const OnTarget on_target(target);
          ShadedLanes out;
          sample(texture, sampler, known.batch(), 0, 1, out.colors());
          std::vector<float> colors;
          for (const float* of_channel : out.colors()) {
            colors.insert(colors.end(), of_channel, of_channel + KnownBatch::kLanes);
          }
          if (!first) first = colors;
          ASSERT_EQ(std::memcmp(first->data(), colors.data(), colors.size() * sizeof(float)), 0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::texture_samples_test
