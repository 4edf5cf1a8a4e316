#include "backends/vulkan/spirv.h"

#include <algorithm>
#include <cstddef>
#include <map>

namespace rastercheck::backends::vulkan {
namespace {

// The SPIR-V specification, 2.3 and 3: a header of five words, then instructions. The first word of
// an instruction has its word count in the upper half and its opcode in the lower half.
constexpr std::size_t kHeader = 5;
constexpr std::uint32_t kCapability = 17;
constexpr std::uint32_t kDecorate = 71;
constexpr std::uint32_t kSampleRateShading = 35;
constexpr std::uint32_t kNoPerspective = 13;
constexpr std::uint32_t kFlat = 14;
constexpr std::uint32_t kCentroid = 16;
constexpr std::uint32_t kSample = 17;
constexpr std::uint32_t kLocation = 30;

struct Instruction {
  std::span<const std::uint32_t> words;
  std::uint32_t operation() const { return words[0] & 0xffffU; }
  bool is_decoration() const { return operation() == kDecorate && words.size() >= 3; }
  std::uint32_t target() const { return words[1]; }
  std::uint32_t decoration() const { return words[2]; }
};

std::vector<Instruction> instructions_of(std::span<const std::uint32_t> shader) {
  std::vector<Instruction> all;
  for (std::size_t i = kHeader; i < shader.size();) {
    const std::size_t size = std::clamp<std::size_t>(shader[i] >> 16U, 1, shader.size() - i);
    all.push_back({shader.subspan(i, size)});
    i += size;
  }
  return all;
}

/// The locations of inputs decorated `noperspective`, by their SPIR-V id.
std::map<std::uint32_t, std::uint32_t> slot_locations(const std::vector<Instruction>& all) {
  std::map<std::uint32_t, std::uint32_t> locations;
  for (const Instruction& i : all) {
    if (i.is_decoration() && i.decoration() == kNoPerspective) locations[i.target()] = 0;
  }
  for (const Instruction& i : all) {
    if (!i.is_decoration() || i.decoration() != kLocation) continue;
    if (const auto slot = locations.find(i.target()); slot != locations.end()) {
      slot->second = i.words[3];
    }
  }
  return locations;
}

bool is_at_samples(const Qualifier& qualifier) {
  return qualifier.interpolation != cases::Interpolation::flat &&
         qualifier.location == cases::Location::sample;
}

/// The decoration that replaces a slot's decoration; 0 removes it.
std::uint32_t decoration_for(const Qualifier& qualifier, std::uint32_t decoration) {
  if (decoration == kNoPerspective) {
    if (qualifier.interpolation == cases::Interpolation::smooth) return 0;
    return qualifier.interpolation == cases::Interpolation::flat ? kFlat : kNoPerspective;
  }
  if (decoration != kSample) return decoration;
  if (is_at_samples(qualifier)) return kSample;
  const bool is_centroid = qualifier.interpolation != cases::Interpolation::flat &&
                           qualifier.location == cases::Location::centroid;
  return is_centroid ? kCentroid : 0;
}

}  // namespace

std::vector<std::uint32_t> qualified(std::span<const std::uint32_t> shader,
                                     std::span<const Qualifier> qualifiers) {
  const std::vector<Instruction> all = instructions_of(shader);
  const auto locations = slot_locations(all);
  const bool has_samples = std::any_of(qualifiers.begin(), qualifiers.end(), is_at_samples);
  std::vector<std::uint32_t> words(shader.begin(), shader.begin() + kHeader);
  for (const Instruction& i : all) {
    if (i.operation() == kCapability && i.words[1] == kSampleRateShading && !has_samples) continue;
    const auto slot = i.is_decoration() ? locations.find(i.target()) : locations.end();
    if (slot == locations.end() || slot->second >= qualifiers.size()) {
      words.insert(words.end(), i.words.begin(), i.words.end());
      continue;
    }
    const std::uint32_t decoration = decoration_for(qualifiers[slot->second], i.decoration());
    if (decoration == 0) continue;
    words.insert(words.end(), {i.words[0], i.target(), decoration});
    words.insert(words.end(), i.words.begin() + 3, i.words.end());
  }
  return words;
}

}  // namespace rastercheck::backends::vulkan
