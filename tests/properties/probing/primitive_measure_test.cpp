// A probe says which samples lines and points cover and how their sizes are rounded: of `cpu`, and
// of backends that draw something else than a case asks for.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "properties/probing/measures.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/probing/probe_rows.h"

namespace rastercheck::properties::primitive_measure_test {
namespace {

using cases::LineMode;
using cases::Primitive;

/// Draws another case than the one asked for.
class Instead : public DamagedBackend {
 public:
  explicit Instead(std::function<void(cases::Case&)> change, Damage damage = {})
      : DamagedBackend(std::move(damage), "cpu"), change_(std::move(change)) {}

 protected:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    cases::Case changed = c;
    change_(changed);
    return DamagedBackend::draw_fragments(changed);
  }

 private:
  std::function<void(cases::Case&)> change_;
};

records::Probe measured_of(backends::Backend& backend) {
  Subject subject("own", backend, {});
  EXPECT_TRUE(subject.choose_rules().has_value());
  measure_primitives(subject);
  return subject.result;
}

records::Probe measured_with(const std::function<void(cases::Case&)>& change) {
  Instead backend(change);
  return measured_of(backend);
}

TEST(Primitives, OfCpuAreAsAskedFor) {
  const records::Probe probe = measured_with([](cases::Case&) {});
  EXPECT_EQ(measured(probe, "lines as rectangles"), "rectangles");
  EXPECT_EQ(measured(probe, "lines as parallelograms"), "parallelograms");
  EXPECT_EQ(measured(probe, "lines as diamonds"), "diamonds");
  EXPECT_EQ(row(probe, "lines as diamonds").detail, "60 of 60 lines to the pixel");
  EXPECT_EQ(measured(probe, "widths of rectangles"), "as asked for");
  EXPECT_EQ(measured(probe, "widths of diamonds"), "rounded to whole pixels");
  EXPECT_EQ(measured(probe, "pixel of a line's first end"), "drawn");
  EXPECT_EQ(measured(probe, "pixel of a line's second end"), "left out");
  EXPECT_EQ(measured(probe, "points"), "squares");
  EXPECT_EQ(measured(probe, "sizes of points"), "as asked for");
  EXPECT_THAT(against(probe), testing::IsEmpty());
}

TEST(Primitives, OfAnotherModeAreNamed) {
  const records::Probe probe =
      measured_with([](cases::Case& c) { c.line_mode = LineMode::bresenham; });
  EXPECT_EQ(measured(probe, "lines as rectangles"), "diamonds");
  EXPECT_EQ(measured(probe, "widths of rectangles"), "rounded to whole pixels");
}

TEST(Primitives, ThatDrawTheLastPixelAreToldByTheirEnds) {
  const records::Probe probe = measured_with([](cases::Case& c) {
    if (c.primitive != Primitive::lines || c.line_mode != LineMode::bresenham) return;
    for (cases::Triangle& line : c.triangles) line = {line[1], line[0], line[0]};
  });
  EXPECT_THAT(measured(probe, "lines as diamonds"), testing::StartsWith("nearest to"));
  EXPECT_EQ(measured(probe, "pixel of a line's first end"), "left out");
  EXPECT_EQ(measured(probe, "pixel of a line's second end"), "drawn");
}

TEST(Primitives, OfWholeSizesAreRounded) {
  const records::Probe probe = measured_with(
      [](cases::Case& c) { c.point_size = std::max(1.0F, std::floor(c.point_size + 0.5F)); });
  EXPECT_EQ(measured(probe, "points"), "squares");
  EXPECT_EQ(measured(probe, "sizes of points"), "rounded to whole pixels");
}

TEST(Primitives, OfBackendsWithoutThemAreNotMeasured) {
  DamagedBackend backend;
  EXPECT_TRUE(measured_of(backend).rows.empty());
}

}  // namespace
}  // namespace rastercheck::properties::primitive_measure_test
