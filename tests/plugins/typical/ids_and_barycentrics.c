/*
 * A visibility buffer: for each sample the nearest triangle, and its perspective-correct
 * barycentric coordinates in float32. A second pass computes depth and values from these alone, by
 * rastercheck/barycentrics.h. Only triangles within the target are drawn; nothing is clipped.
 */
#include <stdlib.h>

#include "common.h"
#include "rastercheck/barycentrics.h"

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 8,
    .rounding = RASTERCHECK_ROUNDING_HALF_UP,
    .position_error = 0x1p-26F, /* 2^-35 pixels, see to_window(), and as much for half_up() */
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH,
    /* Weights are at most 1 and rounded to float32: off by e = 2^-25, and values by 2 e of the
     * range. */
    .smooth = {.constant = 0.5F + 0x1p-20F, .range_share = 0x1p-24F},
    /* Relative errors of weights are at most e = 2^-24. All depths are within the depth range, so
     * that 2 e of their range are at most one step at its greater end. */
    .depth = {.constant = 1.5F + 0x1p-9F},
    .lacks = RASTERCHECK_LACKS_OPENGL | RASTERCHECK_LACKS_NONPOSITIVE_W |
             RASTERCHECK_LACKS_DEPTH_CLIPPING | RASTERCHECK_LACKS_SIDE_CLIPPING |
             RASTERCHECK_LACKS_CLIP_DISTANCES | RASTERCHECK_LACKS_DEPTH_CLAMP |
             RASTERCHECK_LACKS_NOPERSPECTIVE | RASTERCHECK_LACKS_CENTER |
             RASTERCHECK_LACKS_CENTROID,
};

/* The weights of each sample of the target; triangles are numbered in the output. */
static float (*visible)[3];

/* Grid units are below 2^23, so the sum is off by u 2^23, which is less than position_error. */
static double half_up(double grid_units) { return floor(grid_units + 0.5); }

/* Rounds to float32. A cast alone may be lost: of two casts side by side, GCC 12 makes none at -O2.
 */
static float to_float(double weight) {
  const volatile float rounded = (float)weight;
  return rounded;
}

/* The first pass: the rasterizer. Its depth test compares the depths of the second pass: others,
 * however precise, might keep another triangle. */
static void visit(const rastercheck_draw* draw, rastercheck_output* out, const void* shape,
                  place at) {
  const triangle* t = shape;
  double s[3], b[3];
  edges_at(t, at, s);
  if (!covers(draw, t, s)) return;
  rastercheck_perspective_from_screen(draw, t->number, s, b);
  for (int i = 0; i < 3; ++i) b[i] = to_float(b[i]);
  rastercheck_screen_from_perspective(draw, t->number, b, s);
  const float depth = rastercheck_depth_from_screen(draw, t->number, s);
  if (!keep(draw, out, at.index, t->number, depth)) return;
  for (int i = 0; i < 3; ++i) visible[at.index][i] = (float)b[i];
}

/* Whether float32 holds the weights with their relative error: below 2^-126 it does not. Weights on
 * the screen are at least 2^-50 or 0, those for attributes less by at most the ratio of two w. */
static bool has_near_w(const rastercheck_draw* draw, uint32_t number) {
  double w[3];
  for (int i = 0; i < 3; ++i) w[i] = rastercheck_position(draw, number, i)[3];
  return greatest(w) <= 0x1p75 * least(w);
}

/* The second pass: the shim. */
static void resolve(const rastercheck_draw* draw, rastercheck_output* out) {
  const size_t samples = (size_t)draw->width * draw->height * draw->samples;
  for (size_t i = 0; i < samples; ++i) {
    const double b[3] = {visible[i][0], visible[i][1], visible[i][2]};
    if (out->coverage[i]) rastercheck_cover(draw, out, i, out->triangle[i], b);
  }
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  for (uint32_t number = 0; number < draw->triangle_count; ++number) {
    if (!has_near_w(draw, number)) return refuse(out, "w that differ by more than 2^75");
  }
  visible = calloc((size_t)draw->width * draw->height * draw->samples, sizeof(*visible));
  if (visible == NULL) return refuse(out, "no memory for its weights");
  const uint32_t result = draw_snapped(draw, out, 256, half_up, visit);
  if (result == RASTERCHECK_OK) resolve(draw, out);
  free(visible);
  return result;
}

TYPICAL_PLUGIN("ids and barycentrics", contract, draw_all)
