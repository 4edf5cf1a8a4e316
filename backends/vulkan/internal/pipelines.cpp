#include "backends/vulkan/internal/pipelines.h"

#include <array>
#include <cstdint>
#include <utility>

#include "backends/vulkan/internal/pipeline.h"
#include "backends/vulkan/internal/shaders.h"
#include "backends/vulkan/spirv.h"

namespace rastercheck::backends::vulkan {
namespace {

/// The most pipelines that are kept: for each one, a driver has several hundred kilobytes of code.
constexpr std::size_t kKept = 128;

// Locations of shaders/case.vert.
constexpr std::uint32_t kNumberLocation = 1;
constexpr std::uint32_t kClipLocation = 2;
constexpr std::uint32_t kSlotLocation = 4;
constexpr std::uint32_t kPointSizeLocation = 11;

std::uint32_t bytes(std::size_t floats) {
  return static_cast<std::uint32_t>(floats * sizeof(float));
}

/// All inputs that the shader reads. An input that is not in the buffer reads the vertex's first
/// floats.
std::vector<VkVertexInputAttributeDescription> inputs_of(const PipelineKind& kind) {
  constexpr VkFormat kVector = VK_FORMAT_R32G32B32A32_SFLOAT;
  const VertexLayout layout = vertex_layout(kind);
  std::vector<VkVertexInputAttributeDescription> all{
      {0, 0, kVector, 0}, {kNumberLocation, 0, VK_FORMAT_R32_SFLOAT, bytes(kSlotSize)}};
  for (std::size_t i = 0; i * 4 < kind.clip_distances; ++i) {
    all.push_back({kClipLocation + static_cast<std::uint32_t>(i), 0, kVector,
                   bytes(layout.clip_distances + 4 * i)});
  }
  for (std::size_t i = 0; i < kMaxSlots; ++i) {
    const std::size_t begin = i < kind.slots.size() ? layout.slots + kSlotSize * i : 0;
    all.push_back({kSlotLocation + static_cast<std::uint32_t>(i), 0, kVector, bytes(begin)});
  }
  if (kind.primitive == cases::Primitive::points) {
    all.push_back({kPointSizeLocation, 0, VK_FORMAT_R32_SFLOAT, bytes(layout.point_size)});
  }
  return all;
}

/// The slots that must be evaluated at the centre, if pixels have several samples.
class Centers {
 public:
  explicit Centers(const PipelineKind& kind) {
    for (std::size_t i = 0; i < kind.slots.size(); ++i) {
      const Qualifier& q = kind.slots[i];
      const bool is_center = kind.samples > 1 && q.location == cases::Location::center &&
                             q.interpolation != cases::Interpolation::flat;
      values_[i] = is_center ? VK_TRUE : VK_FALSE;
      entries_[i] = {static_cast<std::uint32_t>(i),
                     static_cast<std::uint32_t>(i * sizeof(VkBool32)), sizeof(VkBool32)};
      any_ = any_ || is_center;
    }
    info_.mapEntryCount = static_cast<std::uint32_t>(kind.slots.size());
    info_.pMapEntries = entries_.data();
    info_.dataSize = sizeof values_;
    info_.pData = values_.data();
  }
  Centers(const Centers&) = delete;
  Centers& operator=(const Centers&) = delete;
  ~Centers() = default;

  bool any() const { return any_; }
  const VkSpecializationInfo* info() const { return any_ ? &info_ : nullptr; }

