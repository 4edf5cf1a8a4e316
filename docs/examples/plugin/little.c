/*
 * A little rasterizer in C11, as a RasterCheck plugin.
 * docs/judge-your-rasterizer.md tells how to build it and have it judged.
 *
 * Window positions are snapped to a grid of 1/256 pixel. From there on coverage is exact: edges are
 * integers, and a sample exactly on one goes by the tie rule. Values come from the same integers,
 * in double, and are rounded to float32 once, at the end.
 *
 * It does not clip. Triangles with some w <= 0, or that reach farther than 32768 pixels, are left
 * to others: it says so (`lacks`, RASTERCHECK_UNSUPPORTED), and is not judged by them.
 *
 * Numbers below: u = 2^-53, by which an operation on doubles is off, relatively. Float32 numbers
 * have steps of more than 2^-24 of themselves, so that 2^-29 of a step is less than u.
 */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "rastercheck/plugin.h"

#define GRID 256          /* points per pixel and axis */
#define GUARD_BAND 32768. /* pixels; as contract.guard_band is where it is 0 */
#define MOST_DEPTH 65536. /* of z/w at vertices */

/* What it promises. Members that are not named are 0: ties as asked, no limits but `lacks`. */
static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 8,
    .rounding = RASTERCHECK_ROUNDING_NEAREST_EVEN,
    .position_error = 0x1p-27F, /* see window_position() */
    .clip_tolerance = 1,        /* a cut runs between snapped vertices: it moves by half a unit */
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH,
    .smooth = {.constant = 0.5F + 0x1p-24F},        /* see weighted_mean() */
    .noperspective = {.constant = 0.5F + 0x1p-24F}, /* the same */
    .depth = {.constant = 0.5F + 0x1p-9F},          /* see depth_at() */
    .lacks = RASTERCHECK_LACKS_NONPOSITIVE_W | RASTERCHECK_LACKS_CENTER,
};

/* A triangle in the window. Edge i lies opposite vertex i: E_i = a u + b v + c is twice the area
 * between it and the point (u, v), in grid units: positive inside, 0 on the edge. Coordinates are
 * within 2^23 of the origin, so that a and b are within 2^24 and E_i within 2^50: exact in int64
 * and in double. */
typedef struct {
  uint32_t vertex[3];
  int64_t x[3], y[3]; /* snapped */
  int64_t a[3], b[3], c[3];
  double z[3], w[3];
  double depth[3]; /* z/w */
} triangle;

static uint32_t refuse(rastercheck_output* out, const char* why) {
  strncpy(out->message, why, out->message_size - 1);
  return RASTERCHECK_UNSUPPORTED;
}

/* A window coordinate in pixels. It and `middle` are within 2^15, so c / w * scale is within 2^16:
 * division and product are off by u 2^16 each, `middle` and the sum by u 2^15 each, all of them by
 * less than 2^-35 pixels or 2^-27 grid units. (scale is half a viewport: exact.) */
static double window_position(double c, double w, double scale, double middle) {
  return c / w * scale + middle;
}

/* Whether begin + size is exact, so that the far border of the viewport is where it should be. */
static bool is_exact_sum(double begin, double size) {
  const double end = begin + size;
  return end - begin == size && end - size == begin;
}

/* False where a vertex lies too far away. */
static bool set_up(const rastercheck_draw* draw, const uint32_t* vertices, triangle* t) {
  const double width = draw->viewport_width, height = draw->viewport_height;
  const double sign_y = draw->rules == RASTERCHECK_RULES_D3D ? -0.5 : 0.5;
  for (int i = 0; i < 3; ++i) {
    const float* p = draw->positions + 4 * (size_t)vertices[i];
    const double x = window_position(p[0], p[3], width / 2, draw->viewport_x + width / 2);
    const double y = window_position(p[1], p[3], height * sign_y, draw->viewport_y + height / 2);
    t->vertex[i] = vertices[i];
    t->z[i] = p[2];
    t->w[i] = p[3];
    t->depth[i] = t->z[i] / t->w[i];
    if (!(fabs(x) <= GUARD_BAND && fabs(y) <= GUARD_BAND)) return false;
    if (!(fabs(t->depth[i]) <= MOST_DEPTH)) return false;
    t->x[i] = llrint(x * GRID); /* to nearest even, the default rounding */
    t->y[i] = llrint(y * GRID);
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    t->a[i] = t->y[j] - t->y[k];
    t->b[i] = t->x[k] - t->x[j];
    t->c[i] = -(t->a[i] * t->x[j] + t->b[i] * t->y[j]);
  }
  return true;
}

static int64_t edge(const triangle* t, int i, int64_t u, int64_t v) {
  return t->a[i] * u + t->b[i] * v + t->c[i];
}

