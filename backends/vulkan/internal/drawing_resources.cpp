#include "backends/vulkan/internal/drawing_resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

namespace rastercheck::backends::vulkan {
namespace {

/// The most bytes of one layer, out of the 4 GiB that a process has.
constexpr std::size_t kMost = std::size_t{1} << 30U;

/// Copies bytes to a buffer, which is replaced by a larger one if it has too little room.
Result<void> copy_to(HostBuffer& buffer, const Device& device, std::span<const std::byte> bytes,
                     VkBufferUsageFlags usage) {
  if (buffer.bytes.size() < bytes.size()) {
    buffer = {};
    Result<HostBuffer> made = make_host_buffer(device, std::bit_ceil(bytes.size()), usage);
    if (!made) return tl::unexpected(made.error());
    buffer = *std::move(made);
  }
  std::copy(bytes.begin(), bytes.end(), buffer.bytes.begin());  // none may be copied to none
  return {};
}

}  // namespace

Result<void> check_memory(const TargetShape& shape) {
  TargetShape layer = shape;
  layer.layers = 1;
  if (layer.bytes() <= kMost) return {};
  return failed(fmt::format("{} x {} pixels of {} samples and {} vectors of attributes do not fit "
                            "into the memory of its process",
                            shape.width, shape.height, shape.samples, shape.slots),
                Failure::unsupported);
}

Result<DrawingResources> DrawingResources::create(const Device& device) {
  Result<Pipelines> pipelines = Pipelines::create(device);
  if (!pipelines) return tl::unexpected(pipelines.error());
  Result<SampleReader> reader = SampleReader::create(device);
  if (!reader) return tl::unexpected(reader.error());
  Result<Commands> commands = Commands::create(device);
  if (!commands) return tl::unexpected(commands.error());
  return DrawingResources{&device, *std::move(pipelines), *std::move(reader), *std::move(commands)};
}

/// Reuses the target of the previous case if it fits. Otherwise makes one with at least that many
/// layers.
Result<const Target*> DrawingResources::target_for(TargetShape shape) {
  if (Result<void> fits = check_memory(shape); !fits) return tl::unexpected(fits.error());
  shape.layers = std::bit_ceil(shape.layers);
  if (target) {
    TargetShape there = target->shape();
    const bool has_layers = there.layers >= shape.layers;
    there.layers = shape.layers;
    if (has_layers && there == shape) return &*target;
  }
  target.reset();
  Result<Target> made = Target::create(*device, reader, shape);
  if (!made) return tl::unexpected(made.error());
  target = *std::move(made);
  return &*target;
}

Result<DepthReading> DrawingResources::depth_reading(const cases::Case& c) {
  const int bits = cases::unorm_bits(c.depth_format);
  const int samples = c.framebuffer.samples;
  if (bits == 0 || samples == 1) return DepthReading{bits, std::nullopt};
  if (const auto known = fetches.find({bits, samples}); known == fetches.end()) {
    const std::vector<std::uint32_t> stored = telling_depths(bits);
    const Result<const Target*> of_shape =
        target_for({1, 1, samples, 0, stored.size(), c.depth_format});
    if (!of_shape) return tl::unexpected(of_shape.error());
    const Result<void> done = commands.run(*device, [&](VkCommandBuffer buffer) {
      (*of_shape)->begin(buffer);
      for (std::size_t i = 0; i < stored.size(); ++i) {
        (*of_shape)->begin_layer(buffer, i, unorm_depth(stored[i], bits));
        Target::end_layer(buffer);
      }
      (*of_shape)->end(buffer, reader, stored.size());
    });
    if (!done) return tl::unexpected(done.error());
    std::vector<float> fetched;
    fetched.reserve(stored.size());
    for (std::size_t i = 0; i < stored.size(); ++i) fetched.push_back((*of_shape)->depths(i)[0]);
    fetches[{bits, samples}] = fetch_of(fetched, bits);
  }
  const std::optional<UnormFetch> fetch = fetches[{bits, samples}];
  if (fetch) return DepthReading{bits, fetch};
  return failed(fmt::format("its shaders do not fetch depths of {} bits exactly", bits),
                Failure::unsupported);
}

Result<void> DrawingResources::hand_over(const std::vector<float>& floats) {
  return copy_to(vertices, *device, std::as_bytes(std::span(floats)),
                 VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
}

Result<void> DrawingResources::hand_over_indices(const std::vector<std::uint32_t>& order) {
  return copy_to(indices, *device, std::as_bytes(std::span(order)),
                 VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
}

}  // namespace rastercheck::backends::vulkan
