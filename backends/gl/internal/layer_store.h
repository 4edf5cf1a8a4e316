#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/layers.h"
#include "backends/unorm_depth.h"
#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends::gl {

/// Makes layers, keeps the recently used ones, and remembers the context's properties that only
/// layers show.
class LayerStore {
 public:
  /// `has` must outlive the store.
  explicit LayerStore(const Capabilities& has) : has_(&has), copies_(has) {}

  /// Layers of that shape. They live until layers of several other shapes are requested.
  Result<Layers*> get(const LayerShape& shape);

  /// The driver's index of each standard sample, in layers of that shape.
  Result<std::vector<std::size_t>> sample_order(const LayerShape& shape);

  /// Finds out how the depths of a case are to be read, on the first such case by clearing layers
  /// of one pixel to known depths.
  Result<DepthReading> depth_reading(const cases::Case& c);

 private:
  const Capabilities* has_;
  CopyPrograms copies_;
  std::list<Layers> recent_;  ///< most recently used last
  std::map<int, std::vector<std::size_t>> sample_orders_;
  /// How shaders convert unorm depths, by bits and samples.
  std::map<std::pair<int, int>, std::optional<UnormFetch>> fetches_;
};

}  // namespace rastercheck::backends::gl
