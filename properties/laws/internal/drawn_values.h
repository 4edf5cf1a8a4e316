#pragma once

// What was drawn of a case value by value, and what is known of the values without an oracle.

#include <cstddef>
#include <cstdint>
#include <optional>

#include "cases/case.h"
#include "cases/fragments.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {

/// An attribute's index; nothing means the depth.
using MaybeAttribute = std::optional<std::uint32_t>;

bool all_in_front(const cases::Case& c, const cases::Triangle& triangle);

/// Whether an attribute is evaluated at samples: declared so, or at the centre, where the only
/// sample is.
bool is_at_sample(const cases::Case& c, std::uint32_t attribute);

/// Fragments of a drawing, by their indices; of the case's own triangles.
class DrawnValues {
 public:
  /// Both must outlive it.
  DrawnValues(const cases::Case& c, const cases::Fragments& drawn) : case_(&c), drawn_(&drawn) {}

  cases::SamplePlace place(std::size_t fragment) const { return drawn_->place_of(fragment); }
  std::uint32_t triangle(std::size_t fragment) const { return drawn_->triangle[fragment]; }
  const cases::Triangle& corners(std::size_t fragment) const {
    return case_->triangles[triangle(fragment)];
  }
  float value(std::size_t fragment, const MaybeAttribute& attribute) const {
    return attribute ? drawn_->attributes_of(fragment)[*attribute] : drawn_->depth[fragment];
  }
  /// The ulp of the greatest value that an attribute has at the triangle's vertices, or a depth in
  /// the viewport.
  double vertex_ulp(std::size_t fragment, const MaybeAttribute& attribute) const;

 private:
  const cases::Case* case_;
  const cases::Fragments* drawn_;
};

}  // namespace rastercheck::properties
