#pragma once

// What was drawn of a part of a case, to the bit: kept with a baseline, so that a later drawing of
// the same part can be seen beside it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "records/case_record.h"

namespace rastercheck::records {

/// A part of one triangle's drawing, as if the triangle was drawn alone. The case itself is not
/// kept: its law's seed and index give it, or the corpus.
struct Specimen {
  CaseKey key;
  std::string case_name;       ///< empty where the case has none
  std::uint32_t triangle = 0;  ///< index into the case's triangles
  /// The part of the framebuffer: first pixel and size, at most kMostInspected by that.
  std::uint32_t left = 0;
  std::uint32_t top = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t samples = 1;     ///< of each pixel
  std::uint32_t attributes = 0;  ///< of each fragment
  /// [sample], ordered by y, x, sample: whether it was drawn.
  std::vector<bool> drawn;
  /// [sample][1 + attribute]: depth, then the attributes, as bits of float32; 0 where not drawn.
  std::vector<std::uint32_t> bits;
  bool operator==(const Specimen&) const = default;

  std::size_t sample_count() const { return std::size_t{width} * height * samples; }
  std::size_t values_per_sample() const { return std::size_t{1} + attributes; }
  /// Index of a sample; x and y are the framebuffer's. Nothing outside the part.
  std::optional<std::size_t> index_of(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const;
  /// Depth, or the attribute; nothing where the sample lies outside or was not drawn. May be no
  /// number.
  std::optional<float> value_at(std::uint32_t x, std::uint32_t y, std::uint32_t sample,
                                std::optional<std::uint32_t> attribute) const;
};

/// Whether both are of the same part of the same case, whatever was drawn there and by whom.
bool is_same_part(const Specimen& a, const Specimen& b);

/// How one drawing of a part differs from another.
struct SpecimenChange {
  std::size_t samples = 0;  ///< that are another: drawn in one only, or with another value
  std::size_t at = 0;       ///< of them the one that changed most: index of the sample
  std::optional<std::uint32_t> attribute;  ///< of it the value that did; nothing for depth
  /// By how much: in spacings of float32 at the largest magnitude that the value has in the part,
  /// rounded; infinite where a sample is drawn in one only, or a value of either is no number.
  double size = 0;
  bool operator==(const SpecimenChange&) const = default;
};

/// Nothing where they are the same bits. Of equally large changes the first, in the order of
/// `bits`. Both are of the same part.
std::optional<SpecimenChange> change_of(const Specimen& before, const Specimen& after);

/// Of each backend at most so many.
inline constexpr std::size_t kMostSpecimens = 60;
/// Values of each, at most: a depth and an attribute of 16 × 16 pixels. Sixty of them are 300 KB.
inline constexpr std::uint32_t kMostSpecimenValues = 512;

}  // namespace rastercheck::records
