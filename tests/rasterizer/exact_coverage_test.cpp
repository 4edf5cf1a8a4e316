// Compares the coverage and values of random draws with rational arithmetic.

#include "rasterizer/internal/exact_coverage.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <ios>
#include <sstream>
#include <string>

#include "rasterizer/internal/fragment_drawing.h"
#include "tests/rasterizer/brute_force.h"
#include "tests/rasterizer/random_draw.h"

namespace rastercheck::rasterizer::exact_coverage_test {
namespace {

/// The numbers of the draw, for the message of a failure.
std::string described(const RandomDraw& draw) {
  std::ostringstream text;
  const Viewport& viewport = draw.state.viewport;
  text << std::hexfloat << "target " << draw.size.width << " x " << draw.size.height << " x "
       << draw.size.samples << ", viewport " << viewport.origin.x << ", " << viewport.origin.y
       << ", " << viewport.size.x << ", " << viewport.size.y << ", convention "
       << static_cast<int>(draw.state.convention) << ", rule "
       << static_cast<int>(draw.state.fill_rule) << ", clamp " << draw.state.depth_clamp;
  for (const glm::vec4& p : draw.mesh.positions) {
    text << "\n  " << p.x << ", " << p.y << ", " << p.z << ", " << p.w;
  }
  for (const float d : draw.mesh.clip_distances) text << "\n  distance " << d;
  return text.str();
}

/// Checks |value − exact| in units of the last place of the larger of |exact| and `scale`; an exact
/// value beyond the floats must have become infinite.
::testing::AssertionResult is_within_bound(float value, const Rational& exact, Rational scale) {
  const Rational size = abs(exact);
  if (scale < size) scale = size;
  const Rational beyond = power_of_two(128) - power_of_two(103);
  if (std::isinf(value) || size >= beyond) {
    if (std::isinf(value) && size >= beyond && (value > 0) == (exact > 0)) {
      return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << value << " for " << exact.get_d();
  }
  if (std::isnan(value)) return ::testing::AssertionFailure() << "not a number";
  const Rational error = abs(Rational(value) - exact) / float_ulp(scale);
  if (error <= Rational(kValueBound)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << value << " for " << exact.get_d() << ", off by " << error.get_d();
}

/// Compares one draw with its definition, fragment by fragment.
class Comparison {
 public:
  explicit Comparison(const RandomDraw& draw)
      : draw_(draw),
        exact_(draw.state, draw.mesh, draw.mesh.triangles[0]),
        pattern_(brute_force_pattern(draw.size.samples)) {
    counts_ = draw_mesh(draw.state, draw.mesh.mesh(), draw.size, fragments_);
  }

  /// Returns the number of fragments that were compared.
  std::size_t run() {
    EXPECT_EQ(counts_.discarded_degenerate, exact_.is_degenerate() ? 1U : 0U);
    const bool is_visible = !exact_.is_degenerate() && !exact_.is_culled();
    for (int y = 0; y < draw_.size.height && is_visible; ++y) {
      for (int x = 0; x < draw_.size.width; ++x) compare_pixel(x, y);
    }
    EXPECT_EQ(next_, fragments_.size());
    return next_;
  }

 private:
  bool is_in_scissor(int x, int y) const {
    const Rectangle& scissor = draw_.state.scissor;
    return scissor.origin.x <= x && x < scissor.origin.x + scissor.size.x &&
           scissor.origin.y <= y && y < scissor.origin.y + scissor.size.y;
  }

  void compare_pixel(int x, int y) {
    std::vector<std::size_t> covered;
    for (std::size_t s = 0; s < pattern_.size() && is_in_scissor(x, y); ++s) {
      if (exact_.covers(x + pattern_[s][0], y + pattern_[s][1])) covered.push_back(s);
    }
    for (const std::size_t s : covered) {
      ASSERT_LT(next_, fragments_.size()) << "not drawn: " << x << ", " << y << ", sample " << s;
      ASSERT_EQ(fragments_.x[next_], x);
      ASSERT_EQ(fragments_.y[next_], y);
      ASSERT_EQ(fragments_.sample[next_], s);
      compare_values(x, y, s, covered);
      ++next_;
    }
  }

  void compare_values(int x, int y, std::size_t s, const std::vector<std::size_t>& covered) {
    const Viewport& viewport = draw_.state.viewport;
    EXPECT_TRUE(is_within_bound(fragments_.depth[next_],
                                exact_.depth(x + pattern_[s][0], y + pattern_[s][1]),
                                std::max(viewport.min_depth, viewport.max_depth)))
        << "depth at " << x << ", " << y;
    const std::size_t attributes = draw_.state.attributes.size();
    for (std::size_t a = 0; a < attributes; ++a) {
      const Qualifier& qualifier = draw_.state.attributes[a];
      std::array<Rational, 2> at = pattern_[s];
      const bool at_center =
          qualifier.location == Location::center ||
          (qualifier.location == Location::centroid && covered.size() == pattern_.size());
      if (at_center) {
        at = {Rational(1) / 2, Rational(1) / 2};
      } else if (qualifier.location == Location::centroid) {
        at = pattern_[covered[0]];
      }
      const Rational u = x + at[0];
      const Rational v = y + at[1];
      const bool is_undefined =
          qualifier.interpolation == Interpolation::smooth && exact_.reciprocal_w(u, v) <= 0;
      if (is_undefined) continue;
      EXPECT_TRUE(is_within_bound(fragments_.attributes[next_ * attributes + a],
                                  exact_.attribute(a, u, v), exact_.scale(a)))
          << "attribute " << a << " at " << x << ", " << y;
    }
  }

  const RandomDraw& draw_;
  BruteForce exact_;
  std::vector<std::array<Rational, 2>> pattern_;
  Fragments fragments_;
  DrawCounts counts_;
  std::size_t next_ = 0;
};

// Kills: any fault that draws one sample too many or too few, or a value that is too far off: a
// band that is too narrow, a certificate that is too generous, a pixel cut off a row, a tie decided
// by the wrong axis.
TEST(ExactDraw, DrawsWhatRationalArithmeticSays) {
  Random random(20);
  std::size_t fragments = 0;
  for (int i = 0; i < 6'000 && !::testing::Test::HasFailure(); ++i) {
    const RandomDraw draw = random_draw(random);
    SCOPED_TRACE(described(draw));
    fragments += Comparison(draw).run();
  }
  EXPECT_GT(fragments, 10'000U);
}

/// An edge that runs almost along the sample centres of row 2, from a corner on the centres to one
/// 2^40 windows away: the whole row is within the edge's band, and half of it is inside.
RandomDraw along_a_row(Random& random) {
  RandomDraw draw;
  draw.size = {32, 4, 1};
  draw.state = small_state(32, 4);
  if (random.one_in(3)) draw.state.viewport.origin.x = 0.1F;
  draw.state.attributes.resize(1);
  draw.mesh.attributes = {1, 2, 4};
  draw.mesh.triangles = {{0, 1, 2}};
  const float far = random.real(35, 45);
  const auto w = static_cast<float>(std::abs(random.number(22, 0, 1)));
  const auto next = static_cast<float>(std::abs(random.number(22, 0, 1)));
  const float up = random.one_in(2) ? 1.0F : 0.0F;
  draw.mesh.positions = {{random.real(-3, -1), w / 4, 0, w},
                         {far, std::nextafter(next / 4, up), 0, next},
                         {0, random.pick({3.0F, -3.0F}), 0, 1}};
  return draw;
}

// Kills: the pixels of a row found from the edge's crossing without its band.
TEST(ExactDraw, DrawsEdgesThatHardlyLeaveARow) {
  Random random(21);
  std::size_t fragments = 0;
  for (int i = 0; i < 300 && !::testing::Test::HasFailure(); ++i) {
    const RandomDraw draw = along_a_row(random);
    SCOPED_TRACE(described(draw));
    fragments += Comparison(draw).run();
  }
  EXPECT_GT(fragments, 5'000U);
}

// A viewport whose numbers double rounds must not cost a draw of every pixel for every triangle.
TEST(ExactCoverage, BoundsTrianglesInEveryViewport) {
  for (const glm::vec2 size : {glm::vec2{1000, 1000}, glm::vec2{1000.1F, 999.7F}}) {
    State state;
    state.viewport.origin = {0.3F, 0.7F};
    state.viewport.size = size;
    const DrawSetting setting(state, {1024, 1024, 1});
    ExactCoverage coverage(setting);
    InputTriangle triangle;
    triangle.positions = {glm::vec4{0, 0, 0, 1}, glm::vec4{0.01F, 0, 0, 1},
                          glm::vec4{0, 0.02F, 0, 1}};
    ASSERT_EQ(coverage.locate(triangle), Fate::drawn);
    // From 500.3 to 505.3 and from 500.7 to 510.7, with at most a pixel more on each side.
    EXPECT_GE(coverage.box().columns.begin, 498);
    EXPECT_LE(coverage.box().columns.end, 508);
    EXPECT_GE(coverage.box().rows.begin, 498);
    EXPECT_LE(coverage.box().rows.end, 513);
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::exact_coverage_test
