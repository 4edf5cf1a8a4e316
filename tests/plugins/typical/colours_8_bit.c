/*
 * Draws values as an 8-bit target holds them: each attribute is stored as a share of its range over
 * the triangle, in steps of 1/255, and then converted back to a float. Coverage is exact on a grid
 * of 1/256 pixel; depth is a float32.
 *
 * Does not clip: refuses triangles with some w <= 0, or farther than 32768 pixels.
 *
 * With BREAKS defined, shares are cut down to steps instead of rounded.
 */
#include "common.h"

#define STEPS 255.

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
    /* Half a step of the range, see stored(), and a rounding to float32. */
    .smooth = {.constant = 0.5F + 0x1p-20F, .range_share = 0.5F / 255 + 0x1p-30F},
    .noperspective = {.constant = 0.5F + 0x1p-20F, .range_share = 0.5F / 255 + 0x1p-30F},
    .depth = {.constant = 0.5F + 0x1p-9F},
    .lacks = RASTERCHECK_LACKS_NONPOSITIVE_W | RASTERCHECK_LACKS_CLIP_DISTANCES |
             RASTERCHECK_LACKS_CENTER | RASTERCHECK_LACKS_CENTROID,
    .sample_counts = 1 | 2 | 4,
};

/* A value as the target holds it. The mean is off by 8 u of the greatest value, and so are the two
 * sums here; together they are less than 2^-20 of a float32 step. Shares are counted from a
 * vertex's end of the range, not from the least value, so that negative values behave as positive
 * ones. */
static float stored(const double r[3], const double weight[3]) {
  const double low = least(r), high = greatest(r);
  const double first = r[0] == low || r[0] == high ? r[0] : r[1];
  const double last = first == low ? high : low;
  if (low == high) return (float)first;
  const double share = (mean_of(r, weight) - first) / (last - first);
  double step = rint(fmin(fmax(share, 0), 1) * STEPS); /* the byte that the target holds */
#ifdef BREAKS
  step = floor(fmin(fmax(share, 0), 1) * STEPS);
#endif
  return (float)(first + (last - first) * (step / STEPS));
}

static void visit(const rastercheck_draw* draw, rastercheck_output* out, const void* shape,
                  place at) {
  const triangle* t = shape;
  double e[3];
  edges_at(t, at, e);
  if (!covers(draw, t, e) || is_depth_clipped(draw, t, e)) return;
  if (!keep(draw, out, at.index, t->number, depth_at(draw, t->depth, e))) return;
  write_attributes(draw, out, t, at.index, e, stored);
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  return draw_snapped(draw, out, 256, rint, visit);
}

TYPICAL_PLUGIN("8-bit colours", contract, draw_all)
