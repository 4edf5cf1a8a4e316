#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "backends/plugin/foreign_call.h"
#include "backends/plugin/guarded_array.h"
#include "backends/plugin/library.h"
#include "cases/case.h"
#include "cases/error.h"
#include "cases/picture.h"

namespace rastercheck::backends {

/// Has pictures drawn by a plugin's draw_picture() (plugin.h), and checks what it leaves in them.
class PictureDrawing {
 public:
  explicit PictureDrawing(std::string path) : path_(std::move(path)) {}

  /// The plugin must have a draw_picture(). Fails as `unsupported` if its contract lacks what the
  /// case needs, if the plugin says so, or if the arrays do not fit into memory.
  Result<cases::Picture> draw(const Plugin& plugin, const cases::Case& c,
                              const cases::Pipeline& pipeline);

 private:
  Result<void> hand_over(const cases::Case& c, const cases::Pipeline& pipeline,
                         const cases::Picture& shape);
  Result<void> check_fronts(const ForeignCall& foreign) const;
  Result<cases::Picture> taken(const ForeignCall& foreign, cases::ColorFormat format,
                               cases::Picture shape) const;

  std::string path_;
  GuardedArray sample_positions_{"draw->sample_positions"};
  GuardedArray positions_{"draw->positions"};
  GuardedArray attributes_{"draw->attributes"};
  GuardedArray attribute_values_{"draw->attribute_values"};
  GuardedArray clip_distances_{"draw->clip_distances"};
  GuardedArray indices_{"draw->indices"};
  GuardedArray texels_{"pipeline->texture->texels"};
  GuardedArray color_{"picture->color"};
  GuardedArray depth_{"picture->depth"};
  GuardedArray message_{"picture->message"};
};

}  // namespace rastercheck::backends
