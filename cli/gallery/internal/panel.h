#pragma once

// Makes a picture of the gallery: fragments as colours, and their errors against the exact values.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "cases/error.h"
#include "cli/gallery/internal/drawn.h"
#include "reports/error_scale.h"
#include "reports/gallery_page.h"

namespace rastercheck::gallery {

/// Returns the colour of a fragment of a triangle with these attributes; empty if the fragment is
/// not drawn and hides nothing behind it (MIT 6.837 2000, lecture 18, slide 19).
using Shader = std::function<std::optional<reports::Color>(std::uint32_t triangle,
                                                           std::span<const float> attributes)>;

/// The unit of errors.
struct ErrorUnit {
  const reports::ErrorScale* scale = nullptr;
  /// Units per difference of 1 in an attribute; 0 if the unit is scale ULP.
  double per_one = 0;
};
ErrorUnit in_ulp();
ErrorUnit in_texels();  ///< texels of a texture of kTexels × kTexels
ErrorUnit in_levels();

inline constexpr int kTexels = 256;

/// Paints the nearest fragment of each sample and averages each pixel's samples. Judges coverage by
/// the contract, and values by the exact perspective values (the ideal error of oracle/judge.h),
/// whatever the method intends to draw. Fails if the oracle's self-check fails.
Result<reports::GalleryPicture> judged_picture(const DrawnScene& drawn, const Shader& shader,
                                               const ErrorUnit& unit);

/// A picture to be drawn and judged.
struct PanelPlan {
  std::string name;
  std::string title;
  std::string_view method;  ///< as in draw_by()
  cases::Case scene;
  Shader shader;
  ErrorUnit unit;
};
Result<reports::GalleryPicture> draw_panel(const PanelPlan& plan);

/// Adds these pictures to the figure.
Result<reports::GalleryFigure> with_panels(reports::GalleryFigure figure,
                                           std::span<const PanelPlan> plans);

/// Joins pictures of equal size and unit into one picture, side by side as its frames, with the
/// name and title of the first.
reports::GalleryPicture strip_of(std::span<const reports::GalleryPicture> frames);

}  // namespace rastercheck::gallery
