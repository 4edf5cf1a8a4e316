#include "properties/probing/picture_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

constexpr std::size_t kCellsPerRow = 16;
constexpr std::size_t kCellSide = 4;  // pixels
constexpr float kCellDepth = 0.5F;
constexpr float kClearDepth = 1;

std::size_t sample_index(const cases::Picture& picture, std::size_t x, std::size_t y,
                         std::size_t sample) {
  const std::size_t pixel = y * static_cast<std::size_t>(picture.size.width) + x;
  return pixel * static_cast<std::size_t>(picture.size.samples) + sample;
}

}  // namespace

cases::Case case_without_cells(const Subject& subject, int samples) {
  cases::Case c = subject.base();
  c.framebuffer.samples = samples;
  for (const char* name : {"red", "green", "blue", "alpha"}) c.attributes.push_back({.name = name});
  return c;
}

void add_cell(cases::Case& c, std::size_t cell, const std::array<CellColor, 3>& colors) {
  const std::size_t row = cell / kCellsPerRow;
  constexpr auto side = static_cast<double>(kCellSide);
  const double u = side * static_cast<double>(cell % kCellsPerRow);
  const double v = side * static_cast<double>(row);
  const auto at = [&c](double x, double y) { return at_window(c, {x, y}, kCellDepth, 1); };
  add_triangle(c, at(u, v), at(u + side, v), at(u, v + side));
  for (const CellColor& color : colors) {
    c.attribute_values.insert(c.attribute_values.end(), color.begin(), color.end());
  }
}

cases::Case case_of_cells(const Subject& subject, const std::vector<CellColor>& colors) {
  cases::Case c = case_without_cells(subject);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    add_cell(c, i, {colors[i], colors[i], colors[i]});
  }
  return c;
}

cases::Pipeline plain_pipeline(cases::ColorFormat format) {
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::always;
  pipeline.clear_depth = kClearDepth;
  pipeline.format = format;
  return pipeline;
}

bool is_drawn(const cases::Picture& picture, std::size_t x, std::size_t y, std::size_t sample) {
  return picture.depth[sample_index(picture, x, y, sample)] != kClearDepth;
}

float color_at(const cases::Picture& picture, std::size_t x, std::size_t y, std::size_t channel,
               std::size_t sample) {
  return picture.color[sample_index(picture, x, y, sample) * picture.channels + channel];
}

// A sample of pixel (1, 1) of a cell has coordinates from 1 to below 2, and the triangle ends where
// their sum is 4.
CellPixel pixel_of_cell(std::size_t cell) {
  return {cell % kCellsPerRow * kCellSide + 1, cell / kCellsPerRow * kCellSide + 1};
}

std::optional<cases::PictureBounds> declared_bounds(Subject& subject, const cases::Case& c) {
  return subject.backend().promise(c).picture_bounds;
}

void ErrorRange::add(double error) {
  if (std::isnan(error)) {
    *this = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    return;
  }
  least = std::min(least, error);
  greatest = std::max(greatest, error);
}

double ErrorRange::reach() const { return std::max(std::fabs(least), greatest); }

std::optional<std::string> rounding_words(const ErrorRange& errors, double slack) {
  if (errors.reach() <= 0.5 + slack) return "the nearest";
  if (errors.reach() >= 1) return std::nullopt;
  if (errors.greatest <= slack) return "the lower neighbour";
  if (errors.least >= -slack) return "the upper neighbour";
  return "either neighbour";
}

std::string step_words(double steps) {
  return fmt::format("{:.3g} {}", steps, steps == 1 ? "step" : "steps");
}

bool is_within(float drawn, double exact, double slack) {
  return static_cast<float>(exact - slack) <= drawn && drawn <= static_cast<float>(exact + slack);
}

double float_slack(const cases::PictureBounds& bounds, double size) {
  if (bounds.float_error == 0) return 0;
  // A driver may take numbers below the least normal float for 0.
  return double{bounds.float_error} * kFloatUnit * size + double{std::numeric_limits<float>::min()};
}

std::string float_words(const std::optional<cases::PictureBounds>& bounds) {
  if (!bounds || bounds->float_error == 0) return "the nearest float";
  return fmt::format("within {:.3g} · 2^-24", bounds->float_error);
}

}  // namespace rastercheck::properties
