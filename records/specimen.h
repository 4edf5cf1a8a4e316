#pragma once

// The exact bits drawn for a part of a case, kept with a baseline so that reports can show a later
// drawing of the same part beside it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "records/case_record.h"

namespace rastercheck::records {

/// A part of one triangle's drawing, as if the triangle were drawn alone. The case itself is not
/// kept: the law's seed and index, or the corpus, reproduce it.
struct Specimen {
  CaseKey key;
  std::string case_name;       ///< empty if unnamed
  std::uint32_t triangle = 0;  ///< index into the case's triangles
  /// The part of the framebuffer: first pixel and size, at most kMostInspected in either direction.
  std::uint32_t left = 0;
  std::uint32_t top = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t samples = 1;     ///< samples per pixel
  std::uint32_t attributes = 0;  ///< attributes per fragment
  /// [sample], ordered by y, x, sample: whether it was drawn.
  std::vector<bool> drawn;
  /// [sample][1 + attribute]: depth, then the attributes, as bits of float32; 0 where not drawn.
  std::vector<std::uint32_t> bits;
  bool operator==(const Specimen&) const = default;

  std::size_t sample_count() const { return std::size_t{width} * height * samples; }
  std::size_t values_per_sample() const { return std::size_t{1} + attributes; }
  /// Index of a sample at the framebuffer's x and y; empty outside the part.
  std::optional<std::size_t> index_of(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const;
  /// Depth, or the attribute; empty if the sample lies outside the part or was not drawn. May be
  /// NaN or infinite.
  std::optional<float> value_at(std::uint32_t x, std::uint32_t y, std::uint32_t sample,
                                std::optional<std::uint32_t> attribute) const;
};

/// True if both show the same part of the same case; ignores the backend and the drawn values.
bool is_same_part(const Specimen& a, const Specimen& b);

/// How one drawing of a part differs from another.
struct SpecimenChange {
  std::size_t samples = 0;  ///< number of samples that are drawn in only one drawing, or with
                            ///< another value
  std::size_t at = 0;       ///< index of the sample that changed most
  std::optional<std::uint32_t> attribute;  ///< the value that changed most there; empty for depth
  /// Size of that change, in float32 spacings at the value's largest magnitude in the part,
  /// rounded; infinite if the sample is drawn in only one drawing, or if either value is not
  /// finite.
  double size = 0;
  bool operator==(const SpecimenChange&) const = default;
};

/// Compares two drawings, which must show the same part. Empty if all bits are equal. Of equally
/// large changes, picks the first in the order of `bits`.
std::optional<SpecimenChange> change_of(const Specimen& before, const Specimen& after);

/// Maximum number of specimens per backend.
inline constexpr std::size_t kMostSpecimens = 60;
/// Maximum number of values in one specimen: a depth and an attribute for 16 × 16 pixels. Sixty
/// such specimens take 300 KB.
inline constexpr std::uint32_t kMostSpecimenValues = 512;

}  // namespace rastercheck::records
