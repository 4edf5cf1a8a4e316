#pragma once

#include <string>
#include <vector>

#include "cases/error.h"
#include "cli/gallery/figure.h"
#include "reports/gallery_page.h"

namespace rastercheck::gallery {

/// Draws and judges all registered figures.
Result<std::vector<reports::GalleryFigure>> draw_gallery(const Canvas& canvas);

/// Writes index.html and, for each picture, NAME.png and NAME-errors.png into an existing folder.
Result<void> write_gallery(const std::vector<reports::GalleryFigure>& figures,
                           const std::string& folder);

}  // namespace rastercheck::gallery
