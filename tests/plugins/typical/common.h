/*
 * Code shared by the plugins of this folder: the transform from clip positions to the window,
 * triangles on a grid, loops over samples, the depth test and the output. Each plugin says itself
 * what it covers, how it interpolates and what it promises.
 *
 * Units are pixels, unless a name or comment says grid units. u = 2^-53 is the relative error of an
 * operation on doubles. The step of float32 at a number is more than 2^-24 of the number, so that u
 * of the number is less than 2^-29 of a step.
 */
#ifndef RASTERCHECK_TYPICAL_COMMON_H
#define RASTERCHECK_TYPICAL_COMMON_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "rastercheck/plugin.h"

#define GUARD_BAND 32768. /* pixels; what contract.guard_band = 0 means */
#define MOST_DEPTH 65536. /* of z/w at vertices */

/* A triangle of the draw. Edge i lies opposite vertex i: e_i = a u + b v + c, in grid units, is
 * twice the area between the edge and (u, v). All these numbers are integers: coordinates within
 * 2^23 of the origin give a and b within 2^24 and e within 2^50, which doubles hold exactly. */
typedef struct {
  uint32_t number; /* in the draw */
  uint32_t vertex[3];
  double x[3], y[3];                            /* window position */
  double w[3], depth[3], near_by[3], far_by[3]; /* z/w; z and w by how far inside the planes */
  double grid, area, a[3], b[3], c[3];
} triangle;

/* A sample: its index in coverage, depth and triangle, and its position, which is exact because it
 * is a multiple of 1/16. */
typedef struct {
  size_t index;
  double u, v;
} place;

typedef void visitor(const rastercheck_draw* draw, rastercheck_output* out, const void* shape,
                     place at);

static inline uint32_t refuse(rastercheck_output* out, const char* why) {
  strncpy(out->message, why, out->message_size - 1);
  return RASTERCHECK_UNSUPPORTED;
}

static inline double least(const double n[3]) { return fmin(n[0], fmin(n[1], n[2])); }
static inline double greatest(const double n[3]) { return fmax(n[0], fmax(n[1], n[2])); }

/* Transforms a triangle to the window. Within the guard band, x/w times half a viewport is within
 * 2^16 pixels: quotient and product are off by u 2^16 each, the middle and the sum by u 2^15 each,
 * together by less than 2^-35 pixels. */
static inline triangle to_window(const rastercheck_draw* draw, uint32_t number) {
  const double half_width = (double)draw->viewport_width / 2;
  const double half_height = (double)draw->viewport_height / 2;
  const double up = draw->rules == RASTERCHECK_RULES_D3D ? -1 : 1;
  triangle t = {.number = number};
  for (int i = 0; i < 3; ++i) {
    t.vertex[i] = draw->indices[3 * (size_t)number + (size_t)i];
    const float* p = draw->positions + 4 * (size_t)t.vertex[i];
    const double z = p[2];
    t.w[i] = p[3];
    t.x[i] = p[0] / t.w[i] * half_width + (draw->viewport_x + half_width);
    t.y[i] = p[1] / t.w[i] * (up * half_height) + (draw->viewport_y + half_height);
    t.depth[i] = z / t.w[i];
    t.near_by[i] = draw->rules == RASTERCHECK_RULES_OPENGL ? z + t.w[i] : z;
    t.far_by[i] = t.w[i] - z;
  }
  return t;
}

/* True if all vertices are within this many pixels of the origin, and z/w within MOST_DEPTH. */
static inline bool is_within(const triangle* t, double pixels) {
  bool is_near = true;
  for (int i = 0; i < 3; ++i) {
    is_near = is_near && fabs(t->x[i]) <= pixels && fabs(t->y[i]) <= pixels &&
              fabs(t->depth[i]) <= MOST_DEPTH;
  }
  return is_near;
}

/* Sets up the edges of a triangle whose vertices are on a grid of this many points per pixel. */
static inline void set_edges(triangle* t, double grid) {
  t->grid = grid;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    t->a[i] = (t->y[j] - t->y[k]) * grid;
    t->b[i] = (t->x[k] - t->x[j]) * grid;
    t->c[i] = -(t->a[i] * (t->x[j] * grid) + t->b[i] * (t->y[j] * grid));
  }
  t->area = t->a[0] * (t->x[0] * grid) + t->b[0] * (t->y[0] * grid) + t->c[0];
}

/* Rounds vertices to the grid and sets up edges. */
static inline void snap(triangle* t, double grid, double (*round_to_whole)(double)) {
  for (int i = 0; i < 3; ++i) {
    t->x[i] = round_to_whole(t->x[i] * grid) / grid;
    t->y[i] = round_to_whole(t->y[i] * grid) / grid;
  }
  set_edges(t, grid);
}

/* True if a triangle with this signed area is drawn: the area is not 0, and the side not culled. */
static inline bool is_kept(const rastercheck_draw* draw, double area) {
  const bool is_ccw = (area > 0) == (draw->rules == RASTERCHECK_RULES_OPENGL); /* y up */
  const bool is_front = is_ccw == (draw->front_face == RASTERCHECK_FRONT_FACE_CCW);
  return area != 0 && draw->cull != (is_front ? RASTERCHECK_CULL_FRONT : RASTERCHECK_CULL_BACK);
}

