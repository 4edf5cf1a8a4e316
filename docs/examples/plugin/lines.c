/*
 * Lines and points in C11, as a RasterCheck plugin: Bresenham's lines by the diamond-exit rule, and
 * square points. docs/judge-your-rasterizer.md tells how to build it and have it judged.
 *
 * Window positions are snapped to a grid of 1/256 pixel. From there on coverage is exact: which
 * pixels a line selects are signs of integers. Values are computed from the same integers in
 * double, and rounded to float32 once, at the end.
 *
 * Triangles, other lines and D3D's rules are left to others, as are vertices that would be clipped.
 */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "rastercheck/plugin.h"

#define GRID 256          /* points per pixel and axis */
#define GUARD_BAND 16384. /* pixels */

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 8,
    .rounding = RASTERCHECK_ROUNDING_NEAREST_EVEN,
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH,
    /* see mean() */
    .smooth = {.constant = 0.5F + 0x1p-20F, .per_condition = 0x1p-25F},
    .noperspective = {.constant = 0.5F + 0x1p-20F, .per_condition = 0x1p-25F},
    .depth = {.constant = 0.5F + 0x1p-9F},
    .lacks = RASTERCHECK_LACKS_D3D | RASTERCHECK_LACKS_NONPOSITIVE_W |
             RASTERCHECK_LACKS_DEPTH_CLIPPING | RASTERCHECK_LACKS_CLIP_DISTANCES |
             RASTERCHECK_LACKS_SIDE_CLIPPING | RASTERCHECK_LACKS_CENTER |
             RASTERCHECK_LACKS_CENTROID,
    .draws = RASTERCHECK_DRAWS_LINES | RASTERCHECK_DRAWS_POINTS,
};

/* The ends of a line, or a point twice. Coordinates are within 2^22 of the origin. */
typedef struct {
  uint32_t vertex[2];
  int64_t x[2], y[2]; /* snapped */
  double depth[2];    /* z/w */
  double w[2];
} segment;

/* A window coordinate in grid units. c / w is within 1 and the viewport within 2^14 pixels, so
 * division, product, `middle` and sum are off by 2^-53 times that each: by 2^-37 pixels or 2^-29
 * grid units. */
static double window_position(double c, double w, double scale, double middle) {
  return (c / w * scale + middle) * GRID;
}

/* Whether it is certain which grid point is nearest. */
static bool is_certain(double x) { return fabs(x - floor(x) - 0.5) > 0x1p-28; }

/* False where a vertex lies too far away, or too near the middle between two grid points. */
static bool set_up(const rastercheck_draw* draw, const uint32_t* vertices, segment* s) {
  const double half_width = draw->viewport_width / 2.0, half_height = draw->viewport_height / 2.0;
  for (int i = 0; i < 2; ++i) {
    const float* p = draw->positions + 4 * (size_t)vertices[i];
    const double x = window_position(p[0], p[3], half_width, draw->viewport_x + half_width);
    const double y = window_position(p[1], p[3], half_height, draw->viewport_y + half_height);
    if (!(fabs(x) <= GUARD_BAND * GRID && fabs(y) <= GUARD_BAND * GRID)) return false;
    if (!is_certain(x) || !is_certain(y)) return false;
    s->vertex[i] = vertices[i];
    s->x[i] = llrint(x);
    s->y[i] = llrint(y);
    s->w[i] = p[3];
    s->depth[i] = (double)p[2] / p[3];
  }
  return true;
}

/* A number that is moved a little: n + e ε + f ε² for an infinitely small ε > 0. */
typedef struct {
  int64_t n, e, f;
} moved;

static bool is_negative(moved a) { return a.n != 0 ? a.n < 0 : a.e != 0 ? a.e < 0 : a.f < 0; }
static moved magnitude(moved a) { return is_negative(a) ? (moved){-a.n, -a.e, -a.f} : a; }
static moved sum(moved a, moved b) { return (moved){a.n + b.n, a.e + b.e, a.f + b.f}; }
static bool is_below(moved a, int64_t limit) { return is_negative((moved){a.n - limit, a.e, a.f}); }

/* Whether a line selects the pixel with this centre: it meets the open diamond with half diagonals
 * of half a pixel, and does not end in it. To decide ties, the line is moved by -(ε, ε²). In the
 * diamond, |x| + |y| is least at an end of the line or where it crosses one of the axes. */
