// Heckbert & Moreton 1991, §2.1: as the camera rolls, the texture of a linearly interpolated quad
// slides across it "like a rubber sheet".

#include <array>
#include <utility>
#include <vector>

#include "cli/gallery/figure.h"
#include "cli/gallery/internal/panel.h"
#include "cli/gallery/internal/scenes.h"
#include "cli/gallery/internal/textures.h"

namespace rastercheck::gallery::camera_roll_figure {
namespace {

constexpr int kFrames = 8;

Result<reports::GalleryFigure> draw(const Canvas& canvas) {
  reports::GalleryFigure figure;
  figure.title = "A rolling camera: the linear quad swims";
  figure.source = "Heckbert & Moreton 1991, §2.1, flaws of linear interpolation.";
  figure.sentences = {
      "The rectangle of figures 2 and 3, with the camera rolled by 22.5° from frame to frame. The "
      "values that a row of the picture interpolates between depend on how the quad is turned, so "
      "the checks of the linear picture slide and its kinks wander from corner to corner.",
      "Rational linear interpolation turns with the camera and does nothing else."};
  struct Strip {
    std::string name;
    std::string title;
    std::string_view method;
    ErrorUnit unit;
  };
  const std::array<Strip, 2> strips{
      {{"002-roll-linear", "Linear", kLinearPolygon, in_texels()},
       {"002-roll-rational-linear", "Rational linear", "method:rational-linear", in_ulp()}}};
  const Canvas half{canvas.size / 2, canvas.samples};
  for (const Strip& strip : strips) {
    std::vector<reports::GalleryPicture> frames;
    for (int i = 0; i < kFrames; ++i) {
      Result<reports::GalleryPicture> frame =
          draw_panel({strip.name, strip.title, strip.method,
                      leaning_rectangle(half, kWiderFieldOfView, 180.0 * i / kFrames),
                      checkerboard(), strip.unit});
      if (!frame) return tl::unexpected(frame.error());
      frames.push_back(*std::move(frame));
    }
    figure.pictures.push_back(strip_of(frames));
  }
  return figure;
}

const FigureRegistration kRegistration({"002-roll", &draw});

}  // namespace
}  // namespace rastercheck::gallery::camera_roll_figure
