#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cases/case.h"

namespace rastercheck::backends::vulkan {

/// Attributes that a slot has room for, and slots that the shaders have.
inline constexpr std::size_t kSlotSize = 4;
inline constexpr std::size_t kMaxSlots = 7;

/// How all attributes of a slot are interpolated.
struct Qualifier {
  cases::Interpolation interpolation = cases::Interpolation::smooth;
  cases::Location location = cases::Location::center;  ///< `center` of flat ones
  auto operator<=>(const Qualifier&) const = default;
};

/// A vector of four that is interpolated as one.
struct Slot {
  Qualifier qualifier;
  std::vector<std::size_t> attributes;  ///< indices into the case's; at most kSlotSize
  bool operator==(const Slot&) const = default;
};

/// A case's attributes in as few slots as their qualifiers allow, ordered by qualifier so that
/// cases that differ in order alone have the same shaders. With one sample all locations are the
/// centre.
std::vector<Slot> slots_of(const cases::Case& c);

/// The same with slots added that have no attributes, so that most cases have one of a few shaders:
/// drivers that draw on the CPU take longer to compile one than to draw a hundred cases. Slots
/// that have room for all as they are stay so.
std::vector<Slot> widened(std::vector<Slot> slots, int samples);

}  // namespace rastercheck::backends::vulkan
