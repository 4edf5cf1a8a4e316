#pragma once

// A scene as a method drew it, with what the method promises of it.

#include <string>
#include <string_view>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::gallery {

struct DrawnScene {
  std::string method;        ///< the backend's specification, or what stands for it
  std::string missing;       ///< why nothing was drawn; empty where it was
  cases::Case scene;         ///< of clip positions
  cases::Contract contract;  ///< decides what is a violation
  cases::Fragments fragments;
};

/// In place of a backend: a convex quad as one polygon, linear along its edges and then along rows
/// (seed 002, §2). Of cases under Vulkan's rules with four vertices and the triangles (0, 1, 2) and
/// (0, 2, 3), to which its fragments are given by where they lie. What is covered is held against
/// what rational-linear promises.
inline constexpr std::string_view kLinearPolygon = "scanline-linear, as one polygon";

/// A case with or without a camera, drawn by a backend or as above. By a method that there is none
/// of, it is `missing`.
Result<DrawnScene> draw_by(std::string_view method, const cases::Case& scene);

}  // namespace rastercheck::gallery
