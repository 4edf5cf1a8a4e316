// OpenGL 4.6, section 14.5, and Vulkan 1.3, "Basic Line Segment Rasterization": the three sets of
// pixels that a line may cover.

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "cli/gallery/figure.h"
#include "cli/gallery/internal/drawn.h"
#include "cli/gallery/internal/panel.h"
#include "cli/gallery/internal/scenes.h"
#include "cli/gallery/internal/textures.h"

namespace rastercheck::gallery::line_algorithms_figure {
namespace {

/// Pixels along a side of the drawings, each of which is shown as a square of many.
constexpr int kPixels = 20;

struct Line {
  std::array<double, 2> from;  ///< window position, in pixels
  std::array<double, 2> to;
};
constexpr std::array<Line, 3> kLines{
    {{{1.5, 2.75}, {18.25, 6.5}}, {{3.25, 9.5}, {8.75, 18.5}}, {{18.5, 9.25}, {10.5, 17.25}}}};

/// Three lines, three pixels wide: shallow, steep and diagonal.
cases::Case lines_in(const Canvas& canvas, cases::LineMode mode) {
  cases::Case scene = empty_scene(canvas, std::array<std::string, 3>{"red", "green", "blue"});
  scene.name = "three lines";
  scene.framebuffer = {kPixels, kPixels, 1};
  scene.viewport.width = scene.viewport.height = kPixels;
  scene.primitive = cases::Primitive::lines;
  scene.line_mode = mode;
  scene.line_width = 3;
  for (const Line& line : kLines) {
    for (const auto& [u, v] : {line.from, line.to}) {
      const auto x = static_cast<float>(2 * u / kPixels - 1);
      const auto y = static_cast<float>(2 * v / kPixels - 1);
      scene.positions.push_back({x, y, 0.5F, 1});
    }
    const auto b = static_cast<std::uint32_t>(scene.positions.size() - 1);
    scene.triangles.push_back({b - 1, b, b});
    for (const float value : {0.95F, 0.65F, 0.2F, 0.2F, 0.45F, 0.75F}) {
      scene.attribute_values.push_back(value);
    }
  }
  return scene;
}

reports::Image enlarged(const reports::Image& image, int times) {
  reports::Image large =
      reports::Image::filled(image.width * times, image.height * times, reports::kUndrawn);
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) {
      const bool is_border = x % times == 0 || y % times == 0;
      if (!is_border) large.set(x, y, image.at(x / times, y / times));
    }
  }
  return large;
}

/// Draws the lines themselves, without width.
void add_middles(reports::Image& image, int times) {
  constexpr reports::Color kInk{20, 20, 20};
  constexpr int kSteps = 4096;
  for (const Line& line : kLines) {
    for (int i = 0; i <= kSteps; ++i) {
      const double s = static_cast<double>(i) / kSteps;
      const double u = line.from[0] + s * (line.to[0] - line.from[0]);
      const double v = line.from[1] + s * (line.to[1] - line.from[1]);
      image.set(static_cast<int>(u * times), static_cast<int>(v * times), kInk);
    }
  }
}

Result<reports::GalleryPicture> drawn_panel(const Canvas& canvas, cases::LineMode mode,
                                            const char* name, const char* title) {
  const PanelPlan plan{name, title, "cpu", lines_in(canvas, mode), vertex_colors(), in_ulp()};
  Result<reports::GalleryPicture> picture = draw_panel(plan);
  if (!picture || !picture->missing.empty()) return picture;
  const int times = canvas.size / kPixels;
  picture->picture = enlarged(picture->picture, times);
  picture->errors = enlarged(picture->errors, times);
  add_middles(picture->picture, times);
  return picture;
}

Result<reports::GalleryFigure> draw(const Canvas& canvas) {
  using cases::LineMode;
  reports::GalleryFigure figure;
  figure.title = "Three ways to draw a line";
  figure.source =
      "The OpenGL Graphics System 4.6, section 14.5; Vulkan 1.3, Line Segments (rectangular, "
      "parallelogram and Bresenham rasterization).";
  figure.sentences = {
      "Lines of three pixels' width, pixel by pixel as exact arithmetic has them; the thin lines "
      "are their middles. A rectangle has square ends across the line, a parallelogram ends along "
      "an axis, and so is thinner the more slanted it is.",
      "Bresenham's line takes from each column, or each row of a steep line, the pixel whose "
      "diamond it leaves, and repeats it for the width. The pixel with the second end is left "
      "out, so that lines that follow each other draw no pixel twice."};
  struct Panel {
    LineMode mode;
    const char* name;
    const char* title;
  };
  constexpr std::array<Panel, 3> kPanels{
      {{LineMode::rectangular, "005-lines-rectangular", "Rectangular"},
       {LineMode::parallelogram, "005-lines-parallelogram", "Parallelogram"},
       {LineMode::bresenham, "005-lines-bresenham", "Bresenham"}}};
  for (const Panel& panel : kPanels) {
    Result<reports::GalleryPicture> picture =
        drawn_panel(canvas, panel.mode, panel.name, panel.title);
    if (!picture) return tl::unexpected(picture.error());
    figure.pictures.push_back(*std::move(picture));
  }
  return figure;
}

const FigureRegistration kRegistration({"005-lines", &draw});

}  // namespace
}  // namespace rastercheck::gallery::line_algorithms_figure
