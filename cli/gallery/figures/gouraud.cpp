// MIT 6.837 2000, lecture 18, slides 16 and 17: Gouraud shading is linear on the screen. This is
// wrong, but seldom visible except where triangles meet in a "T".

#include <array>
#include <utility>

#include "cli/gallery/figure.h"
#include "cli/gallery/internal/panel.h"
#include "cli/gallery/internal/scenes.h"
#include "cli/gallery/internal/textures.h"

namespace rastercheck::gallery::gouraud_figure {
namespace {

/// A floor whose colours are linear in its length: one quad left of the middle and two quads right
/// of it, whose common border meets the left quad's edge in a T.
cases::Case joint(const Canvas& canvas) {
  cases::Case scene = empty_scene(canvas, std::array<std::string, 3>{"red", "green", "blue"});
  scene.name = "a T joint";
  scene.camera = camera_of({{0, 1.1, 3}, 46, 0});
  const auto corner = [](double x, double t) {
    const glm::dvec3 near(0.13, 0.22, 0.45);
    const glm::dvec3 far(1.0, 0.85, 0.35);
    const glm::dvec3 color = near + (far - near) * t;
    return Corner{{x, -0.1, 1.15 - 3.4 * t}, {color.x, color.y, color.z}};
  };
  add_quad(scene, {corner(-0.9, 0), corner(0, 0), corner(0, 1), corner(-0.9, 1)});
  for (const double t : {0.0, 0.5}) {
    add_quad(scene, {corner(0, t), corner(0.9, t), corner(0.9, t + 0.5), corner(0, t + 0.5)});
  }
  return scene;
}

Result<reports::GalleryFigure> draw(const Canvas& canvas) {
  reports::GalleryFigure figure;
  figure.title = "Gouraud shading, and a T joint";
  figure.source = "MIT 6.837 Computer Graphics, lecture 18, fall 2000, slides 16 and 17.";
  figure.sentences = {
      "Colours that are interpolated linearly on the screen are wrong as well, but they vary so "
      "smoothly that each quad alone looks right. Where one quad meets two in a T, the vertex of "
      "the T has the correct colour and the long edge beside it a wrong one, so the colours do not "
      "meet.",
      "With perspective correct interpolation, the colours are those of the plane, however it is "
      "cut."};
  const cases::Case scene = joint(canvas);
  const std::array<PanelPlan, 2> panels{
      {{"004-gouraud-linear", "Linear", "method:screen-linear", scene, vertex_colors(),
        in_levels()},
       {"004-gouraud-correct", "Perspective correct", "method:rational-linear", scene,
        vertex_colors(), in_ulp()}}};
  return with_panels(std::move(figure), panels);
}

const FigureRegistration kRegistration({"004-gouraud", &draw});

}  // namespace
}  // namespace rastercheck::gallery::gouraud_figure
