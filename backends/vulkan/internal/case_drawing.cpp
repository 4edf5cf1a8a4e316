#include "backends/vulkan/internal/case_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "backends/appended_drawing.h"
#include "backends/unorm_depth.h"
#include "backends/vulkan/internal/case_commands.h"
#include "backends/vulkan/internal/commands.h"
#include "backends/vulkan/internal/fragment_buffer.h"
#include "backends/vulkan/internal/memory.h"
#include "backends/vulkan/internal/pipelines.h"
#include "backends/vulkan/internal/sample_reader.h"
#include "backends/vulkan/internal/target.h"
#include "backends/vulkan/slots.h"

namespace rastercheck::backends::vulkan {
namespace {

/// The most bytes of layers that are drawn together; more would not be faster.
constexpr std::size_t kTogether = std::size_t{16} << 20U;
constexpr std::size_t kMaxLayers = 64;
/// Integers up to this number are exact in float32.
constexpr std::size_t kMaxTriangles = std::size_t{1} << 24U;

/// The triangles of one layer, in the order in which they are drawn.
using Layer = std::vector<std::size_t>;

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
  // If a case gives no initial depth, the depth buffer starts at 1, and fragments may have depth 1.
  // So the test is `less or equal`; drawing from last to first keeps the first of equally near
  // fragments.
  Layer all(c.triangles.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (!c.depth_clear) std::reverse(all.begin(), all.end());
  layers.push_back(std::move(all));
  return layers;
}

/// Collects the fragments of a case, pass by pass and layer by layer.
class CaseFragments {
 public:
  explicit CaseFragments(const cases::Case& c) : case_(&c) {
    drawn_.attribute_count = c.attributes.size();
  }

  /// Adds the next layer of a pass. Every pass must have all layers in the same order. For the
  /// first pass only, `first_reading` tells how its depths were stored.
  Result<void> add(const Target& target, std::size_t layer, const Layer& triangles, Pass pass,
                   const DepthReading* first_reading);
  void begin_pass() { next_ = 0; }
  /// True if layers since the last call of settle() have depths that are 1 or a step less. Then
  /// settle() makes them 1 where the target's layers, drawn again, have a number.
  bool has_open_depths() const { return !open_.empty(); }
  void settle(const Target& ones);
  /// True if the pass has as many fragments as the first pass.
  bool is_complete() const { return next_ == drawn_.size(); }
  cases::Fragments take();

 private:
  Result<void> place(std::size_t index, float number, const Layer& triangles);
  bool is_next(std::size_t triangle, std::size_t index) const;

  struct OpenDepth {
    std::size_t fragment = 0;
    std::size_t layer = 0;
    std::size_t sample = 0;  ///< index in the layer
  };

