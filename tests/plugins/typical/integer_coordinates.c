/*
 * Vertices on whole pixels, as in two-dimensional drawing libraries: positions are rounded to the
 * nearest pixel, halves towards greater coordinates. One sample, Vulkan's conventions. Edges on
 * samples do not occur, as samples are half a pixel from every vertex: but diagonals do go through
 * them. Bottom edges own their samples, and right ones that are vertical.
 *
 * With BREAKS defined, positions are cut down to whole pixels instead.
 */
#include "common.h"

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 0,
    .rounding = RASTERCHECK_ROUNDING_HALF_UP,
    .position_error = 0x1p-34F, /* 2^-35 pixels, see to_window(), and the sum with a half */
    .clip_tolerance = 1,        /* a cut runs between snapped vertices: it moves by half a unit */
    .tie_rule = RASTERCHECK_TIE_RULE_BOTTOM_THEN_RIGHT,
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH |
             RASTERCHECK_KEEPS_SIGN_OF_ZERO,
    .smooth = {.constant = 0.5F + 0x1p-24F}, /* see mean_of() */
    .noperspective = {.constant = 0.5F + 0x1p-24F},
    .depth = {.constant = 0.5F + 0x1p-9F}, /* see depth_at() */
    .lacks = RASTERCHECK_LACKS_OPENGL | RASTERCHECK_LACKS_D3D | RASTERCHECK_LACKS_NONPOSITIVE_W |
             RASTERCHECK_LACKS_CLIP_DISTANCES | RASTERCHECK_LACKS_VIEWPORT_FRACTIONS,
    .sample_counts = 1,
};

static double to_whole(double units) {
#ifdef BREAKS
  return floor(units);
#else
  return floor(units + 0.5);
#endif
}

static void visit(const rastercheck_draw* draw, rastercheck_output* out, const void* shape,
                  place at) {
  const triangle* t = shape;
  const double turn = t->area > 0 ? 1 : -1;
  double e[3];
  edges_at(t, at, e);
  for (int i = 0; i < 3; ++i) {
    const double a = turn * t->a[i], b = turn * t->b[i];
    if (!(e[i] > 0 || (e[i] == 0 && (b < 0 || (b == 0 && a < 0))))) return;
  }
  if (is_depth_clipped(draw, t, e)) return;
  if (!keep(draw, out, at.index, t->number, depth_at(draw, t->depth, e))) return;
  write_attributes(draw, out, t, at.index, e, rounded_mean);
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  return draw_snapped(draw, out, 1, to_whole, visit);
}

TYPICAL_PLUGIN("integer coordinates", contract, draw_all)
