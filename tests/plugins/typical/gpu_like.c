/*
 * As GPUs draw: Direct3D's and Vulkan's conventions, a grid of 1/256 pixel, up to 16 samples, the
 * fill rule that is asked for, values of the snapped triangle.
 *
 * Does not clip at the sides: refuses vertices beyond 32768 pixels, and takes no w <= 0.
 *
 * With BREAKS defined the grid is one of 1/128 pixel.
 */
#include "common.h"

#ifdef BREAKS
#define GRID 128.
#else
#define GRID 256.
#endif

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
    .lacks = RASTERCHECK_LACKS_OPENGL | RASTERCHECK_LACKS_NONPOSITIVE_W |
             RASTERCHECK_LACKS_CLIP_DISTANCES | RASTERCHECK_LACKS_CENTER |
             RASTERCHECK_LACKS_CENTROID,
};

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  return draw_snapped(draw, out, GRID, rint, draw_sample);
}

TYPICAL_PLUGIN("like a GPU", contract, draw_all)