/* Computes the e_i at a sample, positive inside. Adding 0. turns -0 into 0: a weight of -0 would
 * turn an attribute's -0 into 0. */
static inline void edges_at(const triangle* t, place at, double e[3]) {
  const double turn = t->area > 0 ? 1 : -1;
  for (int i = 0; i < 3; ++i) {
    e[i] = turn * (t->a[i] * (at.u * t->grid) + t->b[i] * (at.v * t->grid) + t->c[i]) + 0.;
  }
}

/* True if a sample exactly on edge i is inside, by the rule that the case asks for. */
static inline bool owns_ties(const rastercheck_draw* draw, const triangle* t, int i) {
  const double turn = t->area > 0 ? 1 : -1;
  const bool is_top_left = draw->tie_rule == RASTERCHECK_TIE_RULE_TOP_LEFT;
  const bool is_y_down = draw->rules != RASTERCHECK_RULES_OPENGL;
  const double a = turn * t->a[i], b = turn * t->b[i];
  return a > 0 || (a == 0 && (is_top_left == is_y_down ? b > 0 : b < 0));
}

/* True if a sample is inside all edges, with the tie rule. */
static inline bool covers(const rastercheck_draw* draw, const triangle* t, const double e[3]) {
  for (int i = 0; i < 3; ++i) {
    if (!(e[i] > 0 || (e[i] == 0 && owns_ties(draw, t, i)))) return false;
  }
  return true;
}

/* True if the near or far plane cuts a sample off. Each term has a relative error of a few u, as if
 * a vertex's distance were off by that: the cut is off by 2^-50 of the triangle's size. */
static inline bool is_depth_clipped(const rastercheck_draw* draw, const triangle* t,
                                    const double e[3]) {
  double near_by = 0, far_by = 0;
  for (int i = 0; i < 3; ++i) {
    near_by += t->near_by[i] * (e[i] / t->w[i]);
    far_by += t->far_by[i] * (e[i] / t->w[i]);
  }
  return !draw->depth_clamp && (near_by < 0 || far_by < 0);
}

/* Computes the mean of z/w, mapped to the depth range. Starts at one vertex's depth and adds
 * differences, so that equal depths stay equal. With Q the greatest |z/w|, quotients are off by
 * u Q; differences, products, their sum and its quotient by 2 u Q each; the sum with the first
 * depth by u Q; the mapping by 3 u Q. Together that is 13 u Q times the greater end of the range,
 * which with Q = 2^16 is less than 2^-9 of a float32 step. */
static inline float depth_at(const rastercheck_draw* draw, const double z[3], const double e[3]) {
  const double n = draw->min_depth, f = draw->max_depth;
  double depth = z[0] + ((z[1] - z[0]) * e[1] + (z[2] - z[0]) * e[2]) / (e[0] + e[1] + e[2]);
  depth = fmin(fmax(depth, least(z)), greatest(z));
  if (draw->rules == RASTERCHECK_RULES_OPENGL) depth = (depth + 1) / 2;
  depth = n + (f - n) * depth;
  if (draw->depth_clamp || draw->rules == RASTERCHECK_RULES_D3D) {
    depth = fmin(fmax(depth, fmin(n, f)), fmax(n, f));
  }
  return (float)depth;
}

/* Computes the mean of three values. The weights are not negative and have relative errors of 2 u.
 * With products, sums and the quotient, the mean is off by 8 u of the greatest value, which is less
 * than 2^-25 of a float32 step. */
static inline double mean_of(const double r[3], const double weight[3]) {
  return (r[0] * weight[0] + r[1] * weight[1] + r[2] * weight[2]) /
         (weight[0] + weight[1] + weight[2]);
}

static inline float rounded_mean(const double r[3], const double weight[3]) {
  return (float)mean_of(r, weight);
}

/* Writes a fragment's attributes, interpolated by `mean`. */
static inline void write_attributes(const rastercheck_draw* draw, rastercheck_output* out,
                                    const triangle* t, size_t index, const double e[3],
                                    float (*mean)(const double r[3], const double weight[3])) {
  const int provoking = draw->rules == RASTERCHECK_RULES_OPENGL ? 2 : 0;
  const size_t count = draw->attribute_count;
  for (size_t a = 0; a < count; ++a) {
    const uint32_t interpolation = draw->attributes[a].interpolation;
    double r[3], weight[3];
    for (int i = 0; i < 3; ++i) {
      r[i] = draw->attribute_values[t->vertex[i] * count + a];
      weight[i] = interpolation == RASTERCHECK_SMOOTH ? e[i] / t->w[i] : e[i];
    }
    out->attributes[index * count + a] =
        interpolation == RASTERCHECK_FLAT ? (float)r[provoking] : mean(r, weight);
  }
}

