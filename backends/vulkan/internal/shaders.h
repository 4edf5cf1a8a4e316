#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rastercheck::backends::vulkan {

/// How many clip distances, 0, 1 or 8, the shader has for a case with `of_case` clip distances.
std::size_t shader_clip_distances(std::size_t of_case);

/// The SPIR-V of the shaders in shaders/, with `clip_distances` clip distances or `slots` slots (0
/// to kMaxSlots). Fragment shaders with `has_centers` have one boolean specialization constant for
/// each slot. Its id is the slot's index.
std::span<const std::uint32_t> vertex_shader(std::size_t clip_distances, bool is_of_points);
std::span<const std::uint32_t> fragment_shader(std::size_t slots, bool has_centers);
std::span<const std::uint32_t> appending_shader(std::size_t slots);
std::span<const std::uint32_t> picture_shader(std::size_t slots, bool has_centers,
                                              bool is_textured);
std::span<const std::uint32_t> samples_shader();

}  // namespace rastercheck::backends::vulkan
