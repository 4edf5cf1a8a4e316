#pragma once

// A backend that draws pictures by the laws' own model, whatever it draws fragments with, and then
// goes wrong in one way: in the fragments, in the pipeline, or in the picture.

#include <string>

#include "properties/laws/internal/picture_model.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties {

class PictureBackend : public DamagedBackend {
 public:
  explicit PictureBackend(const std::string& specification = "cpu")
      : DamagedBackend({}, specification) {}

  Damage fragment_damage;  ///< for pictures only

  backends::PictureDrawer* picture_drawer() override { return this; }

 protected:
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override {
    cases::Case alone = c;
    alone.depth_test = cases::DepthTest::none;
    Result<cases::Fragments> drawn = draw_fragments(alone);
    if (!drawn) return tl::unexpected(drawn.error());
    if (fragment_damage) fragment_damage(c, *drawn);
    cases::Pipeline damaged = pipeline;
    if (pipeline_damage) pipeline_damage(damaged);
    cases::Picture picture = picture_of(alone, *drawn, damaged);
    if (picture_damage) picture_damage(pipeline, picture);
    return picture;
  }
};

}  // namespace rastercheck::properties
