#pragma once

// Translates a case into Vulkan commands.

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "backends/indexed_draw.h"
#include "backends/vulkan/internal/pipelines.h"
#include "backends/vulkan/limits.h"
#include "backends/vulkan/slots.h"
#include "cases/case.h"

namespace rastercheck::backends::vulkan {

/// The slots that one draw writes.
using Pass = std::span<const Slot>;

PipelineKind kind_of(const cases::Case& c, const Limits& limits, Pass pass);

/// Appends the vertices of the triangle, line or point with this index, with `number` as its
/// number.
void append_primitive(const cases::Case& c, Pass pass, const VertexLayout& layout,
                      std::size_t index, std::size_t number, std::vector<float>& floats);
/// Appends the vertices of a draw of indices, with their numbers.
void append_places(const cases::Case& c, Pass pass, const VertexLayout& layout,
                   const IndexedDraw& indexed, std::vector<float>& floats);
/// The number of vertices that append_primitive() appends for so many triangles, lines or points.
std::uint32_t vertices_of(const cases::Case& c, std::size_t primitives);

/// Call while recording, before draws: binds the pipeline, the vertices and all state of the case.
void bind_case(VkCommandBuffer buffer, const cases::Case& c, VkPipeline pipeline,
               VkBuffer vertices);

/// Call while recording, after bind_case(): draws the indices, which the buffer holds.
void draw_indices(VkCommandBuffer buffer, const IndexedDraw& indexed, VkBuffer indices);

}  // namespace rastercheck::backends::vulkan
