#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "cases/case.h"

namespace rastercheck::backends::vulkan {

/// How many attributes fit into a slot, and how many slots a shader may have.
inline constexpr std::size_t kSlotSize = 4;
inline constexpr std::size_t kMaxSlots = 7;

/// How all attributes of a slot are interpolated.
struct Qualifier {
  cases::Interpolation interpolation = cases::Interpolation::smooth;
  cases::Location location = cases::Location::center;  ///< `center` for flat attributes
  auto operator<=>(const Qualifier&) const = default;
};

/// A vector of up to four attributes that are interpolated alike.
struct Slot {
  Qualifier qualifier;
  std::vector<std::size_t> attributes;  ///< indices into the case's attributes; at most kSlotSize
  bool operator==(const Slot&) const = default;
};

/// Packs a case's attributes into as few slots as their qualifiers allow. Slots are sorted by
/// qualifier, so that cases whose attributes differ only in order share shaders. With one sample
/// per pixel, every location counts as the centre.
std::vector<Slot> slots_of(const cases::Case& c);
/// Likewise, but packs only these attributes.
std::vector<Slot> slots_of(const cases::Case& c, std::span<const std::size_t> attributes);

/// Adds slots without attributes, so that most cases use one of a few shaders. Drivers that draw on
/// the CPU take longer to compile one shader than to draw a hundred cases. Returns the slots
/// unchanged if no common layout holds them all.
std::vector<Slot> widened(std::vector<Slot> slots, int samples);

}  // namespace rastercheck::backends::vulkan
