#include "backends/vulkan/slots.h"

#include <map>
#include <utility>

namespace rastercheck::backends::vulkan {

std::vector<Slot> slots_of(const cases::Case& c) {
  std::map<Qualifier, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < c.attributes.size(); ++i) {
    const cases::Attribute& a = c.attributes[i];
    const bool is_everywhere_alike =
        c.framebuffer.samples == 1 || a.interpolation == cases::Interpolation::flat;
    groups[{a.interpolation, is_everywhere_alike ? cases::Location::center : a.location}].push_back(
        i);
  }
  std::vector<Slot> slots;
  for (const auto& [qualifier, attributes] : groups) {
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      if (i % kSlotSize == 0) slots.push_back({qualifier, {}});
      slots.back().attributes.push_back(attributes[i]);
    }
  }
  return slots;
}

}  // namespace rastercheck::backends::vulkan
