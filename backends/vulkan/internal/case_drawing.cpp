#include "backends/vulkan/internal/case_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "backends/vulkan/internal/commands.h"
#include "backends/vulkan/internal/memory.h"
#include "backends/vulkan/internal/pipelines.h"
#include "backends/vulkan/internal/sample_reader.h"
#include "backends/vulkan/internal/shaders.h"
#include "backends/vulkan/internal/target.h"
#include "backends/vulkan/slots.h"

namespace rastercheck::backends::vulkan {
namespace {

/// Layers that are drawn together take this at most, bytes: more are no quicker.
constexpr std::size_t kTogether = std::size_t{16} << 20U;
constexpr std::size_t kMaxLayers = 64;
/// One layer may take this, of the 4 GiB that a process has.
constexpr std::size_t kMost = std::size_t{1} << 30U;
/// Whole numbers up to here are float32.
constexpr std::size_t kMaxTriangles = std::size_t{1} << 24U;

/// The triangles of one layer, in the order of drawing.
using Layer = std::vector<std::size_t>;

/// Of all slots those that one drawing writes.
using Pass = std::span<const Slot>;

std::vector<Pass> passes_of(std::span<const Slot> slots, std::size_t most) {
  std::vector<Pass> passes;
  do {
    const std::size_t count = std::min(most, slots.size());
    passes.push_back(slots.first(count));
    slots = slots.subspan(count);
  } while (!slots.empty());
  return passes;
}

std::vector<Layer> layers_of(const cases::Case& c) {
  std::vector<Layer> layers;
  if (c.depth_test == cases::DepthTest::none) {
    for (std::size_t i = 0; i < c.triangles.size(); ++i) layers.push_back({i});
    return layers;
  }
  // A target is cleared to depth 1, at which there may be fragments, so that the test is
  // `less or equal`; the first of equal ones is left where they are drawn from last to first.
  Layer all(c.triangles.size());
  std::iota(all.rbegin(), all.rend(), std::size_t{0});
  layers.push_back(std::move(all));
  return layers;
}

PipelineKind kind_of(const cases::Case& c, const Limits& limits, Pass pass) {
  PipelineKind kind;
  kind.samples = c.framebuffer.samples;
  kind.depth_clamp = c.depth_clamp;
  kind.negative_one_to_one = c.rules == cases::Rules::opengl;
  // Where a device does not have it there is no flat attribute.
  kind.provoking_last = kind.negative_one_to_one && limits.provoking_vertex_last;
  kind.clip_distances = shader_clip_distances(c.clip_distance_count);
  for (const Slot& slot : pass) kind.slots.push_back(slot.qualifier);
  return kind;
}

void append_vertex(const cases::Case& c, Pass pass, const VertexLayout& layout, std::size_t number,
                   std::uint32_t vertex, std::vector<float>& floats) {
  const std::size_t begin = floats.size();
  floats.resize(begin + layout.size, 0.0F);
  const std::span<float> all = std::span(floats).subspan(begin);
  const cases::ClipVertex& p = c.positions[vertex];
  std::ranges::copy(std::array{p.x, p.y, p.z, p.w, static_cast<float>(number)}, all.begin());
  // Distances that the case does not have clip nothing.
  std::ranges::fill(all.subspan(layout.clip_distances, layout.slots - layout.clip_distances), 1.0F);
  std::ranges::copy(c.clip_distances_of(vertex), all.subspan(layout.clip_distances).begin());
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

/// What of the scissor lies in the framebuffer: Vulkan's has no negative numbers.
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

/// Vulkan's counter-clockwise is so where window y points down. With OpenGL's rules it points up:
/// the rows are the same, and what is displayed is turned over.
VkFrontFace front_face_of(const cases::Case& c) {
  const bool is_ccw = c.front_face == cases::FrontFace::ccw;
  const bool is_up = c.rules == cases::Rules::opengl;
  return is_ccw != is_up ? VK_FRONT_FACE_COUNTER_CLOCKWISE : VK_FRONT_FACE_CLOCKWISE;
}

/// The fragments of a case, as passes and layers bring them.
class CaseFragments {
 public:
  explicit CaseFragments(const cases::Case& c) : case_(&c) {
    drawn_.attribute_count = c.attributes.size();
  }

  /// The next layer of a pass; every pass has all layers in the same order.
  Result<void> add(const Target& target, std::size_t layer, const Layer& triangles, Pass pass,
                   bool is_first_pass);
  void begin_pass() { next_ = 0; }
  /// Whether a pass has had as many fragments as the first.
  bool is_complete() const { return next_ == drawn_.size(); }
  cases::Fragments take();

 private:
  Result<void> place(std::size_t index, float number, const Layer& triangles);
  bool is_next(std::size_t triangle, std::size_t index) const;

  const cases::Case* case_;
  cases::Fragments drawn_;
  std::size_t next_ = 0;
};

tl::unexpected<Error> other_coverage() {
  return failed("drawn again with others of its attributes, the case covers other samples");
}

Result<void> CaseFragments::place(std::size_t index, float number, const Layer& triangles) {
  const auto [least, greatest] = std::minmax(triangles.front(), triangles.back());
  const bool is_number = number >= static_cast<float>(least + 1) &&
                         number <= static_cast<float>(greatest + 1) &&
                         number == static_cast<float>(static_cast<std::size_t>(number));
  if (!is_number) {
    return failed(fmt::format("a flat value came out as {}, of triangles with {} to {}", number,
                              least + 1, greatest + 1));
  }
  const auto samples = static_cast<std::size_t>(case_->framebuffer.samples);
  const auto width = static_cast<std::size_t>(case_->framebuffer.width);
  drawn_.triangle.push_back(static_cast<std::uint32_t>(number) - 1);
  drawn_.x.push_back(static_cast<std::uint16_t>(index / samples % width));
  drawn_.y.push_back(static_cast<std::uint16_t>(index / samples / width));
  drawn_.sample.push_back(static_cast<std::uint8_t>(index % samples));
  return {};
}

bool CaseFragments::is_next(std::size_t triangle, std::size_t index) const {
  const auto samples = static_cast<std::size_t>(case_->framebuffer.samples);
  const auto width = static_cast<std::size_t>(case_->framebuffer.width);
  return next_ < drawn_.size() && drawn_.triangle[next_] == triangle &&
         (drawn_.y[next_] * width + drawn_.x[next_]) * samples + drawn_.sample[next_] == index;
}

Result<void> CaseFragments::add(const Target& target, std::size_t layer, const Layer& triangles,
                                Pass pass, bool is_first_pass) {
  const std::span<const float> numbers = target.numbers(layer);
  const std::span<const float> depths = target.depths(layer);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == 0) continue;
    if (is_first_pass) {
      if (Result<void> placed = place(i, numbers[i], triangles); !placed) return placed;
      drawn_.depth.push_back(depths[i]);
      drawn_.attributes.resize(drawn_.attributes.size() + drawn_.attribute_count);
    } else {
      const bool is_number = numbers[i] >= 1 && numbers[i] <= 0x1p24F;
      if (!is_number || !is_next(static_cast<std::size_t>(numbers[i]) - 1, i)) {
        return other_coverage();
      }
    }
    for (std::size_t s = 0; s < pass.size(); ++s) {
      const std::span<const float> values = target.slot(s, layer).subspan(i * kSlotSize, kSlotSize);
      const std::vector<std::size_t>& attributes = pass[s].attributes;
      for (std::size_t k = 0; k < attributes.size(); ++k) {
        drawn_.attributes[next_ * drawn_.attribute_count + attributes[k]] = values[k];
      }
    }
    ++next_;
  }
  return {};
}

/// By triangle; within one they are in order already.
cases::Fragments CaseFragments::take() {
  if (std::ranges::is_sorted(drawn_.triangle)) return std::move(drawn_);
  std::vector<std::size_t> order(drawn_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
    return drawn_.triangle[a] < drawn_.triangle[b];
  });
  cases::Fragments sorted;
  sorted.attribute_count = drawn_.attribute_count;
  for (const std::size_t i : order) {
    sorted.triangle.push_back(drawn_.triangle[i]);
    sorted.x.push_back(drawn_.x[i]);
    sorted.y.push_back(drawn_.y[i]);
    sorted.sample.push_back(drawn_.sample[i]);
    sorted.depth.push_back(drawn_.depth[i]);
    std::ranges::copy(drawn_.attributes_of(i), std::back_inserter(sorted.attributes));
  }
  return sorted;
}

}  // namespace

