#pragma once

// Small triangles with colours of their own, drawn as pictures, for the measures of pictures and
// textures. All vertices lie at whole pixels, which belong to every subpixel grid, and w = 1.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/picture.h"
#include "properties/probing/subject.h"

namespace rastercheck::properties {

/// The values of the four attributes: red, green, blue, alpha. The first two are the coordinates s
/// and t of a texture.
using CellColor = std::array<float, 4>;
/// The number of cells of 4×4 pixels in a 64×64 case.
inline constexpr std::size_t kColorCells = 256;
/// The greatest byte: a byte k means k/255.
inline constexpr double kByteSteps = 255;
/// Errors of float32 are told as multiples of this share of the numbers' sizes.
inline constexpr double kFloatUnit = 0x1p-24;
/// The number of samples that a measure needs of each pixel, unless it is about resolving.
inline constexpr int kOneSample = 1;

/// A case of 64×64 pixels without triangles, with four smooth attributes, evaluated at the sample.
cases::Case case_without_cells(const Subject& subject, int samples = kOneSample);
/// Adds the triangle that fills half of a cell, with the colours of its vertices: that at its right
/// angle, the next one along window x, and the next one along window y.
void add_cell(cases::Case& c, std::size_t cell, const std::array<CellColor, 3>& colors);
/// A case with a triangle of constant colour in each of the first cells.
cases::Case case_of_cells(const Subject& subject, const std::vector<CellColor>& colors);

/// A pipeline that keeps all fragments, without blending.
cases::Pipeline plain_pipeline(cases::ColorFormat format = cases::ColorFormat::float32);

/// True if a triangle of depth 1/2 covers a sample of a picture.
bool is_drawn(const cases::Picture& picture, std::size_t x, std::size_t y, std::size_t sample = 0);
/// A colour of a picture.
float color_at(const cases::Picture& picture, std::size_t x, std::size_t y, std::size_t channel,
               std::size_t sample = 0);

/// A pixel that lies in a cell's triangle wherever its samples are.
struct CellPixel {
  std::size_t x = 0;
  std::size_t y = 0;
};
CellPixel pixel_of_cell(std::size_t cell);

/// The bounds that the backend declares for pictures of a case; empty if it promises all to the
/// bit.
std::optional<cases::PictureBounds> declared_bounds(Subject& subject, const cases::Case& c);

/// The range of errors, each the drawn number minus the exact one.
struct ErrorRange {
  double least = 0;
  double greatest = 0;

  /// NaN counts as infinite errors of either sign.
  void add(double error);
  /// The largest error without its sign.
  double reach() const;
};

/// How numbers were rounded to integers, from the range of the errors, in steps of one; empty if an
/// error is a whole step or more. `slack` is how far the errors may be off for other reasons.
std::optional<std::string> rounding_words(const ErrorRange& errors, double slack);

/// True if `drawn` is a float to which a number at most `slack` away from the exact one is rounded.
bool is_within(float drawn, double exact, double slack);
/// The largest error that is declared for a sum of numbers of this size
/// (PictureBounds::float_error).
double float_slack(const cases::PictureBounds& bounds, double size);
/// This limit in words; without bounds, or where they leave no error, the nearest float is
/// declared.
std::string float_words(const std::optional<cases::PictureBounds>& bounds);
/// A number of steps: "1 step", "0.6 steps".
std::string step_words(double steps);
/// Stands for what was measured where the backend draws none of it.
inline constexpr const char* kNotDrawn = "not drawn";

/// Measures the fragments of pictures, and differences across quads.
void measure_differences(Subject& subject);

}  // namespace rastercheck::properties
