/*
 * What nearly every plugin has to compute to show what its rasterizer drew: attributes and depth
 * from a triangle's number and barycentric coordinates, and the changes between conventions. C99 or
 * C++, header only; needs rastercheck/plugin.h and nothing else.
 *
 * Notation. A triangle has vertices 0, 1, 2 with clip coordinates x, y, z, w. Two kinds of weights
 * say where a sample lies in it, both with sum 1:
 *
 *   screen barycentrics s_i       linear in the window: areas of the parts of the drawn triangle
 *   perspective barycentrics b_i  linear in clip space: what smooth attributes are weighted with
 *
 *   b_i = (s_i / w_i) / Σ (s_j / w_j)        s_i = b_i w_i / Σ b_j w_j
 *
 * Everything is computed in double. Each function of weights in double is off by a few 2^-53 of the
 * greatest vertex value: promise a bound of 0.5 + 2^-20 for values that are then rounded to float.
 * Weights that were stored as floats have errors of their own. If each weight is off by at most e:
 *
 *   smooth attributes   off by 2 e of the range of the vertices' values: range_share = 2 e.
 *                       2 e = 2^-24 for weights rounded to float32, and 1/255 for 8-bit weights
 *   depth               off by 2 e of the range of the vertices' depths. For depth from perspective
 *                       barycentrics e is the *relative* error of each weight, 2^-24 for float32.
 *                       Float32 loses digits below 2^-126: refuse w that differ by 2^75 or more
 */
#ifndef RASTERCHECK_BARYCENTRICS_H
#define RASTERCHECK_BARYCENTRICS_H

#include <stddef.h>
#include <stdint.h>

#include "rastercheck/plugin.h"

/* ------------------------------------------------------------------------------------------------
 * Vertices.
 */

/* The number of a triangle's vertex i (0, 1, 2) in the arrays of the draw. */
static inline uint32_t rastercheck_vertex(const rastercheck_draw* draw, uint32_t triangle, int i) {
  return draw->indices[3 * (size_t)triangle + (size_t)i];
}

/* The clip position x, y, z, w of a triangle's vertex i. */
static inline const float* rastercheck_position(const rastercheck_draw* draw, uint32_t triangle,
                                                int i) {
  return draw->positions + 4 * (size_t)rastercheck_vertex(draw, triangle, i);
}

/* A vertex in the window. */
typedef struct rastercheck_window_position {
  double x, y;      /* pixels; row 0 of the framebuffer has 0 <= y < 1 */
  double depth;     /* in the depth range, not clamped */
  double inverse_w; /* 1/w */
} rastercheck_window_position;

/* Maps z/w to the draw's depth range, without clamping. */
static inline double rastercheck_depth_of_ndc(const rastercheck_draw* draw, double z) {
  const double from_zero = draw->rules == RASTERCHECK_RULES_OPENGL ? (z + 1) / 2 : z;
  return draw->min_depth + ((double)draw->max_depth - draw->min_depth) * from_zero;
}

/* The window position of a triangle's vertex i, whose w must be above 0. */
static inline rastercheck_window_position rastercheck_to_window(const rastercheck_draw* draw,
                                                                uint32_t triangle, int i) {
  const float* p = rastercheck_position(draw, triangle, i);
  const double w = p[3], half_width = draw->viewport_width / 2.0;
  const double half_height = draw->viewport_height / 2.0;
  const double up = draw->rules == RASTERCHECK_RULES_D3D ? -1 : 1;
  rastercheck_window_position at;
  at.x = p[0] / w * half_width + (draw->viewport_x + half_width);
  at.y = p[1] / w * (up * half_height) + (draw->viewport_y + half_height);
  at.depth = rastercheck_depth_of_ndc(draw, p[2] / w);
  at.inverse_w = 1 / w;
  return at;
}

/* ------------------------------------------------------------------------------------------------
 * Weights.
 */

/* Divides weights by their sum; returns 0, and changes nothing, if that is 0. */
static inline int rastercheck_normalize(double weight[3]) {
  const double sum = weight[0] + weight[1] + weight[2];
  int i;
  if (sum == 0) return 0;
  for (i = 0; i < 3; ++i) weight[i] /= sum;
  return 1;
}

/* Screen barycentrics of the point (x, y) of the window. Returns 0 if the triangle has no area. */
static inline int rastercheck_screen_barycentrics(const rastercheck_window_position corner[3],
                                                  double x, double y, double s[3]) {
  int i;
  for (i = 0; i < 3; ++i) {
    const rastercheck_window_position *j = &corner[(i + 1) % 3], *k = &corner[(i + 2) % 3];
    s[i] = (j->x - x) * (k->y - y) - (k->x - x) * (j->y - y);
  }
  return rastercheck_normalize(s);
}

