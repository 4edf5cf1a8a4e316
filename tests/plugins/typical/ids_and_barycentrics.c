/*
 * A visibility buffer: for each sample the nearest triangle, and two perspective-correct
 * barycentric coordinates b0 and b1 in float32. Values are computed from these afterwards, as a
 * second pass would: b0 r0 + b1 r1 + b2 r2 with b2 = 1 - b0 - b1. Only triangles within the target
 * are drawn; nothing is clipped.
 */
#include "common.h"

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 8,
    .rounding = RASTERCHECK_ROUNDING_HALF_UP,
    .position_error = 0x1p-26F, /* 2^-35 pixels, see to_window(), and as much for half_up() */
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH,
    .smooth = {.constant = 0.5F + 0x1p-20F, .range_share = 0x1p-24F}, /* see value_of() */
    .depth = {.constant = 0.5F + 0x1p-9F},
    .lacks = RASTERCHECK_LACKS_OPENGL | RASTERCHECK_LACKS_NONPOSITIVE_W |
             RASTERCHECK_LACKS_DEPTH_CLIPPING | RASTERCHECK_LACKS_SIDE_CLIPPING |
             RASTERCHECK_LACKS_CLIP_DISTANCES | RASTERCHECK_LACKS_DEPTH_CLAMP |
             RASTERCHECK_LACKS_NOPERSPECTIVE | RASTERCHECK_LACKS_CENTER |
             RASTERCHECK_LACKS_CENTROID,
};

/* Grid units are below 2^23, so the sum is off by u 2^23, which is less than position_error. */
static double half_up(double grid_units) { return floor(grid_units + 0.5); }

/* b0 and b1 are at most 1 and rounded to float32: off by 2^-25 each, b2 by both together, and the
 * value by 2^-25 (|r0 - r2| + |r1 - r2|), at most 2^-24 of the range. Operations in double add a
 * few u of the greatest value. */
static float value_of(const double r[3], const double weight[3]) {
  const double sum = weight[0] + weight[1] + weight[2];
  const double b0 = (float)(weight[0] / sum), b1 = (float)(weight[1] / sum);
  return (float)(b0 * r[0] + b1 * r[1] + (1 - b0 - b1) * r[2]);
}

static void visit(const rastercheck_draw* draw, rastercheck_output* out, const void* shape,
                  place at) {
  const triangle* t = shape;
  double e[3];
  edges_at(t, at, e);
  if (!covers(draw, t, e)) return;
  if (!keep(draw, out, at.index, t->number, depth_at(draw, t->depth, e))) return;
  write_attributes(draw, out, t, at.index, e, value_of);
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  return draw_snapped(draw, out, 256, half_up, visit);
}

TYPICAL_PLUGIN("ids and barycentrics", contract, draw_all)
