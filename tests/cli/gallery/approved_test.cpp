// Compares the gallery's pictures, and its maps of visible errors, with approved ones. The
// comparison is by the number of pixels that differ and by how much, not by bytes: another compiler
// may round a camera's matrix differently, and a sample at an edge then falls on the other side.
// After a change of a figure, look at the new pictures, then run this program with
// UPDATE_APPROVED=1.
//
// If one of a pixel's four samples changes from ink (38) to cream (244) or paper (242), the pixel
// changes by at most 89 levels, because a pixel is the root of the mean of squares:
// from 38 to √((3 · 38² + 244²)/4) = 127.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "reports/png.h"
#include "tests/cli/gallery/small_gallery.h"
#include "tests/decoded_png.h"

namespace rastercheck::gallery::approved_test {
namespace {

using reports::Image;

const std::string kFolder = std::string(RASTERCHECK_SOURCE_DIR) + "/tests/cli/gallery/approved/";

/// Largest difference, in levels, that rounding of a colour or of a ramp causes.
constexpr int kSameLevel = 8;
/// Largest differences of a picture that samples at edges may cause.
constexpr double kMostShare = 0.005;
constexpr double kMostMean = 0.25;
constexpr int kOneSample = 89;

struct Difference {
  double share = 1;  ///< of pixels that differ by more than kSameLevel
  double mean = 255;
  int worst = 255;
};

Difference difference(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.rgb.empty()) return {};
  Difference found{0, 0, 0};
  const std::size_t pixels = a.rgb.size() / 3;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    int most = 0;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      most = std::max(most, std::abs(int{a.rgb[i]} - int{b.rgb[i]}));
    }
    found.share += most > kSameLevel ? 1 : 0;
    found.mean += most;
    found.worst = std::max(found.worst, most);
  }
  found.share /= static_cast<double>(pixels);
  found.mean /= static_cast<double>(pixels);
  return found;
}

bool is_alike(const Difference& found) {
  return found.share <= kMostShare && found.mean <= kMostMean;
}

void expect_approved(const Image& image, const std::string& name, bool is_map) {
  const std::string file = kFolder + name + ".png";
  if (std::getenv("UPDATE_APPROVED") != nullptr) {
    std::ofstream(file, std::ios::binary) << reports::to_png(image).value();
  }
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const Difference found = difference(image, decoded_png(bytes));
  EXPECT_TRUE(is_alike(found)) << file << ": " << found.share << " of all pixels differ, by "
                               << found.mean << " levels in the mean, " << found.worst
                               << " at worst";
  // One sample more or less may change a pixel of a map completely.
  if (!is_map) {
    EXPECT_LE(found.worst, kOneSample) << file;
  }
}

TEST(ApprovedGallery, IsWhatIsDrawn) {
  std::set<std::string> names;
  for (const reports::GalleryFigure& figure : small_gallery()) {
    for (const reports::GalleryPicture& picture : figure.pictures) {
      if (!picture.missing.empty()) continue;
      names.insert(picture.name + ".png");
      expect_approved(picture.picture, picture.name, false);
      if (picture.scale == &reports::ulp_scale()) continue;  // shows only rounding noise
      names.insert(picture.name + "-errors.png");
      expect_approved(picture.errors, picture.name + "-errors", true);
    }
  }
  // Kills: an approved picture that is no longer drawn.
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    EXPECT_TRUE(names.contains(entry.path().filename().string())) << entry.path();
  }
}

// Kills: a comparison that accepts every picture.
TEST(ApprovedGallery, TellsPicturesApart) {
  for (const auto& [a, b] : {std::pair{"002-2-linear", "002-3-rational-linear"},
                             {"000-6-1-affine", "000-6-1-correct"},
                             {"004-cube-subdivided", "004-cube-correct"},
                             {"004-gouraud-linear", "004-gouraud-correct"}}) {
    EXPECT_FALSE(is_alike(difference(picture_of(a).picture, picture_of(b).picture))) << a;
    EXPECT_TRUE(is_alike(difference(picture_of(a).picture, picture_of(a).picture))) << a;
  }
  Image moved = picture_of("002-2-linear").picture;
  std::rotate(moved.rgb.begin(), moved.rgb.begin() + 3, moved.rgb.end());
  EXPECT_FALSE(is_alike(difference(moved, picture_of("002-2-linear").picture)));
}

}  // namespace
}  // namespace rastercheck::gallery::approved_test
