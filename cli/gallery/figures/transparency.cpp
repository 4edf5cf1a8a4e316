// MIT 6.837 2000, lecture 18, slide 19: texels with alpha 0 show what is behind.

#include <array>
#include <utility>

#include "cli/gallery/figure.h"
#include "cli/gallery/internal/panel.h"
#include "cli/gallery/internal/scenes.h"
#include "cli/gallery/internal/textures.h"

namespace rastercheck::gallery::transparency_figure {
namespace {

/// The checkerboard as a wall, with the trellis in front, slightly turned.
cases::Case trellis_before_wall(const Canvas& canvas) {
  cases::Case scene = empty_textured_scene(canvas);
  scene.name = "a trellis before a wall";
  scene.camera = camera_of({{0.2, 0.1, 3.3}, 46, 0});
  add_sheet(scene, {{-1.05, -1.2, -0.7}, {2.5, 0, 0.2}, {0, 2.4, -0.5}});
  add_sheet(scene, {{-0.75, -0.7, 1.1}, {1.4, 0.15, -1.4}, {0.05, 1.3, 0.1}});
  return scene;
}

Result<reports::GalleryFigure> draw(const Canvas& canvas) {
  reports::GalleryFigure figure;
  figure.title = "Transparency: texels that are not drawn";
  figure.source =
      "MIT 6.837 Computer Graphics, lecture 18, fall 2000, slide 19, texture "
      "transparency.";
  figure.sentences = {
      "Where the trellis's texels have alpha 0, neither colour nor depth is written, and the wall "
      "behind stays visible. The interpolated coordinates select the texel of a pixel: linear ones "
      "put the holes in the wrong places."};
  const cases::Case scene = trellis_before_wall(canvas);
  const std::array<PanelPlan, 2> panels{
      {{"004-transparency-linear", "Linear", "method:screen-linear", scene, trellis(), in_texels()},
       {"004-transparency-correct", "Perspective correct", "method:rational-linear", scene,
        trellis(), in_ulp()}}};
  return with_panels(std::move(figure), panels);
}

const FigureRegistration kRegistration({"004-transparency", &draw});

}  // namespace
}  // namespace rastercheck::gallery::transparency_figure
