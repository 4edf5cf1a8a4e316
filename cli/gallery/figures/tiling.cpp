// MIT 6.837 2000, lecture 18, slide 18: a texture repeated over a polygon.

#include <array>
#include <utility>

#include "cli/gallery/figure.h"
#include "cli/gallery/internal/panel.h"
#include "cli/gallery/internal/scenes.h"
#include "cli/gallery/internal/textures.h"

namespace rastercheck::gallery::tiling_figure {
namespace {

/// A floor of 4 · 6 tiles, starting at coordinates below 0.
cases::Case floor_of_tiles(const Canvas& canvas) {
  cases::Case scene = empty_textured_scene(canvas);
  scene.name = "a tiled floor";
  scene.camera = camera_of({{0.45, 1.5, 3}, 46, 0});
  add_sheet(scene, {{-0.9, 0, 1.1}, {1.9, 0, 0}, {0, 0, -2.85}, {-2, -3}, {2, 3}});
  return scene;
}

Result<reports::GalleryFigure> draw(const Canvas& canvas) {
  reports::GalleryFigure figure;
  figure.title = "Tiling: a texture again and again";
  figure.source = "MIT 6.837 Computer Graphics, lecture 18, fall 2000, slide 18, texture tiling.";
  figure.sentences = {
      "Texture coordinates run from −2 to 2 across the floor and from −3 to 3 along it; their "
      "integer parts are dropped, so the tile repeats, below 0 as well. With many tiles on two "
      "triangles, linear interpolation is off by more than a whole tile."};
  const cases::Case scene = floor_of_tiles(canvas);
  const std::array<PanelPlan, 2> panels{
      {{"004-tiling-linear", "Linear", "method:screen-linear", scene, tiles(), in_texels()},
       {"004-tiling-correct", "Perspective correct", "method:rational-linear", scene, tiles(),
        in_ulp()}}};
  return with_panels(std::move(figure), panels);
}

const FigureRegistration kRegistration({"004-tiling", &draw});

}  // namespace
}  // namespace rastercheck::gallery::tiling_figure
