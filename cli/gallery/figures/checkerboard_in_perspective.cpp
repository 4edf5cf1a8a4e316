// Figures 2 and 3 of Heckbert & Moreton 1991: a checkerboard on a rectangle in perspective, drawn
// as one polygon by linear and by rational linear interpolation.

#include <array>
#include <cmath>
#include <utility>

#include "cli/gallery/figure.h"
#include "cli/gallery/internal/panel.h"
#include "cli/gallery/internal/scenes.h"
#include "cli/gallery/internal/textures.h"
#include "oracle/transform.h"

namespace rastercheck::gallery::checkerboard_in_perspective_figure {
namespace {

/// Draws marks at both sides of a picture, in the rows of the corners.
void mark_rows(reports::Image& image, const std::vector<double>& rows) {
  constexpr reports::Color kMark{190, 30, 45};
  const int length = image.width / 24;
  for (const double at : rows) {
    const auto row = static_cast<int>(std::floor(at));
    for (int i = 0; i < length; ++i) {
      image.set(i, row, kMark);
      image.set(image.width - 1 - i, row, kMark);
    }
  }
}

Result<reports::GalleryFigure> draw(const Canvas& canvas) {
  reports::GalleryFigure figure;
  figure.title = "A checkerboard in perspective: linear and rational linear";
  figure.source =
      "P. S. Heckbert and H. P. Moreton, Interpolation for Polygon Texture Mapping "
      "and Shading, 1991, figures 2 (left) and 3 (right).";
  figure.sentences = {
      "Linear interpolation along the edges and then along the rows of a polygon lacks the "
      "foreshortening of perspective. The checks kink in the rows of the corners (marked), where "
      "the ends of a row pass from one edge to another.",
      "Rational linear interpolation, of u/w, v/w and 1/w with a division at each pixel, is the "
      "projective map itself. Its error is that of one rounding to float32; the steps in its "
      "map are where a coordinate passes a power of two."};
  const cases::Case scene = leaning_rectangle(canvas);
  const std::array<PanelPlan, 2> panels{
      {{"002-2-linear", "Linear", kLinearPolygon, scene, checkerboard(), in_texels()},
       {"002-3-rational-linear", "Rational linear", "method:rational-linear", scene, checkerboard(),
        in_ulp()}}};
  Result<reports::GalleryFigure> drawn = with_panels(std::move(figure), panels);
  if (!drawn) return drawn;
  const Result<cases::ClipCase> clip = oracle::to_clip_case(scene, scene.name);
  if (!clip) return tl::unexpected(clip.error());
  for (reports::GalleryPicture& picture : drawn->pictures) {
    mark_rows(picture.picture, corner_rows(*clip));
    mark_rows(picture.errors, corner_rows(*clip));
  }
  return drawn;
}

const FigureRegistration kRegistration({"002-2", &draw});

}  // namespace
}  // namespace rastercheck::gallery::checkerboard_in_perspective_figure
