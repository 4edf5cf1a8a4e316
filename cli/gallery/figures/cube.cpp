// MIT 6.837 2000, lecture 18, slides 5, 6, 14 and 15: a textured cube, drawn linearly, linearly
// with eight triangles per face, and perspective correct.

#include <array>
#include <utility>

#include "cli/gallery/figure.h"
#include "cli/gallery/internal/panel.h"
#include "cli/gallery/internal/scenes.h"
#include "cli/gallery/internal/textures.h"

namespace rastercheck::gallery::cube_figure {
namespace {

Result<reports::GalleryFigure> draw(const Canvas& canvas) {
  reports::GalleryFigure figure;
  figure.title = "A textured cube, and its faces cut into eight triangles";
  figure.source =
      "MIT 6.837 Computer Graphics, lecture 18, fall 2000, slides 6 (two triangles a "
      "face), 15 (eight) and 14 (perspective correct).";
  figure.sentences = {
      "Linear interpolation bends the checks at the diagonal of each face. A face that is cut into "
      "eight triangles has correct values at more vertices, and its errors are less than a third "
      "as large; they are still visible, especially when the cube moves.",
      "Perspective correct interpolation needs neither the cuts nor the additional vertices."};
  const std::array<PanelPlan, 3> panels{
      {{"004-cube-linear", "Linear, two triangles a face", "method:screen-linear", cube(canvas, 1),
        checkerboard(2), in_texels()},
       {"004-cube-subdivided", "Linear, eight triangles a face", "method:screen-linear",
        cube(canvas, 2), checkerboard(8), in_texels()},
       {"004-cube-correct", "Perspective correct, two triangles a face", "method:rational-linear",
        cube(canvas, 1), checkerboard(2), in_ulp()}}};
  return with_panels(std::move(figure), panels);
}

const FigureRegistration kRegistration({"004-cube", &draw});

}  // namespace
}  // namespace rastercheck::gallery::cube_figure
