#pragma once

#include <cstddef>
#include <string>

#include "backends/plugin/guarded_array.h"
#include "backends/plugin/library.h"
#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends {

/// Hands occlusion queries to a plugin's query() (plugin.h).
class OcclusionQuery {
 public:
  explicit OcclusionQuery(std::string path) : path_(std::move(path)) {}

  /// True if the plugin, which must have a query(), calls the case's triangles from index
  /// `occluders` on occluded by those before.
  Result<bool> ask(const Plugin& plugin, const cases::Case& c, std::size_t occluders);

 private:
  Result<void> hand_over(const cases::Case& c, std::size_t occluders);

  std::string path_;
  GuardedArray sample_positions_{"query->occludee->sample_positions"};
  GuardedArray positions_{"query->occludee->positions"};
  GuardedArray clip_distances_{"query->occludee->clip_distances"};
  GuardedArray occluders_{"query->occluders->indices"};
  GuardedArray occludee_{"query->occludee->indices"};
  GuardedArray message_{"answer->message"};
};

}  // namespace rastercheck::backends
