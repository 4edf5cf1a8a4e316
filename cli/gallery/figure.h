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

/// The size of pictures, and the samples of a pixel.
struct Canvas {
  /// Width and height in pixels. With 5 · 2^k, the square of figure 6-1 is 2^(k + 2) pixels wide.
  int size = 320;
  int samples = 4;  ///< per pixel: 1, 2, 4, 8 or 16
};

struct Figure {
  /// Source and figure number: "002-4" is figure 4 of Heckbert & Moreton 1991. The page shows
  /// figures in the order of their names.
  std::string_view name;
  Result<reports::GalleryFigure> (*draw)(const Canvas& canvas) = nullptr;
};

/// All figures, in the order of their names.
std::span<const Figure> figures();

struct FigureRegistration {
  explicit FigureRegistration(const Figure& figure);
};

}  // namespace rastercheck::gallery
