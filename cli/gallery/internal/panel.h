#pragma once

// A picture of the gallery: fragments as colours, and how far they are from the exact values.

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

/// The colour of a fragment of a triangle with these attributes; nothing of one that is not drawn,
/// nor hides what is behind (seed 004, slide 19).
using Shader = std::function<std::optional<reports::Color>(std::uint32_t triangle,
                                                           std::span<const float> attributes)>;

/// What errors are measured in.
struct ErrorUnit {
  const reports::ErrorScale* scale = nullptr;
  /// Units for a difference of 1 in an attribute; 0 of scale ULP.
  double per_one = 0;
};
ErrorUnit in_ulp();
ErrorUnit in_texels();  ///< of a texture of kTexels · kTexels
ErrorUnit in_levels();

inline constexpr int kTexels = 256;

/// Paints the nearest fragment of each sample, and the mean of each pixel's samples, and judges
/// them: what is covered by the contract, values by the exact perspective ones (the ideal error of
/// oracle/judge.h), whatever the method means to draw. Fails where the oracle's self-check does.
Result<reports::GalleryPicture> judged_picture(const DrawnScene& drawn, const Shader& shader,
                                               const ErrorUnit& unit);

/// A picture to be drawn and judged.
struct PanelPlan {
  std::string name;
  std::string title;
  std::string_view method;  ///< as of draw_by
  cases::Case scene;
  Shader shader;
  ErrorUnit unit;
};
Result<reports::GalleryPicture> draw_panel(const PanelPlan& plan);

/// The figure, with these pictures.
Result<reports::GalleryFigure> with_panels(reports::GalleryFigure figure,
                                           std::span<const PanelPlan> plans);

/// Pictures of one size and unit as the frames of one, under the name and title of the first.
reports::GalleryPicture strip_of(std::span<const reports::GalleryPicture> frames);

}  // namespace rastercheck::gallery
