/*
 * A console of the nineties: positions are cut to 1/12 pixel, each pixel is sampled at 7/12 of its
 * width and height, and there is no clipper: a triangle with a vertex more than 64 pixels outside
 * the viewport, beyond the near or far plane or behind the eye is left out. One sample, Vulkan's
 * conventions.
 *
 * With BREAKS defined it rounds to the nearest grid point instead.
 */
#include "common.h"

#define GRID 12.
#define SAMPLE 7.  /* grid units from the pixel's corner */
#define BEYOND 64. /* pixels */

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .steps_per_pixel = 12,
    .rounding = RASTERCHECK_ROUNDING_FLOOR,
    .position_error = 0x1p-31F, /* 2^-35 pixels, see to_window() */
    .clips = RASTERCHECK_CLIPS_BEYOND_VIEWPORT,
    .guard_band = (float)BEYOND,
    .beyond = RASTERCHECK_BEYOND_LEFT_OUT,
    .tie_rule = RASTERCHECK_TIE_RULE_TOP_LEFT,
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH |
             RASTERCHECK_KEEPS_SIGN_OF_ZERO,
    .smooth = {.constant = 0.5F + 0x1p-24F}, /* see mean_of() */
    .noperspective = {.constant = 0.5F + 0x1p-24F},
    .depth = {.constant = 0.5F + 0x1p-9F}, /* see depth_at() */
    .lacks = RASTERCHECK_LACKS_OPENGL | RASTERCHECK_LACKS_D3D | RASTERCHECK_LACKS_CLIP_DISTANCES |
             RASTERCHECK_LACKS_DEPTH_CLAMP,
    .sample_counts = 1,
    .sample_x = 7,
    .sample_y = 7,
    .sample_parts = 12,
};

static double to_grid(double units) {
#ifdef BREAKS
  return rint(units);
#else
  return floor(units);
#endif
}

static bool owns_sample(const triangle* t, const double e[3]) {
  const double turn = t->area > 0 ? 1 : -1;
  for (int i = 0; i < 3; ++i) {
    const double a = turn * t->a[i], b = turn * t->b[i];
    if (!(e[i] > 0 || (e[i] == 0 && (a > 0 || (a == 0 && b > 0))))) return false;
  }
  return true;
}

/* `t` is in grid units, in which positions and samples are integers. */
static void draw_pixel(const rastercheck_draw* draw, rastercheck_output* out, const triangle* t,
                       double x, double y) {
  const double u = x + SAMPLE / GRID, v = y + SAMPLE / GRID;
  if (!is_between(u, draw->viewport_x, draw->viewport_width)) return;
  if (!is_between(v, draw->viewport_y, draw->viewport_height)) return;
  const place at = {(size_t)y * draw->width + (size_t)x, x * GRID + SAMPLE, y * GRID + SAMPLE};
  double e[3];
  edges_at(t, at, e);
  if (!owns_sample(t, e)) return;
  if (!keep(draw, out, at.index, t->number, depth_at(draw, t->depth, e))) return;
  write_attributes(draw, out, t, at.index, e, rounded_mean);
}

/* True if a vertex has the triangle left out. Comparisons with the planes are exact: z is a
 * float32, and the difference of two of them has the right sign. */
static bool is_left_out(const rastercheck_draw* draw, const triangle* t) {
  const double x[2] = {draw->viewport_x, (double)draw->viewport_x + draw->viewport_width};
  const double y[2] = {draw->viewport_y, (double)draw->viewport_y + draw->viewport_height};
  for (int i = 0; i < 3; ++i) {
    if (t->w[i] <= 0 || t->near_by[i] < 0 || t->far_by[i] < 0) return true;
    if (t->x[i] < fmin(x[0], x[1]) - BEYOND || t->x[i] > fmax(x[0], x[1]) + BEYOND) return true;
    if (t->y[i] < fmin(y[0], y[1]) - BEYOND || t->y[i] > fmax(y[0], y[1]) + BEYOND) return true;
  }
  return false;
}

static void draw_triangle(const rastercheck_draw* draw, rastercheck_output* out, triangle* t) {
  for (int i = 0; i < 3; ++i) {
    t->x[i] = to_grid(t->x[i] * GRID);
    t->y[i] = to_grid(t->y[i] * GRID);
  }
  set_edges(t, 1);
  if (!is_kept(draw, t->area)) return;
  const double right = fmin(draw->width, (double)draw->scissor_x + draw->scissor_width);
  const double end = fmin(draw->height, (double)draw->scissor_y + draw->scissor_height);
  const double x_end = fmin(right, floor(greatest(t->x) / GRID) + 1);
  const double y_end = fmin(end, floor(greatest(t->y) / GRID) + 1);
  for (double y = fmax(fmax(0, draw->scissor_y), floor(least(t->y) / GRID)); y < y_end; ++y) {
    for (double x = fmax(fmax(0, draw->scissor_x), floor(least(t->x) / GRID)); x < x_end; ++x) {
      draw_pixel(draw, out, t, x, y);
    }
  }
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  if (!is_viewport_usable(draw)) return refuse(out, "a viewport too far away or too fine");
  for (uint32_t number = 0; number < draw->triangle_count; ++number) {
    triangle t = to_window(draw, number);
    if (!is_left_out(draw, &t)) draw_triangle(draw, out, &t);
  }
  return RASTERCHECK_OK;
}

TYPICAL_PLUGIN("console", contract, draw_all)
