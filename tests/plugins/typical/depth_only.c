/*
 * The depth pass of an occlusion culler: OpenGL's conventions, no attributes, one sample, a grid of
 * 1/16 pixel. The depth buffer holds integers of 24 bits and begins with 1, so a depth that is
 * stored as 1 never passes the depth test. The output has the depths before they were stored.
 *
 * Does not clip at the sides: refuses vertices beyond 32768 pixels or with w <= 0.
 */
#include "common.h"

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 4,
    .rounding = RASTERCHECK_ROUNDING_NEAREST_EVEN,
    .position_error = 0x1p-31F, /* 2^-35 pixels, see to_window() */
    .clip_tolerance = 1,        /* a cut runs between snapped vertices: it moves by half a unit */
    .tie_rule = RASTERCHECK_TIE_RULE_AS_ASKED,
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_EQUAL_DEPTH,
    .depth = {.constant = 0.5F + 0x1p-9F}, /* see depth_at() */
    .lacks = RASTERCHECK_LACKS_VULKAN | RASTERCHECK_LACKS_D3D | RASTERCHECK_LACKS_NONPOSITIVE_W |
             RASTERCHECK_LACKS_CLIP_DISTANCES | RASTERCHECK_LACKS_DEPTH_CLAMP |
             RASTERCHECK_LACKS_VIEWPORT | RASTERCHECK_LACKS_SCISSOR | RASTERCHECK_LACKS_SMOOTH |
             RASTERCHECK_LACKS_NOPERSPECTIVE | RASTERCHECK_LACKS_FLAT |
             RASTERCHECK_LACKS_DEPTH_CLEAR,
    .sample_counts = 1,
    .depth_format = RASTERCHECK_DEPTH_UNORM24,
};

/* A depth as stored in the buffer. */
static uint32_t stored(float depth) { return (uint32_t)lrint((double)depth * 0xFFFFFF); }

static void visit(const rastercheck_draw* draw, rastercheck_output* out, const void* shape,
                  place at) {
  const triangle* t = shape;
  double e[3];
  edges_at(t, at, e);
  if (!covers(draw, t, e) || is_depth_clipped(draw, t, e)) return;
  const float depth = depth_at(draw, t->depth, e);
  const uint32_t before = out->coverage[at.index] ? stored(out->depth[at.index]) : 0xFFFFFF;
  if (draw->depth_test && stored(depth) >= before) return;
  out->coverage[at.index] = 1;
  out->triangle[at.index] = t->number;
  out->depth[at.index] = depth;
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  return draw_snapped(draw, out, 16, rint, visit);
}

TYPICAL_PLUGIN("depth only", contract, draw_all)
