// Figure 6-1 of Appendix 5 (docs/bibliography.md): where linear interpolation is right, where it is
// wrong, and the correct result.

#include <array>
#include <utility>

#include "cli/gallery/figure.h"
#include "cli/gallery/internal/panel.h"
#include "cli/gallery/internal/scenes.h"
#include "cli/gallery/internal/textures.h"

namespace rastercheck::gallery::affine_and_correct_figure {
namespace {

/// A square facing the camera, with w = 5 at every vertex. It spans four fifths of the picture's
/// width, so that window positions are whole pixels and texture coordinates at samples are float32
/// numbers.
cases::Case facing(const Canvas& canvas) {
  cases::Case scene = empty_textured_scene(canvas);
  scene.name = "facing";
  scene.positions = {{-4, -4, 2, 5}, {4, -4, 2, 5}, {4, 4, 2, 5}, {-4, 4, 2, 5}};
  scene.attribute_values = {0, 0, 1, 0, 1, 1, 0, 1};
  scene.triangles = {{0, 1, 2}, {0, 2, 3}};
  return scene;
}

cases::Case leaning_back(const Canvas& canvas) {
  cases::Case scene = empty_textured_scene(canvas);
  scene.name = "leaning back";
  scene.camera = camera_of({{0, 0.2, 3.4}, 46, 0});
  add_sheet(scene, {{-1, -0.8, 0.9}, {2, 0, 0}, {0, 1.75, -2.9}});
  return scene;
}

Result<reports::GalleryFigure> draw(const Canvas& canvas) {
  reports::GalleryFigure figure;
  figure.title = "Where linear interpolation is enough, and where it is not";
  figure.source =
      "Appendix 5: Perspective Correct Interpolation, figure 6-1. Left to right: "
      "orthogonal, affine, perspective correct.";
  figure.sentences = {
      "A square of two triangles. If it is orthogonal to the view direction, all vertices have the "
      "same w, and values that are linear on the screen are linear on the square: the error is "
      "zero.",
      "If it leans back, linear interpolation gives each triangle squares of equal size, which "
      "bend at the diagonal. Dividing interpolated u/w and v/w by interpolated 1/w corrects that; "
      "the only error left is one rounding to float32."};
  const std::array<PanelPlan, 3> panels{
      {{"000-6-1-facing", "Orthogonal to the view direction: linear", "method:screen-linear",
        facing(canvas), checkerboard(), in_ulp()},
       {"000-6-1-affine", "Leaning back: linear", "method:screen-linear", leaning_back(canvas),
        checkerboard(), in_texels()},
       {"000-6-1-correct", "Leaning back: perspective correct", "method:rational-linear",
        leaning_back(canvas), checkerboard(), in_ulp()}}};
  return with_panels(std::move(figure), panels);
}

const FigureRegistration kRegistration({"000-6-1", &draw});

}  // namespace
}  // namespace rastercheck::gallery::affine_and_correct_figure
