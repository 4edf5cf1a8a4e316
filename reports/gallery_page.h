#pragma once

// The gallery: figures of textbooks drawn anew, as plain data and as the page that shows them.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cases/error.h"
#include "reports/error_scale.h"
#include "reports/image.h"
#include "reports/line_plot.h"

namespace rastercheck::reports {

/// A picture and, of the same size, its errors.
struct GalleryPicture {
  std::string name;     ///< of its files, without extension; the errors' has "-errors" besides
  std::string title;    ///< what is drawn, and how, in a few words
  std::string method;   ///< what drew it
  std::string missing;  ///< why there is no picture, nor what follows; empty where there is one
  Image picture;
  Image errors;
  int frames = 1;                     ///< that stand side by side in either
  const ErrorScale* scale = nullptr;  ///< of the errors, and the unit of those below
  double worst = 0;                   ///< at least the largest error of a sample that is seen
  double p99 = 0;                     ///< that of 99 in 100 of them
  std::size_t samples = 0;            ///< that are seen
  std::size_t violations = 0;         ///< samples covered, or not, against what the method promises
};

struct GalleryPlot {
  LinePlot plot;
  std::string caption;
};

struct GalleryFigure {
  std::string title;
  std::string source;                  ///< text and figure
  std::vector<std::string> sentences;  ///< what one sees, and why
  std::vector<GalleryPicture> pictures;
  std::vector<GalleryPlot> plots;
};

/// "≤ 0.459": three digits, rounded up; "0" of none.
std::string gallery_error_text(double error);

/// One page that needs nothing else: no scripts, no files beside it. Fails where a picture is none
/// that PNG holds.
Result<std::string> gallery_html(std::span<const GalleryFigure> figures);

}  // namespace rastercheck::reports
