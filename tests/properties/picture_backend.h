#pragma once

// Backends that draw pictures by the laws' own model, and then go wrong in one way: in what the
// pipeline says, or in the picture.

#include <functional>
#include <string>
#include <utility>

#include "properties/picture_model.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties {

using PipelineDamage = std::function<void(cases::Pipeline&)>;
using PictureDamage = std::function<void(const cases::Case&, cases::Picture&)>;

class PictureBackend : public DamagedBackend {
 public:
  explicit PictureBackend(const std::string& specification = "cpu")
      : DamagedBackend({}, specification) {}

  bool draws_pictures() const override { return true; }
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override {
    cases::Case alone = c;
    alone.depth_test = cases::DepthTest::none;
    Result<cases::Framebuffer> drawn = draw(alone);
    if (!drawn) return tl::unexpected(drawn.error());
    if (fragment_damage) fragment_damage(c, *drawn);
    cases::Pipeline damaged = pipeline;
    if (pipeline_damage) pipeline_damage(damaged);
    cases::Picture picture = picture_of(alone, *drawn, damaged);
    if (picture_damage) picture_damage(c, picture);
    return picture;
  }

  Damage fragment_damage;  ///< of pictures alone
  PipelineDamage pipeline_damage;
  PictureDamage picture_damage;
};

}  // namespace rastercheck::properties
