#pragma once

// Defects that right drawings are given on purpose, to see what of them the laws notice, and how
// many of them they noticed.

#include <array>
#include <cstdint>
#include <map>
#include <string_view>

#include "cases/names.h"

namespace rastercheck::records {

/// Names a way in which a drawing is made wrong. A scale ULP is the unit of errors (RULES §5).
enum class Defect {
  moved_half,  ///< all vertices moved right
  moved_16th,
  moved_64th,
  moved_256th,
  moved_1024th,
  extra_pixel,  ///< one sample more, so far outside its triangle or nearer
  extra_16th,
  extra_256th,
  missing_pixel,  ///< one sample less, so far inside its triangle or nearer
  missing_16th,
  missing_256th,
  crack,         ///< the samples beside an edge that two triangles share are missing
  sample_order,  ///< samples in each other's places
  values_97,     ///< multiplied by 0.97
  values_99,
  values_999,
  values_99999,
  values_8_ulp,  ///< larger by 8 scale ULP
  values_2_ulp,
  values_half_pixel,  ///< of half a pixel to the right and above
  values_affine,      ///< of smooth attributes the noperspective value
  values_of_another,  ///< the next triangle's plane
  values_centroid,    ///< of attributes at the centre the value at the centroid
  values_nan,
  values_12345,
  depth_90,
  depth_99,
  depth_999,
  depth_99999,
  depth_8_ulp,
  depth_2_ulp,
  depth_half_pixel,
  depth_nan,
};
constexpr auto names_of(Defect /*type*/) {
  return std::to_array<std::string_view>({"all moved 1/2 px",
                                          "all moved 1/16 px",
                                          "all moved 1/64 px",
                                          "all moved 1/256 px",
                                          "all moved 1/1024 px",
                                          "a sample more at 1 px",
                                          "a sample more at 1/16 px",
                                          "a sample more at 1/256 px",
                                          "a sample less at 1 px",
                                          "a sample less at 1/16 px",
                                          "a sample less at 1/256 px",
                                          "a crack",
                                          "samples in another order",
                                          "values × 0.97",
                                          "values × 0.99",
                                          "values × 0.999",
                                          "values × 0.99999",
                                          "values 8 scale ULP off",
                                          "values 2 scale ULP off",
                                          "values half a pixel off",
                                          "affine for perspective",
                                          "another triangle's values",
                                          "centroid for centre",
                                          "values NaN",
                                          "values 12345",
                                          "depth × 0.9",
                                          "depth × 0.99",
                                          "depth × 0.999",
                                          "depth × 0.99999",
                                          "depth 8 ULP off",
                                          "depth 2 ULP off",
                                          "depth half a pixel off",
                                          "depth NaN"});
}
constexpr std::string_view to_string(Defect defect) { return cases::name_of(defect); }

/// Counts drawings that were given a defect which changed them, and those where it was noticed.
struct Noticed {
  std::uint64_t drawings = 0;
  std::uint64_t noticed = 0;
  bool operator==(const Noticed&) const = default;
};

/// Fewer drawings say little of how often a defect is noticed.
inline constexpr std::uint64_t kEnoughDrawings = 30;

/// Has only defects that changed a drawing.
using Power = std::map<Defect, Noticed>;

inline void merge(Noticed& into, const Noticed& from) {
  into.drawings += from.drawings;
  into.noticed += from.noticed;
}

inline void merge(Power& into, const Power& from) {
  for (const auto& [defect, noticed] : from) merge(into[defect], noticed);
}

/// Over all defects.
inline Noticed total(const Power& power) {
  Noticed all;
  for (const auto& [defect, noticed] : power) merge(all, noticed);
  return all;
}

}  // namespace rastercheck::records