  const cases::Case* case_;
  cases::Fragments drawn_;
  std::vector<OpenDepth> open_;
  std::size_t next_ = 0;
};

void CaseFragments::settle(const Target& ones) {
  for (const OpenDepth& at : open_) {
    if (ones.numbers(at.layer)[at.sample] != 0) drawn_.depth[at.fragment] = 1;
  }
  open_.clear();
}

tl::unexpected<Error> other_coverage() {
  return failed("the case covered other samples when it was drawn again with its other attributes");
}

Result<void> CaseFragments::place(std::size_t index, float number, const Layer& triangles) {
  const auto [least, greatest] = std::minmax(triangles.front(), triangles.back());
  const bool is_number = number >= static_cast<float>(least + 1) &&
                         number <= static_cast<float>(greatest + 1) &&
                         number == static_cast<float>(static_cast<std::size_t>(number));
  if (!is_number) {
    return failed(fmt::format("a flat triangle number was drawn as {}, not from {} to {}", number,
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
                                Pass pass, const DepthReading* first_reading) {
  const std::span<const float> numbers = target.numbers(layer);
  const std::vector<float> depths =
      first_reading != nullptr ? target.depths(layer) : std::vector<float>();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == 0) continue;
    if (first_reading != nullptr) {
      if (Result<void> placed = place(i, numbers[i], triangles); !placed) return placed;
      const Result<float> depth = first_reading->stored(depths[i], false);
      if (!depth) return tl::unexpected(depth.error());
      if (first_reading->is_open(depths[i])) open_.push_back({drawn_.depth.size(), layer, i});
      drawn_.depth.push_back(*depth);
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

/// Sorts the fragments by triangle. Those of the same triangle are already in order.
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
  Impl(DrawingResources& the_resources, FragmentBuffer the_records)
      : shared(&the_resources), records(std::move(the_records)) {}

  const Limits& limits() const { return shared->device->limits(); }
  Result<void> draw_layers(const cases::Case& c, const IndexedDraw* indexed, Pass pass,
                           std::span<const Layer> layers, const Target& target);
  Result<void> draw_ones(const cases::Case& c, Pass pass, std::size_t layer_count,
                         const Target& target);
  Result<cases::Fragments> draw_in_layers(const cases::Case& c, const IndexedDraw* indexed,
                                          const std::function<void()>& go_on);
  Result<cases::Fragments> append_all(const cases::Case& c, const IndexedDraw* indexed,
                                      bool is_checked, const std::function<void()>& go_on);
  bool appends(const cases::Case& c) const;
  Result<std::size_t> append_some(const cases::Case& c, const IndexedDraw* indexed, Pass pass,
                                  std::size_t first, std::size_t count, std::size_t room);
  void record(VkCommandBuffer buffer, const cases::Case& c, const IndexedDraw* indexed,
              VkPipeline pipeline, std::span<const Layer> layers, const Target& target) const;
  Result<void> hand_over(const IndexedDraw& indexed, const cases::Case& c, Pass pass,
                         const VertexLayout& layout);

  DrawingResources* shared;
  FragmentBuffer records;
};

CaseDrawing::CaseDrawing(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CaseDrawing::CaseDrawing(CaseDrawing&& other) noexcept = default;
CaseDrawing& CaseDrawing::operator=(CaseDrawing&& other) noexcept = default;
CaseDrawing::~CaseDrawing() = default;

/// Hands over the vertices and the indices of a draw.
Result<void> CaseDrawing::Impl::hand_over(const IndexedDraw& indexed, const cases::Case& c,
                                          Pass pass, const VertexLayout& layout) {
  std::vector<float> floats;
  append_places(c, pass, layout, indexed, floats);
  return shared->hand_over(floats).and_then(
      [&] { return shared->hand_over_indices(indexed.order); });
}

/// Draws the layers' triangles, or the indices if there are any, for which there is one layer.
Result<void> CaseDrawing::Impl::draw_layers(const cases::Case& c, const IndexedDraw* indexed,
                                            Pass pass, std::span<const Layer> layers,
                                            const Target& target_of) {
  PipelineKind kind = kind_of(c, limits(), pass);
  if (indexed != nullptr) kind.topology = indexed->topology;
  const Result<VkPipeline> pipeline = shared->pipelines.get(*shared->device, kind);
  if (!pipeline) return tl::unexpected(pipeline.error());
  const VertexLayout layout = vertex_layout(kind);
  if (indexed != nullptr) {
    if (Result<void> handed = hand_over(*indexed, c, pass, layout); !handed) return handed;
  } else {
    std::vector<float> floats;
    for (const Layer& layer : layers) {
      for (const std::size_t triangle : layer) {
        append_primitive(c, pass, layout, triangle, triangle + 1, floats);
      }
    }
    if (Result<void> handed = shared->hand_over(floats); !handed) return handed;
  }
  return shared->commands.run(*shared->device, [&](VkCommandBuffer buffer) {
    record(buffer, c, indexed, *pipeline, layers, target_of);
  });
}

/// Draws into layers where depth 1 is stored.
Result<void> CaseDrawing::Impl::draw_ones(const cases::Case& c, Pass pass, std::size_t layer_count,
                                          const Target& target_of) {
  const cases::Case all = covering_at_one(c);
  const PipelineKind kind = kind_of(all, limits(), pass);
  const Result<VkPipeline> pipeline = shared->pipelines.get(*shared->device, kind);
  if (!pipeline) return tl::unexpected(pipeline.error());
  std::vector<float> floats;
  append_primitive(all, pass, vertex_layout(kind), 0, 1, floats);
  if (Result<void> handed = shared->hand_over(floats); !handed) return handed;
  return shared->commands.run(*shared->device, [&](VkCommandBuffer buffer) {
    target_of.begin_over_depths(buffer);
    bind_case(buffer, all, *pipeline, shared->vertices.buffer.get());
    vkCmdSetDepthCompareOp(buffer, VK_COMPARE_OP_EQUAL);
    for (std::size_t i = 0; i < layer_count; ++i) {
      target_of.begin_layer(buffer, i, std::nullopt);
      vkCmdDraw(buffer, vertices_of(all, 1), 1, 0, 0);
      Target::end_layer(buffer);
    }
    target_of.end(buffer, shared->reader, layer_count);
  });
}

void CaseDrawing::Impl::record(VkCommandBuffer buffer, const cases::Case& c,
                               const IndexedDraw* indexed, VkPipeline pipeline,
                               std::span<const Layer> layers, const Target& target_of) const {
  target_of.begin(buffer);
  bind_case(buffer, c, pipeline, shared->vertices.buffer.get());
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::uint32_t count = vertices_of(c, layers[i].size());
    target_of.begin_layer(buffer, i, c.depth_clear.value_or(1));
    if (indexed != nullptr) {
      draw_indices(buffer, *indexed, shared->indices.buffer.get());
    } else {
      vkCmdDraw(buffer, count, 1, first, 0);
    }
    Target::end_layer(buffer);
    first += count;
  }
  target_of.end(buffer, shared->reader, layers.size());
}

Result<CaseDrawing> CaseDrawing::create(DrawingResources& resources) {
  Result<FragmentBuffer> records = FragmentBuffer::create(*resources.device, resources.pipelines);
  if (!records) return tl::unexpected(records.error());
  return CaseDrawing(std::make_unique<Impl>(resources, *std::move(records)));
}

Result<cases::Fragments> CaseDrawing::Impl::draw_in_layers(const cases::Case& c,
                                                           const IndexedDraw* indexed,
                                                           const std::function<void()>& go_on) {
  CaseFragments fragments(c);
  if (c.triangles.empty()) return fragments.take();
  if (c.triangles.size() >= kMaxTriangles) {
    return failed(fmt::format("{} triangles are too many; the number must be below {}",
                              c.triangles.size(), kMaxTriangles),
                  Failure::unsupported);
  }
  const std::vector<Slot> slots = widened(slots_of(c), c.framebuffer.samples);
  const std::vector<Layer> layers = layers_of(c);
  const std::vector<Pass> passes = passes_of(slots, static_cast<std::size_t>(limits().slots));
  const Result<DepthReading> reading = shared->depth_reading(c);
  if (!reading) return tl::unexpected(reading.error());
  for (const Pass pass : passes) {
    TargetShape shape{
        c.framebuffer.width, c.framebuffer.height, c.framebuffer.samples, pass.size(), 1,
        c.depth_format};
    if (Result<void> fits = check_memory(shape); !fits) return tl::unexpected(fits.error());
    const std::size_t together = std::clamp<std::size_t>(kTogether / shape.bytes(), 1, kMaxLayers);
    shape.layers = std::min(std::bit_floor(together), layers.size());
    const Result<const Target*> of_shape = shared->target_for(shape);
    if (!of_shape) return tl::unexpected(of_shape.error());
    fragments.begin_pass();
    for (std::size_t first = 0; first < layers.size(); first += shape.layers) {
      const auto some =
          std::span(layers).subspan(first, std::min(shape.layers, layers.size() - first));
      if (const auto drawn = draw_layers(c, indexed, pass, some, **of_shape); !drawn) {
        return tl::unexpected(drawn.error());
      }
      for (std::size_t i = 0; i < some.size(); ++i) {
        const bool is_first = pass.data() == passes.front().data();
        const Result<void> added =
            fragments.add(**of_shape, i, some[i], pass, is_first ? &*reading : nullptr);
        if (!added) return tl::unexpected(added.error());
      }
      if (fragments.has_open_depths()) {
        const Result<void> drawn = draw_ones(c, pass, some.size(), **of_shape);
        if (!drawn) return tl::unexpected(drawn.error());
        fragments.settle(**of_shape);
      }
      go_on();
    }
    if (!fragments.is_complete()) return other_coverage();
  }
  return fragments.take();
}

Result<std::size_t> CaseDrawing::Impl::append_some(const cases::Case& c, const IndexedDraw* indexed,
                                                   Pass pass, std::size_t first, std::size_t count,
                                                   std::size_t room) {
  PipelineKind kind = kind_of(c, limits(), pass);
  kind.output = Output::records;
  if (indexed != nullptr) kind.topology = indexed->topology;
  const Result<VkPipeline> pipeline = shared->pipelines.get(*shared->device, kind);
  if (!pipeline) return tl::unexpected(pipeline.error());
  const VertexLayout layout = vertex_layout(kind);
  if (indexed != nullptr) {
    if (count < c.triangles.size()) {
      return failed("its triangles or fragments are too many for one draw", Failure::unsupported);
    }
    if (Result<void> handed = hand_over(*indexed, c, pass, layout); !handed) {
      return tl::unexpected(handed.error());
    }
  } else {
    std::vector<float> floats;
    for (std::size_t t = 0; t < count; ++t) {
      append_primitive(c, pass, layout, first + t, t + 1, floats);
    }
    if (Result<void> handed = shared->hand_over(floats); !handed) {
      return tl::unexpected(handed.error());
    }
  }
  const std::size_t words = room * (kRecordHead + kSlotSize * pass.size());
  if (Result<void> ready = records.make_room(*shared->device, words); !ready) {
    return tl::unexpected(ready.error());
  }
  const Result<void> done = shared->commands.run(*shared->device, [&](VkCommandBuffer buffer) {
    begin_without_images(buffer, c.framebuffer);
    bind_case(buffer, c, *pipeline, shared->vertices.buffer.get());
    records.bind(buffer, shared->pipelines.appending_layout(), room);
    if (indexed != nullptr) {
      draw_indices(buffer, *indexed, shared->indices.buffer.get());
    } else {
      vkCmdDraw(buffer, vertices_of(c, count), 1, 0, 0);
    }
    vkCmdEndRendering(buffer);
    FragmentBuffer::show_host(buffer);
  });
  if (!done) return tl::unexpected(done.error());
  return records.count();
}

Result<cases::Fragments> CaseDrawing::Impl::append_all(const cases::Case& c,
                                                       const IndexedDraw* indexed, bool is_checked,
                                                       const std::function<void()>& go_on) {
  std::string what = lacks_of_appending(c);
  if (!limits().fragment_stores) {
    what = "it lacks storage buffers for fragments (fragmentStoresAndAtomics)";
  }
  if (!what.empty()) return failed(what, Failure::unsupported);
  const std::vector<Slot> slots = widened(slots_of(c), c.framebuffer.samples);
  const std::vector<Pass> passes = passes_of(slots, kMaxSlots);
  std::vector<RecordLayout> layouts;
  for (const Pass pass : passes) {
    RecordLayout& layout = layouts.emplace_back();
    for (const Slot& slot : pass) layout.add_vector(slot.attributes);
  }
  const AppendingDriver driver{
      records.most_words(),
      [&](std::size_t layout, std::size_t first, std::size_t count, std::size_t room) {
        return append_some(c, indexed, passes[layout], first, count, room);
      },
      [&] { return records.words(); },
      [&](const cases::Case& some) { return draw_in_layers(some, nullptr, go_on); }};
  return draw_appended(c, layouts, driver, is_checked, go_on);
}

/// True if fragments are appended when the caller names no way of drawing. That is the case only if
/// layers, which are read back whole, would take more than one batch.
bool CaseDrawing::Impl::appends(const cases::Case& c) const {
  if (!limits().fragment_stores || !lacks_of_appending(c).empty()) return false;
  const TargetShape one{c.framebuffer.width, c.framebuffer.height, 1,
                        widened(slots_of(c), 1).size(), 1};
  return one.bytes() * c.triangles.size() > kTogether;
}

std::vector<cases::DrawBy> CaseDrawing::ways() const {
  if (!impl_->limits().fragment_stores) return {cases::DrawBy::layers};
  return {cases::DrawBy::append, cases::DrawBy::layers};
}

Result<cases::Fragments> CaseDrawing::draw(const cases::Case& c, std::optional<cases::DrawBy> way,
                                           const std::function<void()>& go_on) {
  const bool appends = way ? *way == cases::DrawBy::append : impl_->appends(c);
  return appends ? impl_->append_all(c, nullptr, !way, go_on)
                 : impl_->draw_in_layers(c, nullptr, go_on);
}

Result<cases::Fragments> CaseDrawing::draw_assembled(const cases::Case& c, cases::Topology topology,
                                                     std::span<const std::uint32_t> indices,
                                                     const std::function<void()>& go_on) {
  // A triangle's number is a flat value, even if the case has none.
  if (c.rules == cases::Rules::opengl && !impl_->limits().provoking_vertex_last) {
    return failed("it lacks OpenGL's provoking vertex of strips (VK_EXT_provoking_vertex)",
                  Failure::unsupported);
  }
  const Result<IndexedDraw> indexed = indexed_draw(c, topology, indices);
  if (!indexed) return tl::unexpected(indexed.error());
  cases::Case drawn = c;
  drawn.triangles = indexed->primitives;
  if (drawn.depth_test == cases::DepthTest::none) {
    return impl_->append_all(drawn, &*indexed, false, go_on);
  }
  // Without an initial depth, layers_of() draws from last to first, which a strip cannot.
  if (!drawn.depth_clear) {
    return failed("a depth buffer without an initial depth", Failure::unsupported);
  }
  return impl_->draw_in_layers(drawn, &*indexed, go_on);
}

}  // namespace rastercheck::backends::vulkan
