#pragma once

// The figures of the gallery. A file in cli/gallery/figures/ draws one and registers it:
//
//   const FigureRegistration kRegistration({"002-4", &draw});
//
// docs/adding-a-figure.md walks through it.

#include <span>
#include <string_view>

#include "cases/error.h"
#include "reports/gallery_page.h"

namespace rastercheck::gallery {

/// How large pictures are, and how many samples a pixel has.
struct Canvas {
  int size = 320;  ///< width and height in pixels; of 5 · 2^k figure 6-1 has a square of 2^(k + 2)
  int samples = 4;  ///< of a pixel: 1, 2, 4, 8 or 16
};

struct Figure {
  /// Its text and its place in there, as "002-4", figure 4 of seed 002: the page has figures in the
  /// order of their names.
  std::string_view name;
  Result<reports::GalleryFigure> (*draw)(const Canvas& canvas) = nullptr;
};

/// All figures, in the order of their names.
std::span<const Figure> figures();

struct FigureRegistration {
  explicit FigureRegistration(const Figure& figure);
};

}  // namespace rastercheck::gallery
