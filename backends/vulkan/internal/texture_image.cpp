#include "backends/vulkan/internal/texture_image.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace rastercheck::backends::vulkan {
namespace {

constexpr std::size_t kChannels = 4;

/// The length that texel i of n shares with texel j of the m texels of the next level, in units of
/// 1/m texel. A texel of the next level is n units long.
int overlap(int i, int n, int j, int m) {
  return std::max(0, std::min((i + 1) * m, (j + 1) * n) - std::max(i * m, j * n));
}

/// Texel (column, row) of a level half as large: the mean of the texels that it covers, weighted by
/// overlap and rounded to an integer, halves up.
std::array<std::uint8_t, kChannels> mean_of(const cases::Texture& level, const cases::Texture& half,
                                            int column, int row) {
  std::array<std::uint64_t, kChannels> sums{};
  const int first = column * level.width / half.width;
  for (int y = row * level.height / half.height; y < level.height; ++y) {
    const int of_row = overlap(y, level.height, row, half.height);
    if (of_row == 0) break;
    for (int x = first; x < level.width; ++x) {
      const int of_column = overlap(x, level.width, column, half.width);
      if (of_column == 0) break;
      const auto weight =
          static_cast<std::uint64_t>(of_row) * static_cast<std::uint64_t>(of_column);
      const auto at =
          kChannels * (static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) +
                       static_cast<std::size_t>(x));
      for (std::size_t k = 0; k < kChannels; ++k) sums[k] += weight * level.texels[at + k];
    }
  }
  const auto whole =
      static_cast<std::uint64_t>(level.width) * static_cast<std::uint64_t>(level.height);
  std::array<std::uint8_t, kChannels> mean{};
  for (std::size_t k = 0; k < kChannels; ++k) {
    mean[k] = static_cast<std::uint8_t>((2 * sums[k] + whole) / (2 * whole));
  }
  return mean;
}

cases::Texture half_of(const cases::Texture& level) {
  cases::Texture half{std::max(1, level.width / 2), std::max(1, level.height / 2), {}};
  for (int row = 0; row < half.height; ++row) {
    for (int column = 0; column < half.width; ++column) {
      const auto mean = mean_of(level, half, column, row);
      half.texels.insert(half.texels.end(), mean.begin(), mean.end());
    }
  }
  return half;
}

VkSamplerAddressMode address_mode(cases::Wrap wrap) {
  switch (wrap) {
    case cases::Wrap::repeat:
      return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case cases::Wrap::clamp:
      return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    case cases::Wrap::mirror:
      break;
  }
  return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
}

Result<Sampler> make_texture_sampler(const Device& device, const cases::Texturing& texturing,
                                     std::size_t levels) {
  const bool is_nearest = texturing.filter == cases::Filter::nearest;
  const bool has_levels = texturing.filter == cases::Filter::trilinear;
  VkSamplerCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = is_nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
  info.minFilter = info.magFilter;
  info.mipmapMode = has_levels ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = address_mode(texturing.wrap_s);
  info.addressModeV = address_mode(texturing.wrap_t);
  info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.maxLod = static_cast<float>(levels - 1);
  return make_object<Sampler>("vkCreateSampler", &vkCreateSampler, device.get(), info);
}

Result<DescriptorPool> make_texture_pool(const Device& device) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = 1;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  return make_object<DescriptorPool>("vkCreateDescriptorPool", &vkCreateDescriptorPool,
                                     device.get(), info);
}

}  // namespace

