/*
 * The depth buffer of an occlusion culler, as it is stored: integers of 16 bits, rounded away from
 * the viewer, so that nothing behind an occluder's edge is culled for a rounding. OpenGL's
 * conventions, no attributes, one sample, a grid of 1/16 pixel. The buffer begins with 1.
 *
 * Does not clip at the sides: refuses vertices beyond 32768 pixels or with w <= 0.
 *
 * With BREAKS defined, depths are rounded to the nearest integer.
 */
#include "common.h"

#define STEPS 65535.
/* More than depths in double may be too near (depth_at()), in steps. */
#define MARGIN 0x1p-20

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 4,
    .rounding = RASTERCHECK_ROUNDING_NEAREST_EVEN,
    .position_error = 0x1p-31F, /* 2^-35 pixels, see to_window() */
    .clip_tolerance = 1,        /* a cut runs between snapped vertices: it moves by half a unit */
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_EQUAL_DEPTH,
    .depth_error = RASTERCHECK_DEPTH_NEVER_NEARER,
    .depth = {.constant = 1.5F},     /* float32, rounded up */
    .depth_absolute = 0x1.0002p-16F, /* a step of 1/65535 */
    .depth_format = RASTERCHECK_DEPTH_UNORM16,
    .lacks = RASTERCHECK_LACKS_VULKAN | RASTERCHECK_LACKS_D3D | RASTERCHECK_LACKS_NONPOSITIVE_W |
             RASTERCHECK_LACKS_CLIP_DISTANCES | RASTERCHECK_LACKS_DEPTH_CLAMP |
             RASTERCHECK_LACKS_DEPTH_RANGE | RASTERCHECK_LACKS_VIEWPORT |
             RASTERCHECK_LACKS_SCISSOR | RASTERCHECK_LACKS_SMOOTH |
             RASTERCHECK_LACKS_NOPERSPECTIVE | RASTERCHECK_LACKS_FLAT |
             RASTERCHECK_LACKS_DEPTH_CLEAR,
    .sample_counts = 1,
};

/* The mean of z/w, mapped to 0…1, as depth_at() computes it before it rounds to float32. */
static double near_depth(const double z[3], const double e[3]) {
  const double mean = z[0] + ((z[1] - z[0]) * e[1] + (z[2] - z[0]) * e[2]) / (e[0] + e[1] + e[2]);
  return (fmin(fmax(mean, least(z)), greatest(z)) + 1) / 2;
}

static double stored(double depth) {
#ifdef BREAKS
  return rint(depth * STEPS);
#else
  return fmin(ceil(depth * STEPS + MARGIN), STEPS);
#endif
}

/* A stored depth as a float32 that is no nearer. */
static float handed_over(double steps) {
  const float nearest = (float)(steps / STEPS);
  return (double)nearest * STEPS < steps ? nextafterf(nearest, 2) : nearest;
}

static void visit(const rastercheck_draw* draw, rastercheck_output* out, const void* shape,
                  place at) {
  const triangle* t = shape;
  double e[3];
  edges_at(t, at, e);
  if (!covers(draw, t, e) || is_depth_clipped(draw, t, e)) return;
  keep(draw, out, at.index, t->number, handed_over(stored(near_depth(t->depth, e))));
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  return draw_snapped(draw, out, 16, rint, visit);
}

TYPICAL_PLUGIN("depths of occluders", contract, draw_all)
