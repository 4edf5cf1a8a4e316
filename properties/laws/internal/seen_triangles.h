#pragma once

// What is exactly true of a picture: which triangle is seen at a sample, and the values there that
// textures are sampled at.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cases/picture.h"
#include "oracle/triangle_truth.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {

/// What is drawn last, and so seen, at a sample: the case's triangles drawn without any depth test.
class SeenTriangles {
 public:
  SeenTriangles(const cases::Case& c, const cases::Contract& contract);

  /// What is seen at a sample of the picture, by its index; nothing where no triangle is required,
  /// or one after it is permitted.
  std::optional<cases::SamplePlace> find(const cases::Picture& picture, std::size_t at);
  const oracle::TriangleTruth& truth(std::uint32_t triangle);
  const oracle::SceneTruth& scene() const { return scene_; }

 private:
  oracle::SceneTruth scene_;
  std::vector<std::unique_ptr<oracle::TriangleTruth>> truths_;
};

/// Where a fragment is in a texture: its attributes 0 and 1.
struct Coordinates {
  oracle::Rational s;
  oracle::Rational t;
};

/// The exact ones of a fragment, where the rules leave no others.
std::optional<Coordinates> exact_coordinates(const oracle::TriangleTruth& truth,
                                             const cases::SamplePlace& place);

/// At most `most` of the samples of a picture that have been drawn, evenly spread: all channels of
/// those that have not are 0. Indices count as cases::Picture does.
std::vector<std::size_t> some_drawn_samples(const cases::Picture& picture, std::size_t most);

}  // namespace rastercheck::properties
