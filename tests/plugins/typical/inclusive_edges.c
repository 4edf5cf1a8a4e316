/*
 * No fill rule: every edge test is >= 0, on a grid of 1/256 pixel, so that a sample exactly on an
 * edge belongs to both of its triangles. One sample, OpenGL's conventions, the whole framebuffer
 * and depths from 0 to 1.
 *
 * With BREAKS defined, every edge test is > 0 instead.
 */
#include "common.h"

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 8,
    .rounding = RASTERCHECK_ROUNDING_NEAREST_EVEN,
    .position_error = 0x1p-27F, /* 2^-35 pixels, see to_window() */
    .clip_tolerance = 1,        /* a cut runs between snapped vertices: it moves by half a unit */
    .tie_rule = RASTERCHECK_TIE_RULE_ALL,
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH |
             RASTERCHECK_KEEPS_SIGN_OF_ZERO,
    .smooth = {.constant = 0.5F + 0x1p-24F}, /* see mean_of() */
    .noperspective = {.constant = 0.5F + 0x1p-24F},
    .depth = {.constant = 0.5F + 0x1p-9F}, /* see depth_at() */
    .lacks = RASTERCHECK_LACKS_VULKAN | RASTERCHECK_LACKS_D3D | RASTERCHECK_LACKS_NONPOSITIVE_W |
             RASTERCHECK_LACKS_CLIP_DISTANCES | RASTERCHECK_LACKS_DEPTH_RANGE |
             RASTERCHECK_LACKS_VIEWPORT,
    .sample_counts = 1,
};

static void visit(const rastercheck_draw* draw, rastercheck_output* out, const void* shape,
                  place at) {
  const triangle* t = shape;
  double e[3];
  edges_at(t, at, e);
#ifdef BREAKS
  if (least(e) <= 0) return;
#endif
  if (least(e) < 0 || is_depth_clipped(draw, t, e)) return;
  if (!keep(draw, out, at.index, t->number, depth_at(draw, t->depth, e))) return;
  write_attributes(draw, out, t, at.index, e, rounded_mean);
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  return draw_snapped(draw, out, 256, rint, visit);
}

TYPICAL_PLUGIN("inclusive edges", contract, draw_all)
