#pragma once

// Reads a drawing's values one by one, and tells what is known about them without an oracle.

#include <cstddef>
#include <cstdint>
#include <optional>

#include "cases/case.h"
#include "cases/fragments.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {

/// An attribute's index; empty means the depth.
using MaybeAttribute = std::optional<std::uint32_t>;

bool all_in_front(const cases::Case& c, const cases::Triangle& triangle);

/// True if an attribute is evaluated at samples: if it is located at the sample, or at the centre
/// if the pixel has a single sample.
bool is_at_sample(const cases::Case& c, std::uint32_t attribute);

/// Reads a drawing by fragment index. Every fragment must belong to one of the case's triangles.
class DrawnValues {
 public:
  /// The case and the drawing must outlive this object.
  DrawnValues(const cases::Case& c, const cases::Fragments& drawn) : case_(&c), drawn_(&drawn) {}

  cases::SamplePlace place(std::size_t fragment) const { return drawn_->place_of(fragment); }
  std::uint32_t triangle(std::size_t fragment) const { return drawn_->triangle[fragment]; }
  const cases::Triangle& corners(std::size_t fragment) const {
    return case_->triangles[triangle(fragment)];
  }
  float value(std::size_t fragment, const MaybeAttribute& attribute) const {
    return attribute ? drawn_->attributes_of(fragment)[*attribute] : drawn_->depth[fragment];
  }
  /// The ulp of the attribute's greatest magnitude at the triangle's vertices or, for the depth, of
  /// the viewport's greatest depth.
  double vertex_ulp(std::size_t fragment, const MaybeAttribute& attribute) const;

 private:
  const cases::Case* case_;
  const cases::Fragments* drawn_;
};

}  // namespace rastercheck::properties