/* Perspective barycentrics from screen barycentrics. Returns 0 if they have no finite sum, which
 * cannot happen inside a triangle whose vertices all have w > 0. */
static inline int rastercheck_perspective_from_screen(const rastercheck_draw* draw,
                                                      uint32_t triangle, const double s[3],
                                                      double b[3]) {
  int i;
  for (i = 0; i < 3; ++i) b[i] = s[i] / rastercheck_position(draw, triangle, i)[3];
  return rastercheck_normalize(b);
}

/* Screen barycentrics from perspective barycentrics. Returns 0 as above. */
static inline int rastercheck_screen_from_perspective(const rastercheck_draw* draw,
                                                      uint32_t triangle, const double b[3],
                                                      double s[3]) {
  int i;
  for (i = 0; i < 3; ++i) s[i] = b[i] * rastercheck_position(draw, triangle, i)[3];
  return rastercheck_normalize(s);
}

/* The weighted mean of three values. Begins at one value and adds differences, so that three equal
 * values give exactly that value, whatever the weights. */
static inline double rastercheck_mean(const double value[3], const double weight[3]) {
  return value[0] + ((value[1] - value[0]) * weight[1] + (value[2] - value[0]) * weight[2]);
}

/* ------------------------------------------------------------------------------------------------
 * Attributes.
 */

/* Attribute a at perspective barycentrics b, as its interpolation asks. A flat one is the value of
 * the provoking vertex. A noperspective one needs screen barycentrics, which are computed from b:
 * with b in float32 that is off as depth is, and `noperspective` has to be promised accordingly. */
static inline float rastercheck_attribute_at(const rastercheck_draw* draw, uint32_t triangle,
                                             uint32_t a, const double b[3]) {
  const uint32_t interpolation = draw->attributes[a].interpolation;
  const int provoking = draw->rules == RASTERCHECK_RULES_OPENGL ? 2 : 0;
  double value[3], s[3];
  int i;
  for (i = 0; i < 3; ++i) {
    value[i] = draw->attribute_values[(size_t)rastercheck_vertex(draw, triangle, i) *
                                          draw->attribute_count +
                                      a];
  }
  if (interpolation == RASTERCHECK_FLAT) return (float)value[provoking];
  if (interpolation == RASTERCHECK_SMOOTH) return (float)rastercheck_mean(value, b);
  rastercheck_screen_from_perspective(draw, triangle, b, s);
  return (float)rastercheck_mean(value, s);
}

/* ------------------------------------------------------------------------------------------------
 * Depth, which RasterCheck wants linear in the window, least at the nearest, and in the depth
 * range: z/w, mapped to min_depth … max_depth.
 */

/* Rounds a depth to float, and clamps it to the depth range where the draw asks for that. */
static inline float rastercheck_clamped_depth(const rastercheck_draw* draw, double depth) {
  const double n = draw->min_depth, f = draw->max_depth;
  const double least = n < f ? n : f, greatest = n < f ? f : n;
  if (draw->depth_clamp || draw->rules == RASTERCHECK_RULES_D3D) {
    if (depth < least) depth = least;
    if (depth > greatest) depth = greatest;
  }
  return (float)depth;
}

/* Depth at screen barycentrics, for rasterizers that give none. */
static inline float rastercheck_depth_from_screen(const rastercheck_draw* draw, uint32_t triangle,
                                                  const double s[3]) {
  double z[3];
  int i;
  for (i = 0; i < 3; ++i) {
    const float* p = rastercheck_position(draw, triangle, i);
    z[i] = (double)p[2] / p[3];
  }
  return rastercheck_clamped_depth(draw, rastercheck_depth_of_ndc(draw, rastercheck_mean(z, s)));
}

/* Depth from a buffer of 1/w, and from one of w (linear in view space). A rasterizer that keeps
 * only these never sees z: its projection must be the one of the case, z = a w + b at all vertices,
 * and then z/w = a + b/w. A perspective projection with planes at n and f has
 *
 *   Vulkan, Direct3D   a = f / (f - n)        b = -f n / (f - n)
 *   OpenGL             a = (f + n) / (f - n)  b = -2 f n / (f - n)
 *
 * rastercheck_has_projection() says whether a draw fits; refuse it (RASTERCHECK_UNSUPPORTED) if
 * not. An error e of 1/w makes depth wrong by |b| e times the depth range. */
