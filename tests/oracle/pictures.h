#pragma once

// Pictures that a faultless program makes, and random layouts of them.

#include <rapidcheck.h>

#include <stdexcept>

#include "cases/drawn_picture.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle {

/// A picture, and what its channels show.
struct ShownPicture {
  cases::PictureFile file;
  cases::PictureView view;
};

/// The picture that a faultless program makes.
inline ShownPicture perfect_picture(const SceneTruth& scene, const cases::PictureLayout& layout) {
  const cases::Case& c = scene.source();
  const cases::PictureFile plan = cases::planned_picture(c, layout);
  const Result<cases::PictureView> view = cases::view_of(c, layout, plan, "picture");
  if (!view) throw std::runtime_error(to_string(view.error()));
  return {cases::picture_of(*view, plan, perfect(scene)), *view};
}

/// A layout without channels, blending and alpha.
inline cases::PictureLayout random_layout() {
  using cases::Storage;
  cases::PictureLayout layout;
  layout.storage = one_of(
      {Storage::float32, Storage::float16, Storage::unorm8, Storage::unorm16, Storage::srgb8});
  layout.rounding = one_of({cases::StoreRounding::nearest, cases::StoreRounding::either});
  layout.first_row = one_of({cases::FirstRow::top, cases::FirstRow::bottom});
  layout.resolve = one_of({cases::ResolveOf::linear, cases::ResolveOf::stored});
  return layout;
}

/// Adds a second triangle to a random case.
inline cases::Case two_triangles() {
  cases::Case c = random_exact_case();
  if (*rc::gen::arbitrary<bool>()) cover_most(c);
  for (int i = 0; i < 3; ++i) {
    c.positions.push_back(random_vertex());
    for (std::size_t a = 0; a < c.attributes.size(); ++a) {
      c.attribute_values.push_back(random_float(1));
    }
    for (std::size_t d = 0; d < c.clip_distance_count; ++d) {
      c.clip_distances.push_back(grid_float(1));
    }
  }
  c.triangles.push_back({3, 4, 5});
  c.depth_test = one_of({cases::DepthTest::none, cases::DepthTest::less});
  return c;
}

}  // namespace rastercheck::oracle
