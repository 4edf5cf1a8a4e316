#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rastercheck::backends::vulkan {

/// Of so many clip distances as a case has, how many the shader for it has: 0, 1 or 8.
std::size_t shader_clip_distances(std::size_t of_case);

/// SPIR-V of shaders/: with that many clip distances, that many slots (0 to kMaxSlots). Those with
/// centres have a boolean constant for each slot, by its index.
std::span<const std::uint32_t> vertex_shader(std::size_t clip_distances);
std::span<const std::uint32_t> fragment_shader(std::size_t slots, bool has_centers);
std::span<const std::uint32_t> appending_shader(std::size_t slots);
std::span<const std::uint32_t> samples_shader();

}  // namespace rastercheck::backends::vulkan
