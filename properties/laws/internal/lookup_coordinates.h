#pragma once

// The texture coordinates at which a driver looks up its textures, which its contract leaves in a
// range.

#include <cstdint>
#include <optional>

#include "cases/contract.h"
#include "oracle/texture_truth.h"
#include "properties/drawing.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/seen_triangles.h"

namespace rastercheck::properties {

class LookupCoordinates {
 public:
  LookupCoordinates(const cases::Case& c, backends::Backend& backend,
                    const cases::Contract& contract);

  /// The coordinates of a fragment. If pictures have the fragments that the backend draws
  /// (cases::PictureBounds), those that it draws itself. Otherwise all that the contract permits;
  /// empty if they may be any, or if the backend draws others as a fragment. How good drawn
  /// coordinates are is for other laws to judge. Draws the case's fragments when first called.
  std::optional<oracle::CoordinateRanges> find(const oracle::TriangleTruth& truth,
                                               const cases::SamplePlace& place);

 private:
  struct Drawn {
    cases::Fragments fragments;
    FragmentMap by_place;
  };
  std::optional<oracle::CoordinateRanges> drawn_at(const cases::SamplePlace& place);

  const cases::Case* case_;
  backends::Backend* backend_;
  bool are_drawn_;  ///< pictures have the fragments that the backend draws
  bool has_asked_ = false;
  std::optional<Drawn> drawn_;  ///< empty if not asked, or if drawing failed
};

/// Drawn coordinates of a fragment as ranges; empty if one is not finite.
std::optional<oracle::CoordinateRanges> ranges_of(float s, float t);

/// 0 or 1: the coordinate farther from 0, which is harder to wrap, so that a wrong lookup is
/// reported as one of this attribute.
std::uint32_t farther_coordinate(const oracle::CoordinateRanges& at);

}  // namespace rastercheck::properties