/* Makes edges positive inside; false where the triangle has no area or is culled. */
static bool orient(const rastercheck_draw* draw, triangle* t) {
  const int64_t area = edge(t, 0, t->x[0], t->y[0]);
  const bool is_ccw = (area > 0) == (draw->rules == RASTERCHECK_RULES_OPENGL); /* y up */
  const bool is_front = is_ccw == (draw->front_face == RASTERCHECK_FRONT_FACE_CCW);
  for (int i = 0; i < 3 && area < 0; ++i) {
    t->a[i] = -t->a[i];
    t->b[i] = -t->b[i];
    t->c[i] = -t->c[i];
  }
  return area != 0 && draw->cull != (is_front ? RASTERCHECK_CULL_FRONT : RASTERCHECK_CULL_BACK);
}

/* Whether a sample at which a functional is 0 is inside: by the functional's gradient. */
static bool owns_zero(const rastercheck_draw* draw, double a, double b) {
  const bool is_top_left = draw->tie_rule == RASTERCHECK_TIE_RULE_TOP_LEFT;
  const bool is_y_down = draw->rules != RASTERCHECK_RULES_OPENGL;
  return a > 0 || (a == 0 && (is_top_left == is_y_down ? b > 0 : b < 0));
}

/* Whether Σ d_i E_i / w_i >= 0 (of a distance: > 0, or 0 and owned). Each term is off by a few u of
 * itself, as if d_i were: the cut runs 2^-50 of the triangle's size beside where it should be. */
static bool is_clipped(const rastercheck_draw* draw, const triangle* t, const double d[3],
                       const double weight[3], bool is_distance) {
  double sum = 0, a = 0, b = 0;
  for (int i = 0; i < 3; ++i) sum += d[i] * weight[i];
  if (sum != 0 || !is_distance || draw->rules == RASTERCHECK_RULES_D3D) return sum < 0;
  for (int i = 0; i < 3; ++i) {
    a += d[i] * ((double)t->a[i] / t->w[i]);
    b += d[i] * ((double)t->b[i] / t->w[i]);
  }
  return !(a == 0 && b == 0) && !owns_zero(draw, a, b);
}

static bool is_between(int64_t u, double begin, double size) {
  const double pixels = (double)u / GRID, end = begin + size;
  return pixels >= fmin(begin, end) && pixels < fmax(begin, end);
}

static bool covers(const rastercheck_draw* draw, const triangle* t, int64_t u, int64_t v) {
  double weight[3], near_plane[3], far_plane[3], distance[3];
  for (int i = 0; i < 3; ++i) {
    const int64_t e = edge(t, i, u, v);
    if (e < 0 || (e == 0 && !owns_zero(draw, (double)t->a[i], (double)t->b[i]))) return false;
    weight[i] = (double)e / t->w[i];
    near_plane[i] = draw->rules == RASTERCHECK_RULES_OPENGL ? t->z[i] + t->w[i] : t->z[i];
    far_plane[i] = t->w[i] - t->z[i];
  }
  if (!is_between(u, draw->viewport_x, draw->viewport_width)) return false;
  if (!is_between(v, draw->viewport_y, draw->viewport_height)) return false;
  if (!draw->depth_clamp && (is_clipped(draw, t, near_plane, weight, false) ||
                             is_clipped(draw, t, far_plane, weight, false))) {
    return false;
  }
  for (uint32_t d = 0; d < draw->clip_distance_count; ++d) {
    for (int i = 0; i < 3; ++i) {
      distance[i] = draw->clip_distances[(size_t)t->vertex[i] * draw->clip_distance_count + d];
    }
    if (is_clipped(draw, t, distance, weight, true)) return false;
  }
  return true;
}

/* z/w is linear in the window, so it is the mean of the vertices', weighted by E_i. Beginning at a
 * vertex and adding differences, equal ones come out equal. With Q the greatest |z/w|: quotients
 * are off by u Q, differences, products, their sum and its quotient by 2 u Q each, the sum with the
 * first by u Q; 10 u Q. The depth range adds 3 u Q: 13 u Q of its greater end, which with Q = 2^16
 * is less than 2^-9 of a float32 step. */
static float depth_at(const rastercheck_draw* draw, const triangle* t, const double e[3]) {
  const double n = draw->min_depth, f = draw->max_depth, *z = t->depth;
  double depth = z[0] + ((z[1] - z[0]) * e[1] + (z[2] - z[0]) * e[2]) / (e[0] + e[1] + e[2]);
  if (draw->rules == RASTERCHECK_RULES_OPENGL) depth = (depth + 1) / 2;
  depth = n + (f - n) * depth;
  if (draw->depth_clamp || draw->rules == RASTERCHECK_RULES_D3D) {
    depth = fmin(fmax(depth, fmin(n, f)), fmax(n, f));
  }
  return (float)depth;
}

/* The mean of the vertices' values. The weights are of one sign and off by u of themselves; with
 * products, sums and the quotient the mean is off by 8 u of the greatest value, 2^-26 of a float32
 * step, and by half a step from its rounding. */
static float weighted_mean(const double r[3], const double weight[3]) {
  return (float)((r[0] * weight[0] + r[1] * weight[1] + r[2] * weight[2]) /
                 (weight[0] + weight[1] + weight[2]));
}