struct CaseDrawing::Impl {
  Impl(const Device& the_device, Pipelines the_pipelines, SampleReader the_reader,
       Commands the_commands)
      : device(&the_device),
        pipelines(std::move(the_pipelines)),
        reader(std::move(the_reader)),
        commands(std::move(the_commands)) {}

  Result<const Target*> target_for(TargetShape shape);
  Result<void> hand_over(const std::vector<float>& vertices);
  Result<void> draw_layers(const cases::Case& c, Pass pass, std::span<const Layer> layers,
                           const Target& target);
  void record(VkCommandBuffer buffer, const cases::Case& c, VkPipeline pipeline,
              std::span<const Layer> layers, const Target& target) const;

  const Device* device;
  Pipelines pipelines;
  SampleReader reader;
  Commands commands;
  HostBuffer vertices;
  std::optional<Target> target;
};

CaseDrawing::CaseDrawing(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CaseDrawing::CaseDrawing(CaseDrawing&& other) noexcept = default;
CaseDrawing& CaseDrawing::operator=(CaseDrawing&& other) noexcept = default;
CaseDrawing::~CaseDrawing() = default;

/// The target of the case before where it serves, one with at least so many layers otherwise.
Result<const Target*> CaseDrawing::Impl::target_for(TargetShape shape) {
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

Result<void> CaseDrawing::Impl::hand_over(const std::vector<float>& floats) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(floats));
  if (vertices.bytes.size() < bytes.size()) {
    vertices = {};
    Result<HostBuffer> made =
        make_host_buffer(*device, std::bit_ceil(bytes.size()), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    if (!made) return tl::unexpected(made.error());
    vertices = *std::move(made);
  }
  std::memcpy(vertices.bytes.data(), bytes.data(), bytes.size());
  return {};
}

Result<void> CaseDrawing::Impl::draw_layers(const cases::Case& c, Pass pass,
                                            std::span<const Layer> layers,
                                            const Target& target_of) {
  const PipelineKind kind = kind_of(c, device->limits(), pass);
  const Result<VkPipeline> pipeline = pipelines.get(*device, kind);
  if (!pipeline) return tl::unexpected(pipeline.error());
  const VertexLayout layout = vertex_layout(kind);
  std::vector<float> floats;
  for (const Layer& layer : layers) {
    for (const std::size_t triangle : layer) {
      for (const std::uint32_t vertex : c.triangles[triangle]) {
        append_vertex(c, pass, layout, triangle + 1, vertex, floats);
      }
    }
  }
  if (Result<void> handed = hand_over(floats); !handed) return handed;

  return commands.run(
      *device, [&](VkCommandBuffer buffer) { record(buffer, c, *pipeline, layers, target_of); });
}

void CaseDrawing::Impl::record(VkCommandBuffer buffer, const cases::Case& c, VkPipeline pipeline,
                               std::span<const Layer> layers, const Target& target_of) const {
  const VkViewport viewport = viewport_of(c.viewport);
  const VkRect2D scissor = scissor_of(c);
  const VkBuffer from = vertices.buffer.get();
  constexpr VkDeviceSize kBegin = 0;
  target_of.begin(buffer);
  vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  vkCmdBindVertexBuffers(buffer, 0, 1, &from, &kBegin);
  vkCmdSetViewport(buffer, 0, 1, &viewport);
  vkCmdSetScissor(buffer, 0, 1, &scissor);
  vkCmdSetCullMode(buffer, cull_of(c.cull));
  vkCmdSetFrontFace(buffer, front_face_of(c));
  vkCmdSetDepthCompareOp(buffer, c.depth_test == cases::DepthTest::none
                                     ? VK_COMPARE_OP_ALWAYS
                                     : VK_COMPARE_OP_LESS_OR_EQUAL);
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto count = static_cast<std::uint32_t>(3 * layers[i].size());
    target_of.begin_layer(buffer, i);
    vkCmdDraw(buffer, count, 1, first, 0);
    Target::end_layer(buffer);
    first += count;
  }
  target_of.end(buffer, reader, layers.size());
}

