#pragma once

// The exact truth about a picture: which triangle is visible at a sample, and at which coordinates
// its texture is sampled there.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cases/picture.h"
#include "oracle/texture_truth.h"
#include "oracle/triangle_truth.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {

/// Finds the visible triangle at each sample of a case without a depth test: the triangle drawn
/// last.
class SeenTriangles {
 public:
  SeenTriangles(const cases::Case& c, const cases::Contract& contract);

  /// The place of the visible fragment at the sample of index `at`. Empty if no triangle is
  /// required there, or if a later triangle is permitted.
  std::optional<cases::SamplePlace> find(const cases::Picture& picture, std::size_t at);
  const oracle::TriangleTruth& truth(std::uint32_t triangle);
  const oracle::SceneTruth& scene() const { return scene_; }

 private:
  oracle::SceneTruth scene_;
  std::vector<std::unique_ptr<oracle::TriangleTruth>> truths_;
};

/// A fragment's position in a texture: its attributes 0 and 1.
struct Coordinates {
  oracle::Rational s;
  oracle::Rational t;
};

/// The exact coordinates of a fragment; empty if the rules allow several.
std::optional<Coordinates> exact_coordinates(const oracle::TriangleTruth& truth,
                                             const cases::SamplePlace& place);

/// The coordinates that the contract permits a fragment; empty if it permits any.
std::optional<oracle::CoordinateRanges> permitted_coordinates(const oracle::TriangleTruth& truth,
                                                              const cases::SamplePlace& place);

/// At most `most` evenly spread samples of the picture that have been drawn. A sample with all
/// channels 0 counts as not drawn. Indices are those of cases::Picture.
std::vector<std::size_t> some_drawn_samples(const cases::Picture& picture, std::size_t most);

}  // namespace rastercheck::properties