/* The attributes at a sample (u, v), or at a point of the pixel that stands for its centroid. */
static void shade(const rastercheck_draw* draw, const triangle* t, const int64_t sample[2],
                  const int64_t centroid[2], float* values) {
  const size_t count = draw->attribute_count;
  const int provoking = draw->rules == RASTERCHECK_RULES_OPENGL ? 2 : 0;
  for (size_t a = 0; a < count; ++a) {
    const rastercheck_attribute* attribute = &draw->attributes[a];
    const int64_t* at = attribute->location == RASTERCHECK_AT_CENTROID ? centroid : sample;
    double r[3], weight[3];
    for (int i = 0; i < 3; ++i) {
      r[i] = draw->attribute_values[t->vertex[i] * count + a];
      weight[i] = (double)edge(t, i, at[0], at[1]);
      if (attribute->interpolation == RASTERCHECK_SMOOTH) weight[i] /= t->w[i]; /* perspective */
    }
    values[a] = attribute->interpolation == RASTERCHECK_FLAT ? (float)r[provoking]
                                                             : weighted_mean(r, weight);
  }
}

static void draw_pixel(const rastercheck_draw* draw, const triangle* t, uint32_t number, int64_t x,
                       int64_t y, rastercheck_output* out) {
  int64_t at[16][2];
  bool is_covered[16];
  int64_t centroid[2] = {x * GRID + GRID / 2, y * GRID + GRID / 2};
  uint32_t covered = 0, first = 0;
  for (uint32_t s = draw->samples; s-- > 0;) {
    at[s][0] = x * GRID + llrintf(draw->sample_positions[2 * s] * GRID);
    at[s][1] = y * GRID + llrintf(draw->sample_positions[2 * s + 1] * GRID);
    is_covered[s] = covers(draw, t, at[s][0], at[s][1]);
    if (is_covered[s]) first = s;
    covered += is_covered[s];
  }
  if (covered < draw->samples) memcpy(centroid, at[first], sizeof(centroid));
  for (uint32_t s = 0; s < draw->samples; ++s) {
    const size_t i = ((size_t)y * draw->width + (size_t)x) * draw->samples + s;
    if (!is_covered[s]) continue;
    const double e[3] = {(double)edge(t, 0, at[s][0], at[s][1]),
                         (double)edge(t, 1, at[s][0], at[s][1]),
                         (double)edge(t, 2, at[s][0], at[s][1])};
    const float depth = depth_at(draw, t, e);
    const float before = out->coverage[i] ? out->depth[i] : draw->depth_clear;
    if (draw->depth_test && !(depth < before)) continue;
    out->coverage[i] = 1;
    out->triangle[i] = number;
    out->depth[i] = depth;
    if (draw->attribute_count > 0) {
      shade(draw, t, at[s], centroid, out->attributes + i * draw->attribute_count);
    }
  }
}

static int64_t least(int64_t a, int64_t b) { return a < b ? a : b; }
static int64_t greatest(int64_t a, int64_t b) { return a > b ? a : b; }

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  const double middle_x = draw->viewport_x + (double)draw->viewport_width / 2;
  const double middle_y = draw->viewport_y + (double)draw->viewport_height / 2;
  if (!(fabs(middle_x) <= GUARD_BAND && fabs(middle_y) <= GUARD_BAND) ||
      !is_exact_sum(draw->viewport_x, draw->viewport_width) ||
      !is_exact_sum(draw->viewport_y, draw->viewport_height)) {
    return refuse(out, "a viewport that is too far away, or of too many digits");
  }
  for (uint32_t number = 0; number < draw->triangle_count; ++number) {
    triangle t;
    if (!set_up(draw, draw->indices + 3 * (size_t)number, &t)) {
      return refuse(out, "a vertex beyond the guard band, or z/w beyond 65536");
    }
    if (!orient(draw, &t)) continue;
    /* Pixels that the triangle's box, the scissor and the framebuffer have in common. */
    const int64_t x_least = least(t.x[0], least(t.x[1], t.x[2]));
    const int64_t y_least = least(t.y[0], least(t.y[1], t.y[2]));
    const int64_t x_most = greatest(t.x[0], greatest(t.x[1], t.x[2]));
    const int64_t y_most = greatest(t.y[0], greatest(t.y[1], t.y[2]));
    const int64_t x_end = least(draw->width, (int64_t)draw->scissor_x + draw->scissor_width);
    const int64_t y_end = least(draw->height, (int64_t)draw->scissor_y + draw->scissor_height);
    for (int64_t y = greatest(greatest(0, draw->scissor_y), y_least / GRID);
         y < least(y_end, y_most / GRID + 1); ++y) {
      for (int64_t x = greatest(greatest(0, draw->scissor_x), x_least / GRID);
           x < least(x_end, x_most / GRID + 1); ++x) {
        draw_pixel(draw, &t, number, x, y, out);
      }
    }
  }
  return RASTERCHECK_OK;
}

static const rastercheck_plugin plugin = {
    .size = sizeof(rastercheck_plugin),
    .abi = RASTERCHECK_PLUGIN_ABI,
    .name = "little",
    .version = "1.0",
    .contract = &contract,
    .draw = draw_all,
};

const rastercheck_plugin* rastercheck_plugin_get(void) { return &plugin; }
