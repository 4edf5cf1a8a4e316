#include "backends/vulkan/internal/target.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "backends/unorm_depth.h"
#include "backends/vulkan/slots.h"

namespace rastercheck::backends::vulkan {
namespace {

VkImageAspectFlags aspect(bool is_depth) {
  return is_depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

/// A multiple of every alignment that a device may require of descriptors' offsets.
constexpr std::size_t kAlignment = 256;

std::size_t part_bytes(const TargetShape& shape, std::size_t components) {
  const std::size_t bytes = shape.layer_samples() * shape.layers * components * sizeof(float);
  return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

bool is_depth_format(VkFormat format) {
  return format != kNumberFormat && format != kSlotFormat && format != kByteFormat;
}

VkImageCreateInfo image_info(const TargetShape& shape, VkFormat format, VkImageUsageFlags usage) {
  const VkExtent3D extent{static_cast<std::uint32_t>(shape.width),
                          static_cast<std::uint32_t>(shape.height), 1};
  return {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
          nullptr,
          0,
          VK_IMAGE_TYPE_2D,
          format,
          extent,
          /*mipLevels=*/1,
          static_cast<std::uint32_t>(shape.layers),
          static_cast<VkSampleCountFlagBits>(shape.samples),
          VK_IMAGE_TILING_OPTIMAL,
          usage,
          VK_SHARING_MODE_EXCLUSIVE,
          0,
          nullptr,
          VK_IMAGE_LAYOUT_UNDEFINED};
}

Result<ImageView> make_view(const Device& device, VkImage image, VkFormat format,
                            VkImageViewType type, std::uint32_t first, std::uint32_t count) {
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = image;
  info.viewType = type;
  info.format = format;
  info.subresourceRange = {aspect(is_depth_format(format)), 0, 1, first, count};
  return make_object<ImageView>("vkCreateImageView", &vkCreateImageView, device.get(), info);
}

VkRenderingAttachmentInfo attachment(VkImageView view, VkImageLayout layout) {
  VkRenderingAttachmentInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  info.imageView = view;
  info.imageLayout = layout;
  info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  return info;
}

}  // namespace

std::size_t TargetShape::bytes() const {
  const std::size_t single = has_numbers ? 2 : 1;
  return 2 * (single * part_bytes(*this, 1) + slots * part_bytes(*this, kSlotSize));
}

Result<void> Target::add_part(const Device& device, VkFormat format, std::size_t components) {
  Part part;
  part.is_depth = is_depth_format(format);
  part.has_stencil = format == VK_FORMAT_D24_UNORM_S8_UINT;
  part.components = components;
  const auto drawn =
      static_cast<VkImageUsageFlags>(part.is_depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                   : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  const auto read = static_cast<VkImageUsageFlags>(
      has_samples_read(part) ? VK_IMAGE_USAGE_SAMPLED_BIT : VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  Result<DeviceImage> image = make_image(device, image_info(shape_, format, drawn | read));
  if (!image) return tl::unexpected(image.error());
  part.image = *std::move(image);
  if (resolves(part)) {
    TargetShape pixels = shape_;
    pixels.samples = 1;
    constexpr VkImageUsageFlags kCopied =
        VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    Result<DeviceImage> resolved = make_image(device, image_info(pixels, format, kCopied));
    if (!resolved) return tl::unexpected(resolved.error());
    part.resolved = *std::move(resolved);
  }
  const VkImage handle = part.image.image.get();
  for (std::uint32_t i = 0; i < shape_.layers; ++i) {
    Result<ImageView> view = make_view(device, handle, format, VK_IMAGE_VIEW_TYPE_2D, i, 1);
    if (!view) return tl::unexpected(view.error());
    part.views.push_back(*std::move(view));
  }
  if (has_samples_read(part)) {
    Result<ImageView> whole = make_view(device, handle, format, VK_IMAGE_VIEW_TYPE_2D_ARRAY, 0,
                                        static_cast<std::uint32_t>(shape_.layers));
    if (!whole) return tl::unexpected(whole.error());
    part.whole = *std::move(whole);
  }
  parts_.push_back(std::move(part));
  return {};
}

Result<Target> Target::create(const Device& device, const SampleReader& reader,
                              const TargetShape& shape) {
  Target target;
  target.shape_ = shape;
  Result<void> added = target.add_part(device, device.depth_format(shape.depth), 1);
  for (std::size_t i = 0; added && i < shape.slots; ++i) {
    added = target.add_part(device, shape.slot_format, kSlotSize);
  }
  if (added && shape.has_numbers) added = target.add_part(device, kNumberFormat, 1);
  if (!added) return tl::unexpected(added.error());

  std::size_t size = 0;
  for (Part& part : target.parts_) {
    part.begin = std::exchange(size, size + part_bytes(shape, part.components));
  }
  Result<HostBuffer> buffer = make_host_buffer(
      device, size, VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  if (!buffer) return tl::unexpected(buffer.error());
  target.buffer_ = *std::move(buffer);
  Result<void> bound = target.bind_samples(device, reader);
  if (!bound) return tl::unexpected(bound.error());
  return target;
}

/// Binds the images whose samples are read one by one.
Result<void> Target::bind_samples(const Device& device, const SampleReader& reader) {
  std::vector<SampleReader::Source> sources;
  sources.reserve(parts_.size());
  for (const Part& part : parts_) {
    if (!has_samples_read(part)) continue;
    sources.push_back(
        {part.whole.get(), buffer_.buffer.get(), part.begin, part_bytes(shape_, part.components)});
  }
  if (sources.empty()) return {};
  Result<SampleReader::Bindings> bindings = reader.bind(device, sources);
  if (!bindings) return tl::unexpected(bindings.error());
  bindings_ = *std::move(bindings);
  auto next = bindings_.sets.begin();
  for (Part& part : parts_) {
    if (has_samples_read(part)) part.set = *next++;
  }
  return {};
}

/// True if the mean of a pixel's samples is read. Depths have no mean.
bool Target::resolves(const Part& part) const {
  return shape_.resolves && shape_.samples > 1 && !part.is_depth;
}

bool Target::has_samples_read(const Part& part) const {
  return shape_.samples > 1 && !resolves(part);
}

/// Transitions the image for drawing into it, with or without its content, or from drawing to
/// reading.
void Target::barrier(VkCommandBuffer commands, const Part& part, Change change) const {
  const VkImageLayout drawn = part.is_depth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                                            : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  const VkAccessFlags drawing =
      part.is_depth ? VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                          VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT
                    : VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  const VkPipelineStageFlags drawing_stage =
      part.is_depth
          ? VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT
          : static_cast<VkPipelineStageFlags>(VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT);
  const bool has_samples = has_samples_read(part);
  VkImageMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = part.image.image.get();
  // Both aspects of an image must have the same layout.
  VkImageAspectFlags aspects = aspect(part.is_depth);
  if (part.has_stencil) aspects |= VK_IMAGE_ASPECT_STENCIL_BIT;
  barrier.subresourceRange = {aspects, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
  const VkImageLayout readable =
      has_samples ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  if (change != Change::read) {
    barrier.dstAccessMask = drawing;
    barrier.oldLayout = change == Change::reuse ? readable : VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.newLayout = drawn;
    // Commands::run() waits for earlier commands.
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, drawing_stage, 0, 0, nullptr,
                         0, nullptr, 1, &barrier);
    return;
  }
  barrier.srcAccessMask = drawing;
  barrier.dstAccessMask = has_samples ? VK_ACCESS_SHADER_READ_BIT : VK_ACCESS_TRANSFER_READ_BIT;
  barrier.oldLayout = drawn;
  barrier.newLayout = readable;
  vkCmdPipelineBarrier(
      commands, drawing_stage,
      has_samples ? VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT : VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
      nullptr, 0, nullptr, 1, &barrier);
}

void Target::begin(VkCommandBuffer commands) const {
  for (const Part& part : parts_) barrier(commands, part, Change::discard);
}

void Target::begin_over_depths(VkCommandBuffer commands) const {
  for (const Part& part : parts_) {
    barrier(commands, part, part.is_depth ? Change::reuse : Change::discard);
  }
}

void Target::begin_layer(VkCommandBuffer commands, std::size_t layer,
                         std::optional<float> clear_depth) const {
  const auto color = [&](const Part& part) {
    return attachment(part.views[layer].get(), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  };
  std::vector<VkRenderingAttachmentInfo> colors;
  if (shape_.has_numbers) colors.push_back(color(parts_.back()));
  for (std::size_t i = 0; i < shape_.slots; ++i) colors.push_back(color(parts_[1 + i]));
  VkRenderingAttachmentInfo depth =
      attachment(parts_[0].views[layer].get(), VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
  if (!clear_depth) depth.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  depth.clearValue.depthStencil = {clear_depth.value_or(1), 0};
  VkRenderingInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.renderArea.extent = {static_cast<std::uint32_t>(shape_.width),
                            static_cast<std::uint32_t>(shape_.height)};
  info.layerCount = 1;
  info.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
  info.pColorAttachments = colors.data();
  info.pDepthAttachment = &depth;
  vkCmdBeginRendering(commands, &info);
}

void Target::end_layer(VkCommandBuffer commands) { vkCmdEndRendering(commands); }

/// Leaves the resolved image ready for copying.
void Target::resolve(VkCommandBuffer commands, const Part& part, std::size_t layers) const {
  VkImageMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = part.resolved.image.get();
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
  barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
                       0, 0, nullptr, 0, nullptr, 1, &barrier);
  VkImageResolve region{};
  region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, static_cast<std::uint32_t>(layers)};
  region.dstSubresource = region.srcSubresource;
  region.extent = {static_cast<std::uint32_t>(shape_.width),
                   static_cast<std::uint32_t>(shape_.height), 1};
  vkCmdResolveImage(commands, part.image.image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                    part.resolved.image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
  barrier.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0,
                       0, nullptr, 0, nullptr, 1, &barrier);
}

void Target::end(VkCommandBuffer commands, const SampleReader& reader, std::size_t layers) const {
  const auto width = static_cast<std::uint32_t>(shape_.width);
  const auto height = static_cast<std::uint32_t>(shape_.height);
  for (const Part& part : parts_) {
    barrier(commands, part, Change::read);
    if (resolves(part)) resolve(commands, part, layers);
    if (has_samples_read(part)) {
      reader.record(commands, part.set,
                    {width, height, static_cast<std::uint32_t>(shape_.samples),
                     static_cast<std::uint32_t>(part.components)},
                    layers);
      continue;
    }
    VkBufferImageCopy copy{};
    copy.bufferOffset = part.begin;
    copy.imageSubresource = {aspect(part.is_depth), 0, 0, static_cast<std::uint32_t>(layers)};
    copy.imageExtent = {width, height, 1};
    const DeviceImage& from = resolves(part) ? part.resolved : part.image;
    vkCmdCopyImageToBuffer(commands, from.image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           buffer_.buffer.get(), 1, &copy);
  }
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands,
                       VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                       VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

std::span<const float> Target::read(const Part& part, std::size_t layer) const {
  const std::size_t count = shape_.layer_samples() * part.components;
  const auto* const floats = reinterpret_cast<const float*>(buffer_.bytes.data() + part.begin);
  return {floats + layer * count, count};
}

std::span<const float> Target::numbers(std::size_t layer) const {
  return read(parts_.back(), layer);
}

std::vector<float> Target::depths(std::size_t layer) const {
  const int bits = cases::unorm_bits(shape_.depth);
  if (bits == 0 || shape_.samples > 1) {
    const std::span<const float> all = read(parts_[0], layer);
    return {all.begin(), all.end()};
  }
  // Copies of 16 bits are packed; of 24 bits, each takes the low bits of a 32-bit word.
  const std::size_t count = shape_.layer_samples();
  const std::byte* const begin = buffer_.bytes.data() + parts_[0].begin;
  std::vector<float> depths(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = layer * count + i;
    const std::uint32_t k = bits == 16
                                ? reinterpret_cast<const std::uint16_t*>(begin)[at]
                                : reinterpret_cast<const std::uint32_t*>(begin)[at] & 0xFFFFFFU;
    depths[i] = unorm_depth(k, bits);
  }
  return depths;
}

std::span<const float> Target::slot(std::size_t slot, std::size_t layer) const {
  return read(parts_[1 + slot], layer);
}

std::vector<float> Target::colors(std::size_t slot, std::size_t layer) const {
  const Part& part = parts_[1 + slot];
  const std::size_t samples = resolves(part) ? static_cast<std::size_t>(shape_.samples) : 1;
  const std::size_t count = shape_.layer_samples() / samples * part.components;
  const std::byte* const begin = buffer_.bytes.data() + part.begin;
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(begin) + layer * count;
  const auto* const floats = reinterpret_cast<const float*>(begin) + layer * count;
  if (shape_.slot_format != kByteFormat) return {floats, floats + count};
  std::vector<float> colors(count);
  for (std::size_t i = 0; i < count; ++i) {
    // A shader fetches k/255 with an error of a few units in the last place.
    const float k =
        has_samples_read(part) ? std::round(floats[i] * 255) : static_cast<float>(bytes[i]);
    colors[i] = k / 255;
  }
  return colors;
}

}  // namespace rastercheck::backends::vulkan
