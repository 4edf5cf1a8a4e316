#include "tests/bench/vulkan/frame.h"

#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <utility>

#include "backends/vulkan/internal/commands.h"
#include "backends/vulkan/internal/memory.h"
#include "backends/vulkan/internal/open_device.h"
#include "backends/vulkan/internal/pipeline.h"
#include "backends/vulkan/internal/sample_reader.h"
#include "backends/vulkan/internal/target.h"
#include "backends/vulkan/limits.h"
#include "tests/bench/vulkan/frame_fragment.h"
#include "tests/bench/vulkan/frame_vertex.h"

namespace rastercheck::backends::vulkan::bench {
namespace {

constexpr std::size_t kVertexFloats = 4 + kFrameAttributes;
static_assert(sizeof(cases::ClipVertex) == 4 * sizeof(float));

Result<HostBuffer> upload(const Device& device, std::span<const std::byte> bytes,
                          VkBufferUsageFlags usage) {
  Result<HostBuffer> buffer = make_host_buffer(device, bytes.size(), usage);
  if (buffer) std::memcpy(buffer->bytes.data(), bytes.data(), bytes.size());
  return buffer;
}

std::vector<float> vertices_of(const FrameMesh& mesh) {
  std::vector<float> floats;
  floats.reserve(mesh.positions.size() * kVertexFloats);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const cases::ClipVertex& p = mesh.positions[i];
    floats.insert(floats.end(), {p.x, p.y, p.z, p.w});
    const auto attributes = mesh.attributes.subspan(kFrameAttributes * i, kFrameAttributes);
    floats.insert(floats.end(), attributes.begin(), attributes.end());
  }
  return floats;
}

Result<Pipeline> make_frame_pipeline(const Device& device, VkPipelineLayout layout, int samples) {
  PipelineSource source;
  source.vertex_shader = spirv_frame_vertex;
  source.fragment_shader = spirv_frame_fragment;
  source.vertex_size = kVertexFloats * sizeof(float);
  source.inputs = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0},
                   {1, 0, VK_FORMAT_R32G32_SFLOAT, 4 * sizeof(float)}};
  source.samples = samples;
  source.colors = {kSlotFormat};
  return make_pipeline(device, layout, source);
}

}  // namespace

struct Frame::Impl {
  Impl(Device the_device, SampleReader the_reader, Commands the_commands, PipelineLayout the_layout)
      : device(std::move(the_device)),
        reader(std::move(the_reader)),
        commands(std::move(the_commands)),
        layout(std::move(the_layout)) {}

  void record(VkCommandBuffer buffer) const;

  Device device;
  SampleReader reader;
  Commands commands;
  PipelineLayout layout;
  std::map<int, Pipeline> pipelines;  ///< by number of samples
  HostBuffer vertices;
  HostBuffer indices;
  std::uint32_t index_count = 0;
  std::optional<Target> target;
};

Frame::Frame(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Frame::Frame(Frame&& other) noexcept = default;
Frame& Frame::operator=(Frame&& other) noexcept = default;
Frame::~Frame() = default;

std::string Frame::description() const { return impl_->device.description(); }

Result<Frame> Frame::create(const std::string& device) {
  Result<Device> opened = open_device(device);
  if (!opened) return tl::unexpected(opened.error());
  Result<SampleReader> reader = SampleReader::create(*opened);
  if (!reader) return tl::unexpected(reader.error());
  Result<Commands> commands = Commands::create(*opened);
  if (!commands) return tl::unexpected(commands.error());
  Result<PipelineLayout> layout = make_empty_layout(*opened);
  if (!layout) return tl::unexpected(layout.error());
  return Frame(std::make_unique<Impl>(*std::move(opened), *std::move(reader), *std::move(commands),
                                      *std::move(layout)));
}

Result<void> Frame::take(const FrameMesh& mesh, const cases::FramebufferSize& size) {
  impl_->target.reset();
  cases::Case c;
  c.framebuffer = size;
  c.viewport.width = static_cast<float>(size.width);
  c.viewport.height = static_cast<float>(size.height);
  const std::string missing = lacks(impl_->device.limits(), c);
  if (!missing.empty()) return failed("it lacks " + missing, Failure::unsupported);
  if (mesh.triangles.empty() ||
      mesh.attributes.size() != kFrameAttributes * mesh.positions.size()) {
    return failed("a mesh without triangles, or without two attributes of each vertex");
  }
  if (!impl_->pipelines.contains(size.samples)) {
    Result<Pipeline> pipeline =
        make_frame_pipeline(impl_->device, impl_->layout.get(), size.samples);
    if (!pipeline) return tl::unexpected(pipeline.error());
    impl_->pipelines.emplace(size.samples, *std::move(pipeline));
  }
  const std::vector<float> floats = vertices_of(mesh);
  Result<HostBuffer> vertices =
      upload(impl_->device, std::as_bytes(std::span(floats)), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  if (!vertices) return tl::unexpected(vertices.error());
  Result<HostBuffer> indices =
      upload(impl_->device, std::as_bytes(mesh.triangles), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  if (!indices) return tl::unexpected(indices.error());
  impl_->vertices = *std::move(vertices);
  impl_->indices = *std::move(indices);
  impl_->index_count = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  TargetShape shape{size.width, size.height, size.samples, 1};
  shape.has_numbers = false;
  Result<Target> target = Target::create(impl_->device, impl_->reader, shape);
  if (!target) return tl::unexpected(target.error());
  impl_->target = *std::move(target);
  return {};
}

void Frame::Impl::record(VkCommandBuffer buffer) const {
  const TargetShape& shape = target->shape();
  const VkViewport viewport{0, 0, static_cast<float>(shape.width), static_cast<float>(shape.height),
                            0, 1};
  const VkRect2D scissor{
      {0, 0}, {static_cast<std::uint32_t>(shape.width), static_cast<std::uint32_t>(shape.height)}};
  const VkBuffer from = vertices.buffer.get();
  constexpr VkDeviceSize kBegin = 0;
  target->begin(buffer);
  vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.at(shape.samples).get());
  vkCmdBindVertexBuffers(buffer, 0, 1, &from, &kBegin);
  vkCmdBindIndexBuffer(buffer, indices.buffer.get(), 0, VK_INDEX_TYPE_UINT32);
  vkCmdSetViewport(buffer, 0, 1, &viewport);
  vkCmdSetScissor(buffer, 0, 1, &scissor);
  vkCmdSetCullMode(buffer, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(buffer, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  vkCmdSetDepthCompareOp(buffer, VK_COMPARE_OP_LESS);
  target->begin_layer(buffer, 0, 1);
  vkCmdDrawIndexed(buffer, index_count, 1, 0, 0, 0);
  Target::end_layer(buffer);
}

Result<void> Frame::draw() {
  if (!impl_->target) return failed("there is nothing to draw");
  return impl_->commands.run(impl_->device,
                             [this](VkCommandBuffer buffer) { impl_->record(buffer); });
}

Result<FramePicture> Frame::read() {
  if (!impl_->target) return failed("there is nothing to read");
  Result<void> drawn = impl_->commands.run(impl_->device, [this](VkCommandBuffer buffer) {
    impl_->record(buffer);
    impl_->target->end(buffer, impl_->reader, 1);
  });
  if (!drawn) return tl::unexpected(drawn.error());
  return FramePicture{impl_->target->slot(0, 0), impl_->target->depths(0)};
}

}  // namespace rastercheck::backends::vulkan::bench
