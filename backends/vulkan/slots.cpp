#include "backends/vulkan/slots.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <utility>

namespace rastercheck::backends::vulkan {
namespace {

using cases::Interpolation;
using cases::Location;

// The common layouts of slots, each sorted by qualifier. Slots with `sample` have a layout of their
// own, because their shaders run for every sample, and other shaders for every pixel.
constexpr std::array<Qualifier, 3> kOfOneSample{{
    {Interpolation::smooth, Location::center},
    {Interpolation::noperspective, Location::center},
    {Interpolation::flat, Location::center},
}};
constexpr std::array<Qualifier, 5> kOfPixels{{
    {Interpolation::smooth, Location::center},
    {Interpolation::smooth, Location::centroid},
    {Interpolation::noperspective, Location::center},
    {Interpolation::noperspective, Location::centroid},
    {Interpolation::flat, Location::center},
}};
constexpr std::array<Qualifier, 7> kOfSamples{{
    {Interpolation::smooth, Location::sample},
    {Interpolation::smooth, Location::center},
    {Interpolation::smooth, Location::centroid},
    {Interpolation::noperspective, Location::sample},
    {Interpolation::noperspective, Location::center},
    {Interpolation::noperspective, Location::centroid},
    {Interpolation::flat, Location::center},
}};
static_assert(kOfSamples.size() <= kMaxSlots);

/// Returns slots with these qualifiers that hold the attributes of `slots`; empty if some do not
/// fit.
std::vector<Slot> in_slots(std::span<const Qualifier> qualifiers, const std::vector<Slot>& slots) {
  std::vector<Slot> all;
  auto next = slots.begin();
  for (const Qualifier& qualifier : qualifiers) {
    const bool is_next = next != slots.end() && next->qualifier == qualifier;
    all.push_back(is_next ? *next++ : Slot{qualifier, {}});
  }
  if (next != slots.end()) all.clear();
  return all;
}

}  // namespace

std::vector<Slot> slots_of(const cases::Case& c) {
  std::vector<std::size_t> all(c.attributes.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return slots_of(c, all);
}

std::vector<Slot> slots_of(const cases::Case& c, std::span<const std::size_t> attributes) {
  std::map<Qualifier, std::vector<std::size_t>> groups;
  for (const std::size_t i : attributes) {
    const cases::Attribute& a = c.attributes[i];
    const bool is_everywhere_alike =
        c.framebuffer.samples == 1 || a.interpolation == cases::Interpolation::flat;
    groups[{a.interpolation, is_everywhere_alike ? cases::Location::center : a.location}].push_back(
        i);
  }
  std::vector<Slot> slots;
  for (const auto& [qualifier, alike] : groups) {
    for (std::size_t i = 0; i < alike.size(); ++i) {
      if (i % kSlotSize == 0) slots.push_back({qualifier, {}});
      slots.back().attributes.push_back(alike[i]);
    }
  }
  return slots;
}

std::vector<Slot> widened(std::vector<Slot> slots, int samples) {
  const std::span<const Qualifier> least = samples == 1
                                               ? std::span<const Qualifier>(kOfOneSample).first(1)
                                               : std::span<const Qualifier>(kOfSamples).first(1);
  const std::span<const Qualifier> more = samples == 1 ? std::span<const Qualifier>(kOfOneSample)
                                                       : std::span<const Qualifier>(kOfPixels);
  if (slots.empty()) return slots;
  for (const auto& qualifiers : {least, more, std::span<const Qualifier>(kOfSamples)}) {
    if (std::vector<Slot> all = in_slots(qualifiers, slots); !all.empty()) return all;
  }
  return slots;
}

}  // namespace rastercheck::backends::vulkan
