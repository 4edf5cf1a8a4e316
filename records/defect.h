#pragma once

// Defects put into correct drawings on purpose, and counts of how many the laws noticed.

#include <array>
#include <cstdint>
#include <map>
#include <string_view>

#include "cases/names.h"

namespace rastercheck::records {

/// A way to make a drawing wrong. A scale ULP is the unit of errors (RULES §5).
enum class Defect {
  moved_half,  ///< all vertices moved to the right, by half a pixel
  moved_16th,
  moved_64th,
  moved_256th,
  moved_1024th,
  extra_pixel,  ///< one extra sample, outside its triangle by at most the distance in the name
  extra_16th,
  extra_256th,
  missing_pixel,  ///< one missing sample, inside by at most the distance in the name
  missing_16th,
  missing_256th,
  crack,         ///< the samples beside an edge that two triangles share are missing
  sample_order,  ///< the samples are permuted
  values_97,     ///< multiplied by 0.97
  values_99,
  values_999,
  values_99999,
  values_8_ulp,  ///< increased by 8 scale ULP
  values_2_ulp,
  values_half_pixel,  ///< taken half a pixel to the right and above
  values_affine,      ///< smooth attributes get the noperspective value
  values_of_another,  ///< computed from the next triangle's plane
  values_centroid,    ///< attributes at the centre get the value at the centroid
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

/// Counts drawings that a defect changed, and how many of these a law noticed.
struct Noticed {
  std::uint64_t drawings = 0;
  std::uint64_t noticed = 0;
  bool operator==(const Noticed&) const = default;
};

/// Least number of drawings for a meaningful detection rate.
inline constexpr std::uint64_t kEnoughDrawings = 30;

/// Detection counts by defect; only defects that changed a drawing.
using Power = std::map<Defect, Noticed>;

inline void merge(Noticed& into, const Noticed& from) {
  into.drawings += from.drawings;
  into.noticed += from.noticed;
}

inline void merge(Power& into, const Power& from) {
  for (const auto& [defect, noticed] : from) merge(into[defect], noticed);
}

/// The sum of the counts over all defects.
inline Noticed total(const Power& power) {
  Noticed all;
  for (const auto& [defect, noticed] : power) merge(all, noticed);
  return all;
}

}  // namespace rastercheck::records
