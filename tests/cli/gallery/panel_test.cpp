#include "cli/gallery/internal/panel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "cli/gallery/internal/scenes.h"
#include "cli/gallery/internal/textures.h"

namespace rastercheck::gallery::panel_test {
namespace {

using reports::Color;
using reports::GalleryPicture;

constexpr Color kRed{200, 0, 0};

Shader red() {
  return [](std::uint32_t, std::span<const float>) -> std::optional<Color> { return kRed; };
}

/// A square that fills all 32 · 32 pixels; u and v run from 0 to 1 across it.
DrawnScene square(int samples = 1) {
  cases::Case scene = empty_textured_scene({32, samples});
  scene.positions = {{-1, -1, 0.5, 1}, {1, -1, 0.5, 1}, {1, 1, 0.5, 1}, {-1, 1, 0.5, 1}};
  scene.attribute_values = {0, 0, 1, 0, 1, 1, 0, 1};
  scene.triangles = {{0, 1, 2}, {0, 2, 3}};
  return draw_by("cpu", scene).value();
}

GalleryPicture picture_of(const DrawnScene& drawn, const Shader& shader = red(),
                          const ErrorUnit& unit = in_texels()) {
  return judged_picture(drawn, shader, unit).value();
}

std::size_t fragment_at(const DrawnScene& drawn, int x, int y) {
  std::size_t i = 0;
  while (drawn.fragments.x[i] != x || drawn.fragments.y[i] != y) ++i;
  return i;
}

TEST(JudgedPicture, ShowsWhatIsExactWithoutErrors) {
  const GalleryPicture picture = picture_of(square());
  EXPECT_EQ(picture.worst, 0);
  EXPECT_EQ(picture.samples, 1024U);
  EXPECT_EQ(picture.violations, 0U);
  EXPECT_EQ(picture.picture, reports::Image::filled(32, 32, kRed));
  EXPECT_EQ(picture.errors, reports::Image::filled(32, 32, reports::texel_scale().ramp.front()));
}

/// Relative slack: errors are reported by their certified upper ends.
constexpr double kAbove = 1e-9;

// 3/256 is three texels and, for values up to 1, 3/256 / 2^-23 = 98304 scale ULP. Kills: units of
// another scale; the size of another texture.
TEST(JudgedPicture, MeasuresErrorsInItsUnit) {
  DrawnScene drawn = square();
  const std::size_t at = fragment_at(drawn, 5, 9);
  drawn.fragments.attributes[2 * at + 1] += 3.0F / 256;
  EXPECT_NEAR(picture_of(drawn).worst, 3, kAbove);
  EXPECT_EQ(picture_of(drawn).p99, 0);
  EXPECT_EQ(picture_of(drawn).errors.at(5, 9), reports::error_color(reports::texel_scale(), 3));
  EXPECT_NEAR(picture_of(drawn, red(), in_ulp()).worst, 98304, 98304 * kAbove);
  EXPECT_NEAR(picture_of(drawn, red(), in_levels()).worst, 3 * 255.0 / 256, kAbove);
}

// Kills: violations that are neither counted nor shown.
TEST(JudgedPicture, ShowsWhatIsMissing) {
  DrawnScene drawn = square();
  const auto at = static_cast<std::ptrdiff_t>(fragment_at(drawn, 20, 3));
  cases::Fragments& f = drawn.fragments;
  f.triangle.erase(f.triangle.begin() + at);
  f.x.erase(f.x.begin() + at);
  f.y.erase(f.y.begin() + at);
  f.sample.erase(f.sample.begin() + at);
  f.depth.erase(f.depth.begin() + at);
  f.attributes.erase(f.attributes.begin() + 2 * at, f.attributes.begin() + 2 * at + 2);
  const GalleryPicture picture = picture_of(drawn);
  EXPECT_EQ(picture.violations, 1U);
  EXPECT_EQ(picture.samples, 1023U);
  EXPECT_EQ(picture.errors.at(20, 3), reports::texel_scale().violated);
  EXPECT_EQ(picture.picture.at(20, 3), reports::kUndrawn);
}

// MIT 6.837 2000, lecture 18, slide 19. Kills: depth written by fragments that are not drawn;
// errors of fragments that are not visible.
TEST(JudgedPicture, LeavesWhatIsBehindATransparentFragment) {
  cases::Case scene = empty_textured_scene({32, 1});
  for (const float z : {0.25F, 0.75F}) {
    scene.positions.insert(scene.positions.end(), {{-1, -1, z, 1}, {3, -1, z, 1}, {-1, 3, z, 1}});
    scene.attribute_values.insert(scene.attribute_values.end(), {0, 0, 2, 0, 0, 2});
  }
  scene.triangles = {{0, 1, 2}, {3, 4, 5}};
  DrawnScene drawn = draw_by("cpu", scene).value();
  const Shader holes = [](std::uint32_t triangle, std::span<const float> uv) {
    const bool is_hole = triangle == 0 && uv[0] < 0.5F;
    return is_hole ? std::nullopt : std::optional<Color>(triangle == 0 ? kRed : Color{0, 0, 200});
  };
  drawn.fragments.attributes[2 * fragment_at(drawn, 3, 3) + 1] += 0.125F;    // in a hole
  drawn.fragments.attributes[2 * fragment_at(drawn, 30, 3) + 1] += 0.0625F;  // not in one
  const GalleryPicture picture = picture_of(drawn, holes);
  EXPECT_EQ(picture.picture.at(3, 3), (Color{0, 0, 200}));
  EXPECT_EQ(picture.picture.at(30, 3), kRed);
  EXPECT_NEAR(picture.worst, 16, 16 * kAbove);
  EXPECT_EQ(picture.samples, 1024U);
}

// A pixel of two reds and two blanks: √((200² + 242²)/2) = 222, √(242²/2) = 171, √(238²/2) = 168.
TEST(JudgedPicture, MixesTheLightOfItsSamples) {
  const Shader halves = [](std::uint32_t, std::span<const float> uv) {
    const float x = uv[0] * 32;
    return x - std::floor(x) < 0.5F ? std::optional<Color>(kRed) : std::nullopt;
  };
  EXPECT_EQ(picture_of(square(4), halves).picture.at(7, 7), (Color{222, 171, 168}));
}

TEST(DrawBy, SaysWhichMethodIsMissing) {
  const DrawnScene drawn = draw_by("method:no-such", square().scene).value();
  EXPECT_EQ(drawn.missing, "method:no-such is not in this version");
  EXPECT_EQ(picture_of(drawn).missing, drawn.missing);
}

TEST(StripOf, PutsFramesSideBySide) {
  GalleryPicture a = picture_of(square());
  GalleryPicture b = a;
  b.worst = 7;
  b.picture = reports::Image::filled(32, 32, {1, 2, 3});
  const GalleryPicture strip = strip_of(std::array{a, b});
  EXPECT_EQ(strip.frames, 2);
  EXPECT_EQ(strip.worst, 7);
  EXPECT_EQ(strip.samples, 2048U);
  EXPECT_EQ(strip.picture.width, 64);
  EXPECT_EQ(strip.picture.at(31, 0), kRed);
  EXPECT_EQ(strip.picture.at(32, 0), (Color{1, 2, 3}));
}

// Kills: a texture that is mirrored below 0; a texture that starts again at 1 − 2^-24.
TEST(Tiles, RepeatBelowZeroAndFarAway) {
  const Shader tile = tiles();
  for (const float u : {0.05F, 0.35F, 0.7F, 0.97F}) {
    for (const float v : {0.1F, 0.6F}) {
      const auto color = tile(0, std::array{u, v});
      EXPECT_EQ(tile(0, std::array{u - 1, v + 1}), color) << u;
      EXPECT_EQ(tile(0, std::array{u + 3, v - 2}), color) << u;
    }
  }
  EXPECT_EQ(tile(0, std::array{-0x1p-30F, 0.5F}), tile(0, std::array{0.999F, 0.5F}));
}

}  // namespace
}  // namespace rastercheck::gallery::panel_test
