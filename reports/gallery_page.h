#pragma once

// The gallery: textbook figures drawn again, as plain data and as a page.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cases/error.h"
#include "reports/error_scale.h"
#include "reports/image.h"
#include "reports/line_plot.h"

namespace rastercheck::reports {

/// A picture and a picture of its errors, of the same size.
struct GalleryPicture {
  std::string name;     ///< name of its file, without extension; its file of errors adds "-errors"
  std::string title;    ///< what is drawn and how, in a few words
  std::string method;   ///< what drew it
  std::string missing;  ///< why the picture and the members below are missing; empty if drawn
  Image picture;
  Image errors;
  int frames = 1;                     ///< how many frames either picture has, side by side
  const ErrorScale* scale = nullptr;  ///< of the errors; `worst` and `p99` are in its unit
  double worst = 0;                   ///< an upper bound on the largest error of a visible sample
  double p99 = 0;                     ///< an upper bound on the error of 99 in 100 visible samples
  std::size_t samples = 0;            ///< number of visible samples
  std::size_t violations = 0;         ///< samples whose coverage contradicts the method's promise
};

struct GalleryPlot {
  LinePlot plot;
  std::string caption;
};

struct GalleryFigure {
  std::string title;
  std::string source;                  ///< the book or paper, and the figure
  std::vector<std::string> sentences;  ///< what the reader sees, and why
  std::vector<GalleryPicture> pictures;
  std::vector<GalleryPlot> plots;
};

/// "≤ 0.459", with three digits, rounded up; "0" for zero.
std::string gallery_error_text(double error);

/// A single self-contained page without scripts or other files. Fails if PNG cannot hold a picture.
Result<std::string> gallery_html(std::span<const GalleryFigure> figures);

}  // namespace rastercheck::reports