static inline float rastercheck_depth_from_inverse_w(const rastercheck_draw* draw, double inverse_w,
                                                     double a, double b) {
  return rastercheck_clamped_depth(draw, rastercheck_depth_of_ndc(draw, a + b * inverse_w));
}
static inline float rastercheck_depth_from_w(const rastercheck_draw* draw, double w, double a,
                                             double b) {
  return rastercheck_depth_from_inverse_w(draw, 1 / w, a, b);
}

/* Whether z = a w + b at all vertices of the draw, up to `tolerance` times |a w| + |b|. */
static inline int rastercheck_has_projection(const rastercheck_draw* draw, double a, double b,
                                             double tolerance) {
  uint32_t v;
  for (v = 0; v < draw->vertex_count; ++v) {
    const double z = draw->positions[4 * (size_t)v + 2];
    const double scaled = a * draw->positions[4 * (size_t)v + 3];
    const double size = (scaled < 0 ? -scaled : scaled) + (b < 0 ? -b : b);
    const double difference = z - (scaled + b);
    if (!((difference < 0 ? -difference : difference) <= tolerance * size)) return 0;
  }
  return 1;
}

/* For rasterizers with a reversed depth buffer, in which the greatest depth wins: hand them z of
 * rastercheck_reversed_z() in place of z, clear the buffer to rastercheck_reversed_depth() of
 * depth_clear, and turn each depth back by that function. The order of two depths is kept except
 * where z has to be rounded for a rasterizer that takes floats: promise a depth bound 1 greater. */
static inline double rastercheck_reversed_z(const rastercheck_draw* draw, const float position[4]) {
  const double z = position[2], w = position[3];
  return draw->rules == RASTERCHECK_RULES_OPENGL ? -z : w - z;
}
static inline double rastercheck_reversed_depth(const rastercheck_draw* draw, double depth) {
  return (double)draw->min_depth + draw->max_depth - depth;
}

/* ------------------------------------------------------------------------------------------------
 * The framebuffer.
 */

/* The index of a sample in coverage, triangle and depth; times attribute_count, in attributes. */
static inline size_t rastercheck_index(const rastercheck_draw* draw, uint32_t x, uint32_t y,
                                       uint32_t sample) {
  return ((size_t)y * draw->width + x) * draw->samples + sample;
}

/* The row of RasterCheck for row y of an image that begins at the other side. Row 0 has the least
 * window y: the bottom row with OpenGL's rules, the top row with the others. */
static inline uint32_t rastercheck_row(const rastercheck_draw* draw, uint32_t y) {
  return draw->height - 1 - y;
}

/* Moves a clip position by pixels of the window, for rasterizers whose samples are not at the
 * pixels' centres. One that samples pixel (x, y) at its corner (x, y) draws what RasterCheck asks
 * for at the centre (x + 1/2, y + 1/2) if all vertices are moved by (-1/2, -1/2), which is the same
 * as a viewport whose x and y are 1/2 less. What this costs:
 *
 *   - the viewport's borders move along, so it has to be the whole framebuffer
 *     (RASTERCHECK_LACKS_VIEWPORT), and what the rasterizer cuts off at its window is half a pixel
 *     elsewhere: hand it one row and column more, or refuse triangles beyond the window
 *     (RASTERCHECK_LACKS_SIDE_CLIPPING);
 *   - if the rasterizer takes floats, moving rounds x and y to 2^-24 of themselves: add that, in
 *     units of the grid, to position_error. */
static inline void rastercheck_move(const rastercheck_draw* draw, double dx, double dy,
                                    const float position[4], double moved[4]) {
  const double up = draw->rules == RASTERCHECK_RULES_D3D ? -1 : 1;
  moved[0] = position[0] + 2 * dx / draw->viewport_width * position[3];
  moved[1] = position[1] + 2 * dy / (up * draw->viewport_height) * position[3];
  moved[2] = position[2];
  moved[3] = position[3];
}

/* Writes all that RasterCheck wants to know of a sample: that a triangle covers it, and its depth
 * and attributes at perspective barycentrics b. Write output->depth[index] afterwards if the
 * rasterizer has a better depth. */
static inline void rastercheck_cover(const rastercheck_draw* draw, rastercheck_output* output,
                                     size_t index, uint32_t triangle, const double b[3]) {
  double s[3];
  uint32_t a;
  output->coverage[index] = 1;
  output->triangle[index] = triangle;
  rastercheck_screen_from_perspective(draw, triangle, b, s);
  output->depth[index] = rastercheck_depth_from_screen(draw, triangle, s);
  for (a = 0; a < draw->attribute_count; ++a) {
    output->attributes[index * draw->attribute_count + a] =
        rastercheck_attribute_at(draw, triangle, a, b);
  }
}

#endif
