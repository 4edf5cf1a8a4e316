#pragma once

// What fragments leave in a picture, step by step as the rules of a pipeline say it: the model that
// laws hold a backend's pictures against. It has no tiles, no threads and no order of its own.
//
// Every sample of the framebuffer begins with colour 0 and the depth that is cleared to. Then each
// fragment, in submission order, that passes the depth test, its depth against the sample's, leaves
// its depth, if depths are written, and its colour: s is drawn where d is,
//
//   off        s
//   over       s_a s + (1 − s_a) d in channels 0 to 2, s_a + (1 − s_a) d_a in channel 3 (four
//              channels; s_a is the last one of s)
//   additive   s + d
//
// in double, every operation rounded to nearest, products first; the result is then rounded to what
// the picture holds:
//
//   float32    the nearest float. Nothing is clamped
//   rgba8      a byte k for k/255. s is held to [0, 1] first, NaN as 0; what is blended are 255 s
//              and the byte that is there (s_a is not multiplied), and what comes out becomes the
//              nearest whole number, ties to even, at most 255
//
// Resolving takes the mean of a pixel's samples: they are added in double, from the first on in the
// order of their indices, and divided by their number; floats are rounded to a float, bytes are
// added as whole numbers and the mean rounded to one, ties to even. The depth is that of sample 0.
//
// Colours are the attributes, or, as vertex colours, the first four of them; of three the fourth is
// 1. Textures and differences are not modelled.

#include "cases/case.h"
#include "cases/fragments.h"
#include "cases/picture.h"

namespace rastercheck::properties {

/// Whether the depth test keeps a fragment of depth `depth` where `present` is.
bool passes(cases::DepthFunction function, float depth, float present);

/// The picture that a case's fragments leave: each triangle's as if drawn alone, in any order of
/// their own, as submission order is that of triangles. The pipeline has no texture and shows
/// no differences; the case has three attributes at least if these are vertex colours, else four if
/// it blends `over`. Fragments of no pixel or sample are left out.
cases::Picture picture_of(const cases::Case& c, const cases::Fragments& fragments,
                          const cases::Pipeline& pipeline);

}  // namespace rastercheck::properties
