#include "cli/gallery/gallery.h"

#include "cases/files.h"
#include "reports/png.h"

namespace rastercheck::gallery {
namespace {

Result<void> write_png(const reports::Image& image, const std::string& file) {
  return reports::to_png(image).and_then(
      [&file](const std::string& bytes) { return cases::write_file(file, bytes); });
}

}  // namespace

Result<std::vector<reports::GalleryFigure>> draw_gallery(const Canvas& canvas) {
  std::vector<reports::GalleryFigure> drawn;
  for (const Figure& figure : figures()) {
    Result<reports::GalleryFigure> one = figure.draw(canvas);
    if (!one) return tl::unexpected(one.error());
    drawn.push_back(*std::move(one));
  }
  return drawn;
}

Result<void> write_gallery(const std::vector<reports::GalleryFigure>& figures,
                           const std::string& folder) {
  for (const reports::GalleryFigure& figure : figures) {
    for (const reports::GalleryPicture& picture : figure.pictures) {
      if (!picture.missing.empty()) continue;
      const std::string stem = folder + "/" + picture.name;
      Result<void> written = write_png(picture.picture, stem + ".png");
      if (written) written = write_png(picture.errors, stem + "-errors.png");
      if (!written) return written;
    }
  }
  return reports::gallery_html(figures).and_then([&folder](const std::string& page) {
    return cases::write_file(folder + "/index.html", page);
  });
}

}  // namespace rastercheck::gallery
