// A grid is named only where it explains what is drawn: rasterizers on no grid, moved ones and ones
// on grids that are no power of two are not given the nearest one.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <variant>

#include "properties/probing/measures.h"
#include "properties/probing/probe.h"
#include "tests/properties/probing/bent.h"

namespace rastercheck::properties::grid_test {
namespace {

using cases::Case;
using cases::ClipVertex;
using cases::Fragments;
using ::testing::HasSubstr;
using ::testing::StartsWith;

GridFit fit_of(backends::Backend& backend) {
  Subject subject("bent", backend, {});
  EXPECT_TRUE(subject.choose_rules().has_value());
  return fit_grid(subject, draw_grid_cases(subject));
}

/// `cpu` without a grid, with each window coordinate changed, in a viewport of 64×64 pixels.
Bending placing(std::function<double(double pixels)> x, std::function<double(double pixels)> y) {
  Bending bending;
  bending.before = [x = std::move(x), y = std::move(y)](Case c) {
    c.coverage.reset();
    for (ClipVertex& p : c.positions) {
      const auto changed = [&p](float& number, const std::function<double(double)>& change) {
        const double pixels = (double{number} / double{p.w} + 1) * 32;
        number = static_cast<float>((change(pixels) / 32 - 1) * double{p.w});
      };
      changed(p.x, x);
      changed(p.y, y);
    }
    return c;
  };
  return bending;
}
Bending placing(const std::function<double(double pixels)>& both) { return placing(both, both); }

std::function<double(double)> nearest_of(double points) {
  return [points](double pixels) { return std::nearbyint(pixels * points) / points; };
}
std::function<double(double)> floor_of(double points) {
  return [points](double pixels) { return std::floor(pixels * points) / points; };
}
std::function<double(double)> ceil_of(double points) {
  return [points](double pixels) { return std::ceil(pixels * points) / points; };
}
std::function<double(double)> moved_by(double move) {
  return [move](double pixels) { return pixels + move; };
}

struct Placing {
  const char* name;
  Bending bending;
  const char* text;
};
std::ostream& operator<<(std::ostream& stream, const Placing& placing) {
  return stream << placing.name;
}

class GridOf : public ::testing::TestWithParam<Placing> {};

TEST_P(GridOf, IsNotGuessed) {
  Bent backend(GetParam().bending);
  EXPECT_THAT(to_string(fit_of(backend)), StartsWith(GetParam().text));
}

INSTANTIATE_TEST_SUITE_P(
    All, GridOf,
    ::testing::Values(
        Placing{"none", placing(moved_by(0)), "none: positions are not rounded"},
        Placing{"none, moved by 1/64", placing(moved_by(1.0 / 64)),
                "none: positions are not rounded, but moved by (0.0156, 0.0156) pixels"},
        Placing{"none, moved in y", placing(moved_by(0), moved_by(-1.0 / 100)),
                "none: positions are not rounded, but moved by (0, -0.01) pixels"},
        Placing{"none, moved by 1/512", placing(moved_by(1.0 / 512)),
                "none: positions are not rounded, but moved by (0.00195, 0.00195) pixels"},
        Placing{"12 points a pixel", placing(nearest_of(12)), "1/12 pixel, nearest_even"},
        Placing{"10 points a pixel", placing(ceil_of(10)), "1/10 pixel, up"},
        Placing{"100 points a pixel", placing(nearest_of(100)), "1/100 pixel, nearest_even"},
        Placing{"3 points a pixel", placing(floor_of(3)), "1/3 pixel, down"},
        Placing{"255 points a pixel", placing(nearest_of(255)),
                "none of the grids 2^-0 to 2^-16, or of most others to 1/1024, explains it"},
        Placing{"16, nearest", placing(nearest_of(16)), "4 bits, nearest_even"},
        Placing{"16, floor", placing(floor_of(16)), "4 bits, down"},
        Placing{"256, floor", placing(floor_of(256)), "8 bits, down"},
        Placing{"256, floor and ceil", placing(floor_of(256), ceil_of(256)),
                "8 bits, down in x, up in y"},
        Placing{"256, moved before rounding",
                placing([](double pixels) { return std::nearbyint(pixels * 256 + 0.2) / 256; }),
                "8 bits, nearest_even, after a move by about (0.2, 0.2) grid units"},
        Placing{"2^14 points a pixel", placing(nearest_of(16384)), "14 bits, nearest_even"}));

/// Draws triangles at w = 1 with edge functions in float32, without any grid.
class FloatEdges : public backends::Backend {
 public:
  cases::Contract promise(const Case& c) const override { return cases::contract_of(c); }

