/*
 * Conservative coverage, as voxelizers and occlusion cullers need it: every pixel that a triangle
 * touches, on a grid of 1/256 pixel, and nothing but coverage. One sample, Vulkan's conventions,
 * the whole framebuffer.
 *
 * Does not clip: refuses vertices beyond 32768 pixels.
 *
 * With BREAKS defined, edges are tested at the pixel's centre along v.
 */
#include "common.h"

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 8,
    .rounding = RASTERCHECK_ROUNDING_NEAREST_EVEN,
    .position_error = 0x1p-27F, /* 2^-35 pixels, see to_window() */
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .conservative = RASTERCHECK_CONSERVATIVE_OUTER,
    .lacks = RASTERCHECK_LACKS_OPENGL | RASTERCHECK_LACKS_D3D | RASTERCHECK_LACKS_NONPOSITIVE_W |
             RASTERCHECK_LACKS_DEPTH_CLIPPING | RASTERCHECK_LACKS_CLIP_DISTANCES |
             RASTERCHECK_LACKS_DEPTH_CLAMP | RASTERCHECK_LACKS_DEPTH_TEST |
             RASTERCHECK_LACKS_VIEWPORT | RASTERCHECK_LACKS_SMOOTH |
             RASTERCHECK_LACKS_NOPERSPECTIVE | RASTERCHECK_LACKS_FLAT | RASTERCHECK_LACKS_DEPTH,
    .sample_counts = 1,
};

/* True if the open square of the pixel with this corner meets the triangle: separating axes are
 * those of the pixel and the edges' normals. An edge function is greatest at the corner that its
 * normal points to. All numbers are whole, see `triangle`. */
static bool touches(const triangle* t, double x, double y) {
  const double turn = t->area > 0 ? 1 : -1;
  if (!(greatest(t->x) > x && least(t->x) < x + 1)) return false;
  if (!(greatest(t->y) > y && least(t->y) < y + 1)) return false;
  for (int i = 0; i < 3; ++i) {
    const double a = turn * t->a[i], b = turn * t->b[i];
    const double u = a > 0 ? x + 1 : x;
#ifdef BREAKS
    const double v = y + 0.5;
#else
    const double v = b > 0 ? y + 1 : y;
#endif
    if (!(a * (u * t->grid) + b * (v * t->grid) + turn * t->c[i] > 0)) return false;
  }
  return true;
}

static void draw_triangle(const rastercheck_draw* draw, rastercheck_output* out,
                          const triangle* t) {
  const double right = fmin(draw->width, (double)draw->scissor_x + draw->scissor_width);
  const double end = fmin(draw->height, (double)draw->scissor_y + draw->scissor_height);
  const double x_end = fmin(right, floor(greatest(t->x)) + 1);
  const double y_end = fmin(end, floor(greatest(t->y)) + 1);
  for (double y = fmax(fmax(0, draw->scissor_y), floor(least(t->y))); y < y_end; ++y) {
    for (double x = fmax(fmax(0, draw->scissor_x), floor(least(t->x))); x < x_end; ++x) {
      const size_t index = (size_t)y * draw->width + (size_t)x;
      if (touches(t, x, y)) out->coverage[index] = 1;
    }
  }
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  for (uint32_t number = 0; number < draw->triangle_count; ++number) {
    triangle t = to_window(draw, number);
    if (!is_within(&t, GUARD_BAND)) return refuse(out, "a vertex too far away");
    snap(&t, 256, rint);
    if (is_kept(draw, t.area)) draw_triangle(draw, out, &t);
  }
  return RASTERCHECK_OK;
}

TYPICAL_PLUGIN("conservative", contract, draw_all)
