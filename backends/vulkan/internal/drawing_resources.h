#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "backends/unorm_depth.h"
#include "backends/vulkan/internal/commands.h"
#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/memory.h"
#include "backends/vulkan/internal/pipelines.h"
#include "backends/vulkan/internal/sample_reader.h"
#include "backends/vulkan/internal/target.h"
#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends::vulkan {

/// The objects that drawings of fragments and of pictures share. They are kept from one case to the
/// next.
struct DrawingResources {
  static Result<DrawingResources> create(const Device& device);

  /// A target of this shape with at least that many layers, which lives until the next call. Fails
  /// with Failure::unsupported if one layer needs more memory than one case may take.
  Result<const Target*> target_for(TargetShape shape);
  /// Finds out how the depths of a case are to be read, on the first such case by clearing layers
  /// of one pixel to known depths. May replace the target.
  Result<DepthReading> depth_reading(const cases::Case& c);
  /// Copies floats to the buffer `vertices`.
  Result<void> hand_over(const std::vector<float>& floats);
  /// Copies indices, and restarts among them, to the buffer `indices`.
  Result<void> hand_over_indices(const std::vector<std::uint32_t>& order);

  const Device* device = nullptr;
  Pipelines pipelines;
  SampleReader reader;
  Commands commands;
  HostBuffer vertices = {};
  HostBuffer indices = {};
  std::optional<Target> target = std::nullopt;
  /// How shaders convert unorm depths, by bits and samples.
  std::map<std::pair<int, int>, std::optional<UnormFetch>> fetches = {};
};

/// Fails with Failure::unsupported if a layer of the shape needs more memory than one case may
/// take.
Result<void> check_memory(const TargetShape& shape);

}  // namespace rastercheck::backends::vulkan