static bool selects(const segment* s, int64_t centre_x, int64_t centre_y) {
  const moved ax = {s->x[0] - centre_x, -1, 0}, ay = {s->y[0] - centre_y, 0, -1};
  const moved bx = {s->x[1] - centre_x, -1, 0}, by = {s->y[1] - centre_y, 0, -1};
  if (is_below(sum(magnitude(bx), magnitude(by)), GRID / 2)) return false;
  if (is_below(sum(magnitude(ax), magnitude(ay)), GRID / 2)) return true;
  const int64_t dx = s->x[1] - s->x[0], dy = s->y[1] - s->y[0];
  /* |cross| is |dx| times |y| where x is 0, and |dy| times |x| where y is 0. */
  const moved cross = magnitude((moved){ay.n * dx - ax.n * dy, dy, -dx});
  return (is_negative(ax) != is_negative(bx) && is_below(cross, GRID / 2 * llabs(dx))) ||
         (is_negative(ay) != is_negative(by) && is_below(cross, GRID / 2 * llabs(dy)));
}

/* Whether a line covers a pixel. Wide ones are moved back along the minor axis, by half a pixel for
 * each copy but the first, and each pixel that they then select is replicated. */
static bool line_covers(const rastercheck_draw* draw, const segment* line, int64_t x, int64_t y) {
  const bool is_x_major = llabs(line->x[1] - line->x[0]) >= llabs(line->y[1] - line->y[0]);
  const int64_t copies = draw->line_width < 1 ? 1 : llroundf(draw->line_width);
  segment s = *line;
  for (int i = 0; i < 2; ++i) *(is_x_major ? &s.y[i] : &s.x[i]) -= (copies - 1) * (GRID / 2);
  for (int64_t copy = 0; copy < copies; ++copy) {
    const int64_t column = is_x_major ? x : x - copy, row = is_x_major ? y - copy : y;
    if (selects(&s, column * GRID + GRID / 2, row * GRID + GRID / 2)) return true;
  }
  return false;
}

/* Whether a coordinate lies between the sides of a square; if it is on one, by who owns that. */
static bool is_within(double u, double middle, double half, bool is_low_owned) {
  const double low = u - (middle - half), high = middle + half - u;
  return is_low_owned ? low >= 0 && high > 0 : low > 0 && high >= 0;
}

/* Sides of squares are exact: sizes are floats, and sums of them and grid units fit a double. */
static bool point_covers(const rastercheck_draw* draw, const segment* s, int64_t u, int64_t v) {
  const double half = draw->point_size * (GRID / 2.0);
  const bool is_top_owned = draw->tie_rule == RASTERCHECK_TIE_RULE_TOP_LEFT;
  const bool is_y_down = draw->rules != RASTERCHECK_RULES_OPENGL;
  return is_within((double)u, (double)s->x[0], half, true) &&
         is_within((double)v, (double)s->y[0], half, is_top_owned == is_y_down);
}

/* The value of a line at share `of_b` / (`of_a` + `of_b`) from the first end to the second. Where
 * both are equal, so is the result. The shares are off by a few u of themselves, the sum of the two
 * by what cancels in it, which the condition counts: beyond its ends a line has shares of both
 * signs. */
static double mean(double a, double b, double of_a, double of_b) {
  return a == b ? a : a + (b - a) * (of_b / (of_a + of_b));
}

static float depth_at(const rastercheck_draw* draw, const segment* s, const double share[2]) {
  const double n = draw->min_depth, f = draw->max_depth;
  double depth = mean(s->depth[0], s->depth[1], share[0], share[1]);
  if (draw->rules == RASTERCHECK_RULES_OPENGL) depth = (depth + 1) / 2;
  depth = n + (f - n) * depth;
  return (float)(draw->depth_clamp ? fmin(fmax(depth, fmin(n, f)), fmax(n, f)) : depth);
}

static void shade(const rastercheck_draw* draw, const segment* s, const double share[2],
                  float* values) {
  const size_t count = draw->attribute_count;
  const int provoking = draw->rules == RASTERCHECK_RULES_OPENGL ? 1 : 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t how = draw->attributes[i].interpolation;
    const float a = draw->attribute_values[s->vertex[0] * count + i];
    const float b = draw->attribute_values[s->vertex[1] * count + i];
    if (how == RASTERCHECK_FLAT) values[i] = provoking ? b : a;
    if (how == RASTERCHECK_NOPERSPECTIVE) values[i] = (float)mean(a, b, share[0], share[1]);
    if (how == RASTERCHECK_SMOOTH) {
      values[i] = (float)mean(a, b, share[0] / s->w[0], share[1] / s->w[1]);
    }
  }
}

