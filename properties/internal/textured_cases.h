#pragma once

// Cases for laws about textures: attributes 0 and 1 are texture coordinates. What laws have in
// common that sample textures at exact coordinates is here as well.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cases/picture.h"
#include "oracle/triangle_truth.h"
#include "properties/internal/choices.h"
#include "properties/internal/drawn_fragments.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Gives a case two attributes at least, and those coordinates: on borders of texels at samples,
/// next to them, within and far beyond 0 to 1, or whatever they were.
void set_coordinates(Draw& draw, cases::Case& c);

/// A case by one of all generators, of corners on grids more often than of others.
Generated textured_case(Draw& draw);

/// The channel of a texel at column i of row j.
using TexelBytes = std::uint8_t (*)(int i, int j, std::size_t channel);

/// A texture of 1×1 to 64×64 texels and its wraps; nearest filtering.
cases::Texturing texturing_of(Choices& choices, TexelBytes bytes);

/// Texels that are alike nowhere: noise.
std::uint8_t noise_byte(int i, int j, std::size_t channel);

/// What is drawn last, and so seen, at a sample: the case's triangles drawn without any depth test.
class SeenTriangles {
 public:
  SeenTriangles(const cases::Case& c, const cases::Contract& contract);

  /// What is seen at a sample of the picture, by its index; nothing where no triangle is required,
  /// or one after it is permitted.
  std::optional<FragmentPlace> find(const cases::Picture& picture, std::size_t at);
  const oracle::TriangleTruth& truth(std::uint32_t triangle);
  const oracle::SceneTruth& scene() const { return scene_; }

 private:
  oracle::SceneTruth scene_;
  std::vector<std::unique_ptr<oracle::TriangleTruth>> truths_;
};

/// The exact value of an attribute of a fragment, where the rules leave no other.
std::optional<oracle::Rational> exact_value(const oracle::TriangleTruth& truth,
                                            std::size_t attribute, const FragmentPlace& place);

/// At most `most` of these, evenly spread.
std::vector<std::size_t> some_of(const std::vector<std::size_t>& all, std::size_t most);

/// At most `most` of the samples of a picture that have been drawn, evenly spread: all channels of
/// those that have not are 0. Indices count as cases::Picture does.
std::vector<std::size_t> some_drawn_samples(const cases::Picture& picture, std::size_t most);

/// Pixel and sample of such an index.
FragmentPlace place_at(const cases::Picture& picture, std::size_t at);

bool draws_pictures(const backends::Backend& backend);

}  // namespace rastercheck::properties
