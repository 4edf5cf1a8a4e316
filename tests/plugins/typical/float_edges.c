/*
 * Edge functions in float32, as in most people's first rasterizer: no subpixel grid and no clipper.
 * Values come from the float positions, in double.
 *
 * Each edge is evaluated from the same end for both of its sides, so two triangles that share an
 * edge get the same number with opposite signs: neither gaps nor samples drawn twice.
 *
 * The position error is in units of a grid of 2^-16 pixels. An operation on float32 has a relative
 * error of h = 2^-24, vertices lie within 4096 pixels, and targets have at most 2048:
 *
 * - Positions: (x/w / 2 + 1/2) width has three roundings, h (4096 + 1024), h 4096 and h 4096
 *   pixels, together 52 grid units.
 * - Edges: (v - y0)(x1 - x0) - (u - x0)(y1 - y0) is off by 3 h of each product; the subtraction
 *   keeps the sign. Moving both ends by d along both axes changes it by
 *   d (|x1 - x0| + |y1 - y0|). A sample in the triangle's box is within 6144 pixels of x0 and y0,
 *   so d = 3 h 6144 pixels = 72 grid units account for the error. Two edges that are off by d meet
 *   within 2 d of their corner; the box cuts off what extends farther at sharper corners.
 * - Values: 27 grid units, see set_weights().
 *
 * Together: 52 + 144 + 27 = 223.
 *
 * With BREAKS defined, the viewport is too wide by a share of 2^-8.
 */
#include "common.h"

#define FARTHEST 4096. /* pixels from the window's origin */

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 16,
    .rounding = RASTERCHECK_ROUNDING_UNSPECIFIED,
    .position_error = 256,
    .tie_rule = RASTERCHECK_TIE_RULE_UNSPECIFIED,
    .basis = RASTERCHECK_BASIS_UNSPECIFIED, /* float positions, neither exact nor on a grid */
    .keeps = RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH |
             RASTERCHECK_KEEPS_SIGN_OF_ZERO,
    .smooth = {.constant = 0.5F + 0x1p-24F}, /* see mean_of() */
    .noperspective = {.constant = 0.5F + 0x1p-24F},
    .depth = {.constant = 0.5F + 0x1p-9F},
    .lacks = RASTERCHECK_LACKS_VULKAN | RASTERCHECK_LACKS_D3D | RASTERCHECK_LACKS_NONPOSITIVE_W |
             RASTERCHECK_LACKS_DEPTH_CLIPPING | RASTERCHECK_LACKS_CLIP_DISTANCES |
             RASTERCHECK_LACKS_DEPTH_CLAMP | RASTERCHECK_LACKS_VIEWPORT,
    .sample_counts = 1,
    .max_size = 2048,
};

static float window_position(float c, float w, uint32_t size) {
#ifdef BREAKS
  c *= 1 + 0x1p-8F;
#endif
  return (c / w * 0.5F + 0.5F) * (float)size;
}

/* Returns twice the area between edge i and a point, from the end of lesser x (or y). */
static float edge_at(const triangle* t, int i, float u, float v) {
  int from = (i + 1) % 3, to = (i + 2) % 3;
  float sign = 1;
  if (t->x[to] < t->x[from] || (t->x[to] == t->x[from] && t->y[to] < t->y[from])) {
    from = (i + 2) % 3;
    to = (i + 1) % 3;
    sign = -1;
  }
  const float x0 = (float)t->x[from], y0 = (float)t->y[from];
  const float x1 = (float)t->x[to], y1 = (float)t->y[to];
  return sign * ((v - y0) * (x1 - x0) - (u - x0) * (y1 - y0));
}

static bool is_inside(const triangle* t, place at) {
  if (at.u < least(t->x) || at.u > greatest(t->x)) return false;
  if (at.v < least(t->y) || at.v > greatest(t->y)) return false;
  const double turn = t->area > 0 ? 1 : -1;
  for (int i = 0; i < 3; ++i) {
    const double e = turn * (double)edge_at(t, i, (float)at.u, (float)at.v);
    const double a = turn * t->a[i], b = turn * t->b[i];
    if (!(e > 0 || (e == 0 && (a > 0 || (a == 0 && b > 0))))) return false;
  }
  return true;
}

/* Replaces a sample by the nearest point of the outline. */
static void set_weights_of_outline(const triangle* t, place at, double e[3]) {
  double nearest = INFINITY;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double x = t->x[k] - t->x[j], y = t->y[k] - t->y[j], square = x * x + y * y;
    const double u = at.u - t->x[j], v = at.v - t->y[j];
    const double share = square > 0 ? fmin(fmax((u * x + v * y) / square, 0), 1) : 0;
    const double distance = hypot(u - share * x, v - share * y);
    if (!(distance < nearest)) continue;
    nearest = distance;
    e[i] = 0;
    e[j] = 1 - share;
    e[k] = share;
  }
}

/* Computes twice the areas opposite the vertices, none of them negative. With S <= 2^13 the size of
 * the box, E the sum of |x1 - x0| + |y1 - y0| over the edges and u = 2^-53, rounding changes them
 * by 2 u S E together, as if the triangle were moved by 2 u S^2 E / t->area: less than 2^-12 pixels
 * = 16 grid units, unless t->area < 2^-14 E. A triangle of less is at most 2^-12.5 pixels = 11 grid
 * units thick, and the outline that near. */
static void set_weights(const triangle* t, place at, double e[3]) {
  const double turn = t->area > 0 ? 1 : -1;
  double lengths = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    lengths += fabs(t->a[i]) + fabs(t->b[i]);
    e[i] = turn * ((t->x[j] - at.u) * (t->y[k] - at.v) - (t->x[k] - at.u) * (t->y[j] - at.v)) + 0.;
  }
  const bool is_thin = fabs(t->area) < 0x1p-14 * lengths;
  if (is_thin || least(e) < 0) set_weights_of_outline(t, at, e);
}

static void visit(const rastercheck_draw* draw, rastercheck_output* out, const void* shape,
                  place at) {
  const triangle* t = shape;
  double e[3];
  if (!is_inside(t, at)) return;
  set_weights(t, at, e);
  if (!keep(draw, out, at.index, t->number, depth_at(draw, t->depth, e))) return;
  write_attributes(draw, out, t, at.index, e, rounded_mean);
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  for (uint32_t number = 0; number < draw->triangle_count; ++number) {
    triangle t = to_window(draw, number);
    for (int i = 0; i < 3; ++i) {
      const float* p = draw->positions + 4 * (size_t)t.vertex[i];
      t.x[i] = (double)window_position(p[0], p[3], draw->width);
      t.y[i] = (double)window_position(p[1], p[3], draw->height);
    }
    if (!is_within(&t, FARTHEST)) return refuse(out, "a vertex farther than 4096 pixels away");
    set_edges(&t, 1);
    if (is_kept(draw, t.area)) each_sample_of(draw, out, &t, visit);
  }
  return RASTERCHECK_OK;
}

TYPICAL_PLUGIN("float edges", contract, draw_all)