/* The shares of the two ends in the values at a place, times the line's squared length: all in
 * integers below 2^48. */
static void shares_at(const segment* s, int64_t u, int64_t v, double share[2]) {
  const int64_t dx = s->x[1] - s->x[0], dy = s->y[1] - s->y[0];
  share[0] = (double)((s->x[1] - u) * dx + (s->y[1] - v) * dy);
  share[1] = (double)((u - s->x[0]) * dx + (v - s->y[0]) * dy);
  if (dx == 0 && dy == 0) share[0] = 1; /* a point */
}

static void draw_sample(const rastercheck_draw* draw, const segment* s, uint32_t number, int64_t u,
                        int64_t v, size_t i, rastercheck_output* out) {
  double share[2];
  shares_at(s, u, v, share);
  const float depth = depth_at(draw, s, share);
  const float before = out->coverage[i] ? out->depth[i] : draw->depth_clear;
  if (draw->depth_test && !(depth < before)) return;
  out->coverage[i] = 1;
  out->triangle[i] = number;
  out->depth[i] = depth;
  if (draw->attribute_count > 0) {
    shade(draw, s, share, out->attributes + i * draw->attribute_count);
  }
}

static int64_t least(int64_t a, int64_t b) { return a < b ? a : b; }
static int64_t greatest(int64_t a, int64_t b) { return a > b ? a : b; }

static void draw_one(const rastercheck_draw* draw, const segment* s, uint32_t number,
                     rastercheck_output* out) {
  const bool is_line = draw->primitive == RASTERCHECK_LINES;
  const int64_t reach = (int64_t)(is_line ? draw->line_width : draw->point_size) + 2;
  /* Pixels that the box around the primitive, the scissor and the framebuffer have in common. */
  const int64_t x_end = least(draw->width, (int64_t)draw->scissor_x + draw->scissor_width);
  const int64_t y_end = least(draw->height, (int64_t)draw->scissor_y + draw->scissor_height);
  const int64_t x_last = greatest(s->x[0], s->x[1]) / GRID + reach;
  const int64_t y_last = greatest(s->y[0], s->y[1]) / GRID + reach;
  const int64_t x_first = least(s->x[0], s->x[1]) / GRID - reach;
  const int64_t y_first = least(s->y[0], s->y[1]) / GRID - reach;
  if (is_line && s->x[0] == s->x[1] && s->y[0] == s->y[1]) return;
  for (int64_t y = greatest(greatest(0, draw->scissor_y), y_first); y < least(y_end, y_last); ++y) {
    for (int64_t x = greatest(greatest(0, draw->scissor_x), x_first); x < least(x_end, x_last);
         ++x) {
      if (is_line && !line_covers(draw, s, x, y)) continue;
      for (uint32_t sample = 0; sample < draw->samples; ++sample) {
        const int64_t u = x * GRID + llrintf(draw->sample_positions[2 * sample] * GRID);
        const int64_t v = y * GRID + llrintf(draw->sample_positions[2 * sample + 1] * GRID);
        if (!is_line && !point_covers(draw, s, u, v)) continue;
        const size_t i = ((size_t)y * draw->width + (size_t)x) * draw->samples + sample;
        draw_sample(draw, s, number, u, v, i, out);
      }
    }
  }
}

static uint32_t refuse(rastercheck_output* out, const char* why) {
  strncpy(out->message, why, out->message_size - 1);
  return RASTERCHECK_UNSUPPORTED;
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  if (draw->primitive == RASTERCHECK_TRIANGLES) return refuse(out, "triangles");
  if (draw->primitive == RASTERCHECK_LINES && draw->line_mode != RASTERCHECK_LINE_BRESENHAM) {
    return refuse(out, "lines that are not Bresenham's");
  }
  for (uint32_t number = 0; number < draw->triangle_count; ++number) {
    segment s;
    if (!set_up(draw, draw->indices + 3 * (size_t)number, &s)) {
      return refuse(out, "a vertex beyond the guard band, or half-way between grid points");
    }
    draw_one(draw, &s, number, out);
  }
  return RASTERCHECK_OK;
}

static const rastercheck_plugin plugin = {
    .size = sizeof(rastercheck_plugin),
    .abi = RASTERCHECK_PLUGIN_ABI,
    .name = "lines",
    .version = "1.0",
    .contract = &contract,
    .draw = draw_all,
};

const rastercheck_plugin* rastercheck_plugin_get(void) { return &plugin; }
