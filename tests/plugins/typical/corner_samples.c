/*
 * Samples pixels at the corner of least window x and y, as rasterizers do that walk along whole
 * coordinates. On a grid of 1/256 pixel, one sample, all APIs' conventions.
 *
 * With BREAKS defined it samples at the centre instead.
 */
#include "common.h"

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 8,
    .rounding = RASTERCHECK_ROUNDING_NEAREST_EVEN,
    .position_error = 0x1p-27F, /* 2^-35 pixels, see to_window() */
    .clip_tolerance = 1,        /* a cut runs between snapped vertices: it moves by half a unit */
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH |
             RASTERCHECK_KEEPS_SIGN_OF_ZERO,
    .smooth = {.constant = 0.5F + 0x1p-24F}, /* see mean_of() */
    .noperspective = {.constant = 0.5F + 0x1p-24F},
    .depth = {.constant = 0.5F + 0x1p-9F}, /* see depth_at() */
    .lacks = RASTERCHECK_LACKS_NONPOSITIVE_W | RASTERCHECK_LACKS_CLIP_DISTANCES,
    .sample_counts = 1,
    .sample_x = 0,
    .sample_y = 0,
    .sample_parts = 1,
};

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  rastercheck_draw own = *draw;
#ifndef BREAKS
  static const float kCorner[2] = {0, 0};
  own.sample_positions = kCorner;
#endif
  return draw_snapped(&own, out, 256, rint, draw_sample);
}

TYPICAL_PLUGIN("corner samples", contract, draw_all)
