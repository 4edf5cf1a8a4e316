#pragma once

// A model of how fragments make a picture, step by step as the pipeline's rules state it. Laws
// compare a backend's pictures with this model, which has no tiles, no threads and no order of its
// own.
//
// Every sample of the framebuffer starts with colour 0 and the clear depth. Fragments follow in
// submission order. If a fragment's depth passes the depth test against the sample's depth, the
// sample takes the fragment's depth, if depths are written, and its colour, after blending.
// Blending colour s onto d gives
//
//   off        s
//   over       s_a s + (1 − s_a) d in channels 0 to 2, s_a + (1 − s_a) d_a in channel 3 (four
//              channels; s_a is the last channel of s)
//   additive   s + d
//
// in double, products first, with every operation rounded to nearest. The result is then rounded to
// the picture's format:
//
//   float32    the nearest float. Nothing is clamped
//   rgba8      a byte k for k/255. s is first clamped to [0, 1], NaN to 0. Blending takes 255 s and
//              the byte present (s_a is not scaled); the result becomes the nearest integer, ties
//              to even, at most 255
//
// Resolving takes the mean of a pixel's samples. The samples are added in double, in index order,
// and the sum is divided by their number. The mean of floats is rounded to a float; bytes are added
// as integers and their mean is rounded to an integer, ties to even. The depth is that of sample 0.
//
// Where a backend promises less (cases::PictureBounds), each colour is a range, from the least to
// the greatest that the bounds allow; a blend's range is that of all colours present.
//
// Colours are the attributes. Vertex colours are the first four attributes; if a case has three
// attributes, the fourth channel is 1. Textures, other shadings and discarding are not modelled.

#include <optional>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/fragments.h"
#include "cases/picture.h"

namespace rastercheck::properties {

/// True if a fragment of depth `depth` passes the depth test against the depth `present`.
bool passes(cases::DepthFunction function, float depth, float present);

/// The picture that a case's fragments leave. Triangles are drawn in submission order; the
/// fragments of one triangle may come in any order. The pipeline must show attributes or vertex
/// colours, without a texture, and discard nothing. The case must have at least three attributes
/// for vertex colours; for other colours, exactly four if the pipeline blends `over`. Fragments
/// outside the framebuffer are ignored.
cases::Picture picture_of(const cases::Case& c, const cases::Fragments& fragments,
                          const cases::Pipeline& pipeline);

/// The least and the greatest picture that a case's fragments may leave; equal if there are no
/// bounds. Colours beyond float32 are infinite, and NaN if a colour may be.
struct PictureRange {
  cases::Picture least;
  cases::Picture greatest;

  /// True if the colour of that index is promised to be `drawn`. Of two colours that are no
  /// numbers, either will do; nothing is promised about a range with such an end.
  bool has_color(std::size_t index, float drawn) const;
};

/// Like picture_of(), within a backend's bounds.
PictureRange range_of(const cases::Case& c, const cases::Fragments& fragments,
                      const cases::Pipeline& pipeline,
                      const std::optional<cases::PictureBounds>& bounds);

}  // namespace rastercheck::properties