 private:
  Result<Fragments> draw_fragments(const Case& c) override {
    Fragments drawn;
    for (std::uint32_t t = 0; t < c.triangles.size(); ++t) {
      std::array<float, 3> x{};
      std::array<float, 3> y{};
      for (std::size_t i = 0; i < 3; ++i) {
        const ClipVertex& p = c.positions[c.triangles[t][i]];
        x[i] = (p.x / p.w * 0.5F + 0.5F) * c.viewport.width;
        y[i] = (p.y / p.w * 0.5F + 0.5F) * c.viewport.height;
      }
      const float area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
      for (int v = 0; v < c.framebuffer.height; ++v) {
        for (int u = 0; u < c.framebuffer.width; ++u) {
          bool is_inside = area != 0;
          for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            // Not rearranged: a x + b y + c loses digits that differences would keep.
            const float a = y[i] - y[j];
            const float b = x[j] - x[i];
            const float at = x[i] * y[j] - x[j] * y[i];
            const float edge =
                a * (static_cast<float>(u) + 0.5F) + b * (static_cast<float>(v) + 0.5F) + at;
            is_inside = is_inside && (area > 0 ? edge > 0 : edge < 0);
          }
          if (!is_inside) continue;
          drawn.triangle.push_back(t);
          drawn.x.push_back(static_cast<std::uint16_t>(u));
          drawn.y.push_back(static_cast<std::uint16_t>(v));
          drawn.sample.push_back(0);
          drawn.depth.push_back(0.5F);
        }
      }
    }
    drawn.attribute_count = c.attributes.size();
    drawn.attributes.resize(drawn.size() * drawn.attribute_count);
    return drawn;
  }
};

TEST(GridOfFloatEdges, IsNone) {
  FloatEdges backend;
  const GridFit fit = fit_of(backend);
  EXPECT_THAT(to_string(fit),
              StartsWith("none: positions are not rounded; edges are off by up to"));
  EXPECT_GT(fit.mismatches, 0U);
}

TEST(GridFitOf, SaysHowSureItIs) {
  Bent backend(placing(nearest_of(16)));
  const records::Sureness sure = sureness_of(fit_of(backend));
  EXPECT_EQ(sure.unit, "samples");
  EXPECT_GT(sure.in_favour, 10000U);
  EXPECT_EQ(sure.against, 0U);
  EXPECT_GT(sure.undecided, 0U);
}

// Samples that lie elsewhere than declared are found with the grid, if they are on one of its
// points.
TEST(GridOfSamples, IsFoundWithThem) {
  const auto with_sample_at = [](const std::function<double(double)>& rounding, double place) {
    return [=](double pixels) { return rounding(pixels) + 0.5 - place; };
  };
  Bent console(placing(with_sample_at(floor_of(12), 7.0 / 12)));
  const MeasuredGrid of_console = fit_of(console).grid;
  EXPECT_EQ(of_console.steps(), 12);
  EXPECT_EQ(of_console.x, GridRounding::down);
  EXPECT_EQ(of_console.sample, (cases::PixelFraction{7, 7, 12}));

  Bent sixteenths(
      placing(with_sample_at(nearest_of(16), 5.0 / 16), with_sample_at(nearest_of(16), 11.0 / 16)));
  const MeasuredGrid of_sixteenths = fit_of(sixteenths).grid;
  EXPECT_EQ(of_sixteenths.steps(), 16);
  EXPECT_EQ(of_sixteenths.sample, (cases::PixelFraction{5, 11, 16}));
}

// A backend on no known grid gets a contract that it keeps, and no basis.
TEST(GridOf255Points, IsCoveredByThePositionError) {
  Bent backend(placing(nearest_of(255)));
  ProbeOptions options;
  options.cases = 1;
  options.asked = {cases::Coverage(), cases::Basis::ideal, cases::TieRule::top_left};
  const Result<records::Probe> result = probe("bent", backend, options, {});
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(result->rows[0].contradicts);
  EXPECT_THAT(result->rows[0].measured, HasSubstr("none of the grids"));
  const auto* coverage = std::get_if<cases::Coverage>(&*result->terms.coverage);
  ASSERT_NE(coverage, nullptr);
  ASSERT_TRUE(coverage->has_value());
  const double pixels =
      std::ldexp(double{(*coverage)->position_error}, -(*coverage)->subpixel_bits);
  EXPECT_GE(pixels, 1.0 / 512);  // a position is moved by up to 1/510
  EXPECT_EQ(result->terms.basis, cases::Term<cases::Basis>(cases::Basis::unspecified));
}

}  // namespace
}  // namespace rastercheck::properties::grid_test