Result<CaseDrawing> CaseDrawing::create(const Device& device) {
  Result<Pipelines> pipelines = Pipelines::create(device);
  if (!pipelines) return tl::unexpected(pipelines.error());
  Result<SampleReader> reader = SampleReader::create(device);
  if (!reader) return tl::unexpected(reader.error());
  Result<Commands> commands = Commands::create(device);
  if (!commands) return tl::unexpected(commands.error());
  return CaseDrawing(std::make_unique<Impl>(device, *std::move(pipelines), *std::move(reader),
                                            *std::move(commands)));
}

Result<cases::Fragments> CaseDrawing::draw(const cases::Case& c,
                                           const std::function<void()>& go_on) {
  CaseFragments fragments(c);
  if (c.triangles.empty()) return fragments.take();
  if (c.triangles.size() >= kMaxTriangles) {
    return failed(
        fmt::format("{} triangles: fewer than {} have numbers", c.triangles.size(), kMaxTriangles),
        Failure::unsupported);
  }
  const std::vector<Slot> slots = widened(slots_of(c), c.framebuffer.samples);
  const std::vector<Layer> layers = layers_of(c);
  const std::vector<Pass> passes =
      passes_of(slots, static_cast<std::size_t>(impl_->device->limits().slots));
  for (const Pass pass : passes) {
    TargetShape shape{c.framebuffer.width, c.framebuffer.height, c.framebuffer.samples, pass.size(),
                      1};
    if (shape.bytes() > kMost) {
      return failed(
          fmt::format("{} x {} pixels of {} samples and {} attributes do not fit into the "
                      "memory of its process",
                      shape.width, shape.height, shape.samples, c.attributes.size()),
          Failure::unsupported);
    }
    const std::size_t together = std::clamp<std::size_t>(kTogether / shape.bytes(), 1, kMaxLayers);
    shape.layers = std::min(std::bit_floor(together), layers.size());
    const Result<const Target*> target = impl_->target_for(shape);
    if (!target) return tl::unexpected(target.error());
    fragments.begin_pass();
    for (std::size_t first = 0; first < layers.size(); first += shape.layers) {
      const auto some =
          std::span(layers).subspan(first, std::min(shape.layers, layers.size() - first));
      if (const auto drawn = impl_->draw_layers(c, pass, some, **target); !drawn) {
        return tl::unexpected(drawn.error());
      }
      for (std::size_t i = 0; i < some.size(); ++i) {
        const bool is_first = pass.data() == passes.front().data();
        const Result<void> added = fragments.add(**target, i, some[i], pass, is_first);
        if (!added) return tl::unexpected(added.error());
      }
      go_on();
    }
    if (!fragments.is_complete()) return other_coverage();
  }
  return fragments.take();
}

}  // namespace rastercheck::backends::vulkan