/* Writes coverage, triangle and depth; false if the depth test keeps the present fragment. */
static inline bool keep(const rastercheck_draw* draw, rastercheck_output* out, size_t index,
                        uint32_t number, float depth) {
  const float before = out->coverage[index] ? out->depth[index] : draw->depth_clear;
  if (draw->depth_test && !(depth < before)) return false;
  out->coverage[index] = 1;
  out->triangle[index] = number;
  out->depth[index] = depth;
  return true;
}

/* True if begin + size is exact, so that the far border of the viewport is in the right place. */
static inline bool is_exact_sum(double begin, double size) {
  const double end = begin + size;
  return end - begin == size && end - size == begin;
}

/* True if the viewport is near the origin, and its borders are exact as doubles. */
static inline bool is_viewport_usable(const rastercheck_draw* draw) {
  const double x = draw->viewport_x, width = draw->viewport_width;
  const double y = draw->viewport_y, height = draw->viewport_height;
  return fabs(x) <= GUARD_BAND && fabs(x + width) <= GUARD_BAND && fabs(y) <= GUARD_BAND &&
         fabs(y + height) <= GUARD_BAND && is_exact_sum(x, width) && is_exact_sum(y, height);
}

static inline bool is_between(double at, double begin, double size) {
  return at >= fmin(begin, begin + size) && at < fmax(begin, begin + size);
}

/* Visits the samples of pixels that touch [low, high] (x and y), in viewport, scissor and
 * framebuffer. */
static inline void each_sample(const rastercheck_draw* draw, rastercheck_output* out,
                               const double low[2], const double high[2], visitor* visit,
                               const void* shape) {
  const double x_begin = fmax(fmax(0, draw->scissor_x), floor(low[0]));
  const double y_begin = fmax(fmax(0, draw->scissor_y), floor(low[1]));
  const double scissor_right = (double)draw->scissor_x + draw->scissor_width;
  const double scissor_end = (double)draw->scissor_y + draw->scissor_height;
  const double x_end = fmin(fmin(draw->width, scissor_right), floor(high[0]) + 1);
  const double y_end = fmin(fmin(draw->height, scissor_end), floor(high[1]) + 1);
  for (double y = y_begin; y < y_end; ++y) {
    for (double x = x_begin; x < x_end; ++x) {
      for (uint32_t s = 0; s < draw->samples; ++s) {
        const place at = {((size_t)y * draw->width + (size_t)x) * draw->samples + s,
                          x + draw->sample_positions[2 * s], y + draw->sample_positions[2 * s + 1]};
        if (!is_between(at.u, draw->viewport_x, draw->viewport_width)) continue;
        if (!is_between(at.v, draw->viewport_y, draw->viewport_height)) continue;
        visit(draw, out, shape, at);
      }
    }
  }
}

/* Visits the samples of a triangle's box. */
static inline void each_sample_of(const rastercheck_draw* draw, rastercheck_output* out,
                                  const triangle* t, visitor* visit) {
  const double low[2] = {least(t->x), least(t->y)}, high[2] = {greatest(t->x), greatest(t->y)};
  each_sample(draw, out, low, high, visit, t);
}

/* Draws a sample of a triangle, with the tie rule that is asked for and values rounded once. */
static inline void draw_sample(const rastercheck_draw* draw, rastercheck_output* out,
                               const void* shape, place at) {
  const triangle* t = shape;
  double e[3];
  edges_at(t, at, e);
  if (!covers(draw, t, e) || is_depth_clipped(draw, t, e)) return;
  if (!keep(draw, out, at.index, t->number, depth_at(draw, t->depth, e))) return;
  write_attributes(draw, out, t, at.index, e, rounded_mean);
}

/* Draws triangle by triangle, with vertices rounded to a grid of this many points per pixel. Calls
 * `visit` for each sample that may be in the triangle. */
static inline uint32_t draw_snapped(const rastercheck_draw* draw, rastercheck_output* out,
                                    double grid, double (*round_to_whole)(double), visitor* visit) {
  if (!is_viewport_usable(draw)) return refuse(out, "a viewport too far away or too fine");
  for (uint32_t number = 0; number < draw->triangle_count; ++number) {
    triangle t = to_window(draw, number);
    if (!is_within(&t, GUARD_BAND)) return refuse(out, "a vertex too far away");
    snap(&t, grid, round_to_whole);
    if (is_kept(draw, t.area)) each_sample_of(draw, out, &t, visit);
  }
  return RASTERCHECK_OK;
}

/* Defines the function that a plugin exports. */
#define TYPICAL_PLUGIN(plugin_name, plugin_contract, draw_function) \
  static const rastercheck_plugin plugin = {                        \
      .size = sizeof(rastercheck_plugin),                           \
      .abi = RASTERCHECK_PLUGIN_ABI,                                \
      .name = (plugin_name),                                        \
      .version = "1.0",                                             \
      .contract = &(plugin_contract),                               \
      .draw = (draw_function),                                      \
  };                                                                \
  const rastercheck_plugin* rastercheck_plugin_get(void) { return &plugin; }

#endif