 private:
  std::array<VkBool32, kMaxSlots> values_{};
  std::array<VkSpecializationMapEntry, kMaxSlots> entries_{};
  VkSpecializationInfo info_{};
  bool any_ = false;
};

/// A set with one descriptor, which fragment shaders use.
Result<DescriptorSetLayout> make_set_layout(const Device& device, VkDescriptorType type) {
  const VkDescriptorSetLayoutBinding binding{0, type, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = 1;
  info.pBindings = &binding;
  return make_object<DescriptorSetLayout>("vkCreateDescriptorSetLayout",
                                          &vkCreateDescriptorSetLayout, device.get(), info);
}

/// A layout with one set, and push constants of `size` bytes that fragment shaders use.
Result<PipelineLayout> make_layout_with(const Device& device, VkDescriptorSetLayout set,
                                        std::size_t size) {
  const VkPushConstantRange constants{VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                      static_cast<std::uint32_t>(size)};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &constants;
  return make_object<PipelineLayout>("vkCreatePipelineLayout", &vkCreatePipelineLayout,
                                     device.get(), info);
}

std::span<const std::uint32_t> shader_of(const PipelineKind& kind, bool has_centers) {
  switch (kind.output) {
    case Output::numbers_and_slots:
      return fragment_shader(kind.slots.size(), has_centers);
    case Output::records:
      return appending_shader(kind.slots.size());
    case Output::colors:
    case Output::texture_colors:
      break;
  }
  return picture_shader(kind.slots.size(), has_centers, kind.output == Output::texture_colors);
}

std::vector<VkFormat> colors_of(const PipelineKind& kind) {
  if (kind.output == Output::records) return {};
  if (kind.output != Output::numbers_and_slots) return {kind.color};
  std::vector<VkFormat> colors(kind.slots.size() + 1, kSlotFormat);
  colors[0] = kNumberFormat;
  return colors;
}

}  // namespace

VertexLayout vertex_layout(const PipelineKind& kind) {
  VertexLayout layout;
  // The shader reads clip distances as vectors of four.
  layout.slots = layout.clip_distances + (kind.clip_distances + 3) / 4 * 4;
  // A vertex must have at least as many floats as the shader reads.
  layout.point_size = layout.slots + kSlotSize * kind.slots.size();
  layout.size = layout.point_size + (kind.primitive == cases::Primitive::points ? 1 : 0);
  return layout;
}

Result<Pipelines> Pipelines::create(const Device& device) {
  Result<PipelineLayout> layout = make_empty_layout(device);
  if (!layout) return tl::unexpected(layout.error());
  Pipelines pipelines;
  pipelines.layout_ = *std::move(layout);
  Result<DescriptorSetLayout> records = make_set_layout(device, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  if (!records) return tl::unexpected(records.error());
  pipelines.records_layout_ = *std::move(records);
  Result<PipelineLayout> appending =
      make_layout_with(device, pipelines.records_layout_.get(), sizeof(std::uint32_t));
  if (!appending) return tl::unexpected(appending.error());
  pipelines.appending_layout_ = *std::move(appending);
  Result<DescriptorSetLayout> texture =
      make_set_layout(device, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
  if (!texture) return tl::unexpected(texture.error());
  pipelines.texture_layout_ = *std::move(texture);
  Result<PipelineLayout> picture =
      make_layout_with(device, pipelines.texture_layout_.get(), sizeof(PictureConstants));
  if (!picture) return tl::unexpected(picture.error());
  pipelines.picture_layout_ = *std::move(picture);
  return pipelines;
}

/// The layout of pipelines with this output.
VkPipelineLayout Pipelines::layout_of(Output output) const {
  switch (output) {
    case Output::numbers_and_slots:
      return layout_.get();
    case Output::records:
      return appending_layout_.get();
    case Output::colors:
    case Output::texture_colors:
      break;
  }
  return picture_layout_.get();
}

Result<VkPipeline> Pipelines::get(const Device& device, const PipelineKind& kind) {
  if (const auto made = made_.find(kind); made != made_.end()) return made->second.get();
  if (made_.size() >= kKept) made_.clear();
  const Centers centers(kind);
  const std::vector<std::uint32_t> fragment_words =
      qualified(shader_of(kind, centers.any()), kind.slots);
  PipelineSource source;
  source.vertex_shader =
      vertex_shader(kind.clip_distances, kind.primitive == cases::Primitive::points);
  source.fragment_shader = fragment_words;
  source.fragment_constants = centers.info();
  source.vertex_size = bytes(vertex_layout(kind).size);
  source.inputs = inputs_of(kind);
  source.primitive = kind.primitive;
  source.topology = kind.topology;
  source.line_mode = kind.line_mode;
  source.samples = kind.samples;
  source.depth_clamp = kind.depth_clamp;
  source.negative_one_to_one = kind.negative_one_to_one;
  source.provoking_last = kind.provoking_last;
  const bool has_depth = kind.output != Output::records;
  source.depth = has_depth ? device.depth_format(kind.depth) : VK_FORMAT_UNDEFINED;
  source.writes_depth = kind.writes_depth;
  source.colors = colors_of(kind);
  source.blend = kind.blend;
  Result<Pipeline> made = make_pipeline(device, layout_of(kind.output), source);
  if (!made) return tl::unexpected(made.error());
  const VkPipeline handle = made->get();
  made_.insert_or_assign(kind, *std::move(made));
  return handle;
}

}  // namespace rastercheck::backends::vulkan