/// Puts all levels into the buffer, one after the other.
Result<void> TextureImage::make_texels(const Device& device, const cases::Texturing& texturing) {
  std::vector<std::uint8_t> bytes;
  const auto add = [&](const cases::Texture& level) {
    levels_.push_back({static_cast<std::uint32_t>(level.width),
                       static_cast<std::uint32_t>(level.height), bytes.size()});
    bytes.insert(bytes.end(), level.texels.begin(), level.texels.end());
  };
  add(texturing.texture);
  if (texturing.filter == cases::Filter::trilinear) {
    cases::Texture level = texturing.texture;
    while (level.width > 1 || level.height > 1) {
      level = half_of(level);
      add(level);
    }
  }
  Result<HostBuffer> buffer =
      make_host_buffer(device, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  if (!buffer) return tl::unexpected(buffer.error());
  texels_ = *std::move(buffer);
  std::memcpy(texels_.bytes.data(), bytes.data(), bytes.size());
  return {};
}

Result<void> TextureImage::make_view(const Device& device) {
  const VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                               nullptr,
                               0,
                               VK_IMAGE_TYPE_2D,
                               kByteFormat,
                               {levels_[0].width, levels_[0].height, 1},
                               /*mipLevels=*/static_cast<std::uint32_t>(levels_.size()),
                               /*arrayLayers=*/1,
                               VK_SAMPLE_COUNT_1_BIT,
                               VK_IMAGE_TILING_OPTIMAL,
                               VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                               VK_SHARING_MODE_EXCLUSIVE,
                               0,
                               nullptr,
                               VK_IMAGE_LAYOUT_UNDEFINED};
  Result<DeviceImage> image = make_image(device, info);
  if (!image) return tl::unexpected(image.error());
  image_ = *std::move(image);
  VkImageViewCreateInfo view{};
  view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view.image = image_.image.get();
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = kByteFormat;
  view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, info.mipLevels, 0, 1};
  Result<ImageView> made =
      make_object<ImageView>("vkCreateImageView", &vkCreateImageView, device.get(), view);
  if (!made) return tl::unexpected(made.error());
  view_ = *std::move(made);
  return {};
}

Result<void> TextureImage::make_set(const Device& device, VkDescriptorSetLayout layout) {
  Result<DescriptorPool> pool = make_texture_pool(device);
  if (!pool) return tl::unexpected(pool.error());
  pool_ = *std::move(pool);
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = pool_.get();
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  Result<void> allocated =
      check("vkAllocateDescriptorSets", vkAllocateDescriptorSets(device.get(), &info, &set_));
  if (!allocated) return allocated;
  const VkDescriptorImageInfo image{sampler_.get(), view_.get(),
                                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  VkWriteDescriptorSet write{};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set_;
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  write.pImageInfo = &image;
  vkUpdateDescriptorSets(device.get(), 1, &write, 0, nullptr);
  return {};
}

Result<TextureImage> TextureImage::create(const Device& device, VkDescriptorSetLayout set_layout,
                                          const cases::Texturing& texturing) {
  TextureImage texture;
  texture.source_ = texturing;
  Result<void> made = texture.make_texels(device, texturing);
  if (made) made = texture.make_view(device);
  if (!made) return tl::unexpected(made.error());
  Result<Sampler> sampler = make_texture_sampler(device, texturing, texture.levels_.size());
  if (!sampler) return tl::unexpected(sampler.error());
  texture.sampler_ = *std::move(sampler);
  made = texture.make_set(device, set_layout);
  if (!made) return tl::unexpected(made.error());
  return texture;
}

bool TextureImage::is_for(const cases::Texturing& texturing) const { return source_ == texturing; }

/// Transitions the image for copying to it or, once it is filled, for reading by shaders.
void TextureImage::barrier(VkCommandBuffer commands, bool is_filled) const {
  VkImageMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image_.image.get();
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, 1};
  barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  if (is_filled) {
    barrier.srcAccessMask = std::exchange(barrier.dstAccessMask, VK_ACCESS_SHADER_READ_BIT);
    barrier.oldLayout = std::exchange(barrier.newLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }
  vkCmdPipelineBarrier(
      commands, is_filled ? VK_PIPELINE_STAGE_TRANSFER_BIT : VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
      is_filled ? VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT : VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
      nullptr, 0, nullptr, 1, &barrier);
}

void TextureImage::fill(VkCommandBuffer commands) const {
  barrier(commands, false);
  std::vector<VkBufferImageCopy> copies;
  for (const Level& level : levels_) {
    VkBufferImageCopy& copy = copies.emplace_back();
    copy.bufferOffset = level.begin;
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT,
                             static_cast<std::uint32_t>(copies.size() - 1), 0, 1};
    copy.imageExtent = {level.width, level.height, 1};
  }
  vkCmdCopyBufferToImage(commands, texels_.buffer.get(), image_.image.get(),
                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         static_cast<std::uint32_t>(copies.size()), copies.data());
  barrier(commands, true);
}

void TextureImage::bind(VkCommandBuffer commands, VkPipelineLayout layout) const {
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set_, 0,
                          nullptr);
}

}  // namespace rastercheck::backends::vulkan
