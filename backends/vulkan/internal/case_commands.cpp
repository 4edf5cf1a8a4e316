#include "backends/vulkan/internal/case_commands.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "backends/primitive_vertices.h"
#include "backends/vulkan/internal/shaders.h"

namespace rastercheck::backends::vulkan {
namespace {

void append_vertex(const cases::Case& c, Pass pass, const VertexLayout& layout, std::size_t number,
                   std::uint32_t vertex, std::vector<float>& floats) {
  const std::size_t begin = floats.size();
  floats.resize(begin + layout.size, 0.0F);
  const std::span<float> all = std::span(floats).subspan(begin);
  const cases::ClipVertex& p = c.positions[vertex];
  std::ranges::copy(std::array{p.x, p.y, p.z, p.w, static_cast<float>(number)}, all.begin());
  // Clip distances that the case lacks are 1, so that they clip nothing.
  std::ranges::fill(all.subspan(layout.clip_distances, layout.slots - layout.clip_distances), 1.0F);
  std::ranges::copy(c.clip_distances_of(vertex), all.subspan(layout.clip_distances).begin());
  if (c.primitive == cases::Primitive::points) all[layout.point_size] = c.point_size;
  const std::span<const float> values = c.attributes_of(vertex);
  for (std::size_t s = 0; s < pass.size(); ++s) {
    const std::vector<std::size_t>& attributes = pass[s].attributes;
    for (std::size_t k = 0; k < attributes.size(); ++k) {
      all[layout.slots + s * kSlotSize + k] = values[attributes[k]];
    }
  }
}

VkViewport viewport_of(const cases::Viewport& v) {
  return {v.x, v.y, v.width, v.height, v.min_depth, v.max_depth};
}

/// Clips the scissor rectangle to the framebuffer, because Vulkan allows no negative coordinates.
VkRect2D scissor_of(const cases::Case& c) {
  const int width = c.framebuffer.width;
  const int height = c.framebuffer.height;
  const cases::Scissor whole{0, 0, width, height};
  const cases::Scissor s = c.scissor.value_or(whole);
  const int min_x = std::clamp(s.x, 0, width);
  const int min_y = std::clamp(s.y, 0, height);
  const int max_x = std::clamp(s.x + s.width, min_x, width);
  const int max_y = std::clamp(s.y + s.height, min_y, height);
  return {{min_x, min_y},
          {static_cast<std::uint32_t>(max_x - min_x), static_cast<std::uint32_t>(max_y - min_y)}};
}

VkCullModeFlags cull_of(cases::Cull cull) {
  if (cull == cases::Cull::none) return VK_CULL_MODE_NONE;
  return cull == cases::Cull::back ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_FRONT_BIT;
}

/// Vulkan defines counter-clockwise for a window whose y points down. With OpenGL's rules y points
/// up. A window y lies in the same row of the framebuffer either way, but with OpenGL's rules row 0
/// is displayed at the bottom, so the winding is reversed.
VkFrontFace front_face_of(const cases::Case& c) {
  const bool is_ccw = c.front_face == cases::FrontFace::ccw;
  const bool is_up = c.rules == cases::Rules::opengl;
  return is_ccw != is_up ? VK_FRONT_FACE_COUNTER_CLOCKWISE : VK_FRONT_FACE_CLOCKWISE;
}

VkCompareOp compare_op_of(const cases::Case& c) {
  if (c.depth_test == cases::DepthTest::none) return VK_COMPARE_OP_ALWAYS;
  return c.depth_clear ? VK_COMPARE_OP_LESS : VK_COMPARE_OP_LESS_OR_EQUAL;
}

/// The mode that draws a case's lines as it asks; lacks() says which a device has.
VkLineRasterizationModeEXT line_mode_of(const cases::Case& c, const Limits& limits) {
  if (c.primitive != cases::Primitive::lines) return VK_LINE_RASTERIZATION_MODE_DEFAULT_EXT;
  if (c.line_mode == cases::LineMode::bresenham) return VK_LINE_RASTERIZATION_MODE_BRESENHAM_EXT;
  const bool is_rectangular = c.line_mode == cases::LineMode::rectangular;
  return is_rectangular && limits.rectangular_lines ? VK_LINE_RASTERIZATION_MODE_RECTANGULAR_EXT
                                                    : VK_LINE_RASTERIZATION_MODE_DEFAULT_EXT;
}

}  // namespace

PipelineKind kind_of(const cases::Case& c, const Limits& limits, Pass pass) {
  PipelineKind kind;
  kind.primitive = c.primitive;
  kind.line_mode = line_mode_of(c, limits);
  kind.samples = c.framebuffer.samples;
  kind.depth_clamp = c.depth_clamp;
  kind.negative_one_to_one = c.rules == cases::Rules::opengl;
  // If this feature is missing, cases have no flat attributes.
  kind.provoking_last = kind.negative_one_to_one && limits.provoking_vertex_last;
  kind.depth = c.depth_format;
  kind.clip_distances = shader_clip_distances(c.clip_distance_count);
  for (const Slot& slot : pass) kind.slots.push_back(slot.qualifier);
  return kind;
}

void append_primitive(const cases::Case& c, Pass pass, const VertexLayout& layout,
                      std::size_t index, std::size_t number, std::vector<float>& floats) {
  for (const std::uint32_t vertex : backends::vertices_of(c.primitive, c.triangles[index])) {
    append_vertex(c, pass, layout, number, vertex, floats);
  }
}

void append_places(const cases::Case& c, Pass pass, const VertexLayout& layout,
                   const IndexedDraw& indexed, std::vector<float>& floats) {
  for (std::size_t place = 0; place < indexed.vertices.size(); ++place) {
    const auto number = static_cast<std::size_t>(indexed.numbers[place]);
    append_vertex(c, pass, layout, number, indexed.vertices[place], floats);
  }
}

std::uint32_t vertices_of(const cases::Case& c, std::size_t primitives) {
  return static_cast<std::uint32_t>(vertices_per(c.primitive) * primitives);
}

void bind_case(VkCommandBuffer buffer, const cases::Case& c, VkPipeline pipeline,
               VkBuffer vertices) {
  const VkViewport viewport = viewport_of(c.viewport);
  const VkRect2D scissor = scissor_of(c);
  constexpr VkDeviceSize kBegin = 0;
  vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  vkCmdBindVertexBuffers(buffer, 0, 1, &vertices, &kBegin);
  vkCmdSetViewport(buffer, 0, 1, &viewport);
  vkCmdSetScissor(buffer, 0, 1, &scissor);
  vkCmdSetCullMode(buffer, cull_of(c.cull));
  vkCmdSetFrontFace(buffer, front_face_of(c));
  vkCmdSetDepthCompareOp(buffer, compare_op_of(c));
  const cases::DepthBias bias = c.depth_bias.is_none() ? cases::DepthBias() : c.depth_bias;
  vkCmdSetDepthBiasEnable(buffer, bias.is_none() ? VK_FALSE : VK_TRUE);
  vkCmdSetDepthBias(buffer, bias.constant, bias.clamp, bias.slope);
  if (c.primitive == cases::Primitive::lines) vkCmdSetLineWidth(buffer, c.line_width);
}

void draw_indices(VkCommandBuffer buffer, const IndexedDraw& indexed, VkBuffer indices) {
  vkCmdBindIndexBuffer(buffer, indices, 0, VK_INDEX_TYPE_UINT32);
  if (indexed.topology != cases::Topology::triangles) {
    vkCmdDrawIndexed(buffer, static_cast<std::uint32_t>(indexed.order.size()), 1, 0, 0, 0);
    return;
  }
  for (const std::span<const std::uint32_t> run : runs_of(indexed.order)) {
    const auto first = static_cast<std::uint32_t>(run.data() - indexed.order.data());
    vkCmdDrawIndexed(buffer, static_cast<std::uint32_t>(run.size()), 1, first, 0, 0);
  }
}

}  // namespace rastercheck::backends::vulkan
