#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/gallery/gallery.h"

namespace rastercheck::gallery {

/// A small canvas on which everything that must lie on whole pixels still does.
inline constexpr Canvas kSmall{160, 4};

/// The gallery on that canvas, drawn once for all tests of a process.
inline const std::vector<reports::GalleryFigure>& small_gallery() {
  static const std::vector<reports::GalleryFigure> drawn = draw_gallery(kSmall).value();
  return drawn;
}

/// The picture of this name; an empty picture if none has it.
inline reports::GalleryPicture picture_of(const std::string& name) {
  for (const reports::GalleryFigure& figure : small_gallery()) {
    for (const reports::GalleryPicture& picture : figure.pictures) {
      if (picture.name == name) return picture;
    }
  }
  ADD_FAILURE() << "no picture " << name;
  return {};
}

}  // namespace rastercheck::gallery
