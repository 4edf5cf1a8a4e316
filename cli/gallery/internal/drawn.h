#pragma once

// A scene as drawn by a method, with what the method promises about it.

#include <string>
#include <string_view>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::gallery {

struct DrawnScene {
  std::string method;        ///< the backend's specification, or a name used instead
  std::string missing;       ///< why nothing was drawn; empty if drawn
  cases::Case scene;         ///< in clip positions
  cases::Contract contract;  ///< decides what is a violation
  cases::Fragments fragments;
};

/// Takes the place of a backend: draws a convex quad as one polygon, linear along its edges and
/// then along rows (Heckbert & Moreton 1991, §2). For cases under Vulkan's rules with four vertices
/// and the triangles (0, 1, 2) and (0, 2, 3); each fragment goes to the triangle in which it lies.
/// Coverage is compared with what rational-linear promises.
inline constexpr std::string_view kLinearPolygon = "scanline-linear, as one polygon";

/// Draws a case, with or without a camera, with a backend or kLinearPolygon. If no such method
/// exists, sets `missing`.
Result<DrawnScene> draw_by(std::string_view method, const cases::Case& scene);

}  // namespace rastercheck::gallery
