/*
 * Judges a rasterizer that gives only 8-bit images and knows nothing of triangles or pixels.
 * Leave this file as it is, except for the contract; rasterizer.c or rasterizer.cpp is yours.
 *
 * Each draw becomes several images. In the first one a triangle's colour is its number, the same at
 * all three vertices, so each pixel says which triangle is seen. Every further image shows three
 * attributes as red, green and blue, from 0 at one end of the attribute's range over the triangle
 * to 1 at the other end. A byte B then stands for the value that is B/255 of the way.
 *
 * A byte is off by half a step or more: errors of a value below 1/510 of its range cannot be seen.
 * Depth does not show in a colour. It is computed here from the triangle that is seen, so that
 * RasterCheck can tell whether a nearer one should be; the number itself judges nothing.
 */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image.h"
#include "rastercheck/barycentrics.h"

/* How far a byte may be off, in steps of 1/255: half a step if colours are rounded to the nearest
 * byte, and 1/64 for the rasterizer's own rounding. 1 if it cuts off digits, as (uint8_t)(255 * c)
 * does. */
#define STEPS (0.5F + 1 / 64.F)

/* More that your rasterizer lacks (RASTERCHECK_LACKS_…, added), and how it interpolates. */
#ifndef MORE_LACKS
#define MORE_LACKS 0
#endif
#ifndef CLAIMS
#define CLAIMS RASTERCHECK_CLAIM_PERSPECTIVE
#endif

#define MOST_PIXELS 2048. /* from the window's origin; more is not asked for */
#define MOST_W 0x1p60     /* and as much in 1/w */

/* What is promised: any way to round window positions to 1/256 pixel, any rule for samples on
 * edges. Say more if you know more, and errors that are now permitted are found. */
static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 8,
    .rounding = RASTERCHECK_ROUNDING_UNSPECIFIED,
    .position_error = 0.125F, /* some float32 steps at MOST_PIXELS, in 1/256 pixel */
    .clip_tolerance = 1,
    .tie_rule = RASTERCHECK_TIE_RULE_UNSPECIFIED,
    .basis = RASTERCHECK_BASIS_UNSPECIFIED,
    .claims = CLAIMS,
    .keeps = RASTERCHECK_KEEPS_CONSTANTS,
    .smooth = {.constant = 1, .per_horizon = 4, .per_condition = 4, .range_share = STEPS / 255},
    .depth = {.constant = 1}, /* of the numbers computed here */
    .lacks = RASTERCHECK_LACKS_OPENGL | RASTERCHECK_LACKS_D3D | RASTERCHECK_LACKS_NONPOSITIVE_W |
             RASTERCHECK_LACKS_DEPTH_CLIPPING | RASTERCHECK_LACKS_CLIP_DISTANCES |
             RASTERCHECK_LACKS_DEPTH_CLAMP | RASTERCHECK_LACKS_DEPTH_RANGE |
             RASTERCHECK_LACKS_VIEWPORT | RASTERCHECK_LACKS_SCISSOR | RASTERCHECK_LACKS_CULLING |
             RASTERCHECK_LACKS_NOPERSPECTIVE | RASTERCHECK_LACKS_FLAT | RASTERCHECK_LACKS_CENTER |
             RASTERCHECK_LACKS_CENTROID | RASTERCHECK_LACKS_DEPTH_CLEAR | MORE_LACKS,
    .sample_counts = 1,
    .depth_format = RASTERCHECK_DEPTH_UNORM16, /* your depth buffer, if it is no worse */
};

/* Colours hold 7 bits of a number in each channel, as the odd byte 2 k + 1, which comes back as k
 * even if it is off by one step downwards. */
#define NUMBER_BITS 7
#define MOST_TRIANGLES ((1U << (3 * NUMBER_BITS)) - 1)

static uint32_t answer(rastercheck_output* out, uint32_t result, const char* why) {
  strncpy(out->message, why, out->message_size - 1);
  return result;
}

/* False if a vertex is farther away than is asked for. */
static int is_near(const rastercheck_draw* draw, uint32_t triangle) {
  for (int i = 0; i < 3; ++i) {
    const rastercheck_window_position at = rastercheck_to_window(draw, triangle, i);
    if (!(fabs(at.x) <= MOST_PIXELS && fabs(at.y) <= MOST_PIXELS)) return 0;
    if (!(at.inverse_w <= MOST_W && at.inverse_w >= 1 / MOST_W)) return 0;
  }
  return 1;
}

static float value_of(const rastercheck_draw* draw, uint32_t triangle, int i, uint32_t attribute) {
  const size_t vertex = rastercheck_vertex(draw, triangle, i);
  return draw->attribute_values[vertex * draw->attribute_count + attribute];
}

/* The ends of an attribute's range over a triangle. The first one, shown as 0, is the value of the
 * first vertex at an end, so that negative values behave as positive ones. */
static void ends_of(const rastercheck_draw* draw, uint32_t triangle, uint32_t attribute,
                    double end[2]) {
  const double r[3] = {value_of(draw, triangle, 0, attribute),
                       value_of(draw, triangle, 1, attribute),
                       value_of(draw, triangle, 2, attribute)};
  const double low = fmin(r[0], fmin(r[1], r[2])), high = fmax(r[0], fmax(r[1], r[2]));
  end[0] = r[0] == low || r[0] == high ? r[0] : r[1];
  end[1] = end[0] == low ? high : low;
}

/* Colours triangles by their numbers, which begin with 1; the background is 0. */
static void show_numbers(uint32_t count, image_triangle* triangles) {
  for (uint32_t t = 0; t < count; ++t) {
    for (int i = 0; i < 3; ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        const uint32_t bits = (t + 1) >> (NUMBER_BITS * channel) & ((1U << NUMBER_BITS) - 1);
        triangles[t].vertex[i].color[channel] = (float)(2 * bits + 1) / 255;
      }
    }
  }
}

/* Colours triangles by three attributes from `first` on. */
static void show_attributes(const rastercheck_draw* draw, uint32_t first,
                            image_triangle* triangles) {
  for (uint32_t t = 0; t < draw->triangle_count; ++t) {
    for (uint32_t a = first; a < draw->attribute_count && a < first + 3; ++a) {
      double end[2];
      ends_of(draw, t, a, end);
      for (int i = 0; i < 3; ++i) {
        const double share = (value_of(draw, t, i, a) - end[0]) / (end[1] - end[0]);
        triangles[t].vertex[i].color[a - first] = end[0] == end[1] ? 0 : (float)share;
      }
    }
  }
}

/* The number in a pixel's colour, 0 for the background. */
static uint32_t number_in(const uint8_t* pixel) {
  uint32_t number = 0;
  for (int channel = 0; channel < 3; ++channel) {
    number |= (uint32_t)(pixel[channel] >> 1) << (NUMBER_BITS * channel);
  }
  return number;
}

/* Depth at a pixel's centre, from corners rounded to the grid: these have an area where the
 * unrounded ones may have none. */
static float depth_at(const rastercheck_draw* draw, uint32_t triangle, uint32_t x, uint32_t y) {
  rastercheck_window_position corner[3];
  double s[3];
  for (int i = 0; i < 3; ++i) {
    corner[i] = rastercheck_to_window(draw, triangle, i);
    corner[i].x = rint(corner[i].x * 256) / 256;
    corner[i].y = rint(corner[i].y * 256) / 256;
  }
  if (!rastercheck_screen_barycentrics(corner, x + 0.5, y + 0.5, s)) {
    for (int i = 0; i < 3; ++i) corner[i] = rastercheck_to_window(draw, triangle, i);
    if (!rastercheck_screen_barycentrics(corner, x + 0.5, y + 0.5, s))
      return (float)corner[0].depth;
  }
  return rastercheck_depth_from_screen(draw, triangle, s);
}

/* Reads which triangles are seen. */
static uint32_t read_numbers(const rastercheck_draw* draw, const uint8_t* rgba,
                             rastercheck_output* out) {
  for (uint32_t y = 0; y < draw->height; ++y) {
    for (uint32_t x = 0; x < draw->width; ++x) {
      const size_t at = (size_t)y * draw->width + x;
      const uint32_t number = number_in(&rgba[4 * at]);
      if (number > draw->triangle_count) {
        char why[160];
        snprintf(
            why, sizeof(why),
            "pixel (%u, %u) has the colour %d %d %d, which no triangle has: colours must not be "
            "blended, filtered or converted",
            (unsigned)x, (unsigned)y, rgba[4 * at], rgba[4 * at + 1], rgba[4 * at + 2]);
        return answer(out, RASTERCHECK_FAILED, why);
      }
      if (number == 0) continue;
      out->coverage[at] = 1;
      out->triangle[at] = number - 1;
      out->depth[at] = depth_at(draw, number - 1, x, y);
    }
  }
  return RASTERCHECK_OK;
}

/* Reads three attributes from `first` on. */
static void read_attributes(const rastercheck_draw* draw, uint32_t first, const uint8_t* rgba,
                            rastercheck_output* out) {
  const size_t pixels = (size_t)draw->width * draw->height, count = draw->attribute_count;
  for (size_t at = 0; at < pixels; ++at) {
    if (!out->coverage[at]) continue;
    for (uint32_t a = first; a < count && a < first + 3; ++a) {
      double end[2];
      ends_of(draw, out->triangle[at], a, end);
      const double share = rgba[4 * at + a - first] / 255.;
      out->attributes[at * count + a] =
          share == 0 ? (float)end[0] : (float)(end[0] + (end[1] - end[0]) * share);
    }
  }
}

static uint32_t draw_images(const rastercheck_draw* draw, rastercheck_output* out,
                            image_triangle* triangles, uint8_t* rgba) {
  const size_t bytes = (size_t)draw->width * draw->height * 4;
  const uint32_t count = draw->triangle_count;
  show_numbers(count, triangles);
  draw_image(triangles, count, draw->width, draw->height, rgba);
  const uint32_t result = read_numbers(draw, rgba, out);
  for (uint32_t a = 0; a < draw->attribute_count && result == RASTERCHECK_OK; a += 3) {
    memset(rgba, 0, bytes);
    show_attributes(draw, a, triangles);
    draw_image(triangles, count, draw->width, draw->height, rgba);
    read_attributes(draw, a, rgba, out);
  }
  return result;
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  const uint32_t count = draw->triangle_count;
  if (count > MOST_TRIANGLES) return answer(out, RASTERCHECK_UNSUPPORTED, "too many triangles");
  for (uint32_t t = 0; t < count; ++t) {
    if (!is_near(draw, t)) return answer(out, RASTERCHECK_UNSUPPORTED, "a vertex too far away");
  }
  image_triangle* triangles = calloc(count, sizeof(image_triangle));
  uint8_t* rgba = calloc((size_t)draw->width * draw->height, 4);
  uint32_t result = RASTERCHECK_FAILED;
  if (triangles != NULL && rgba != NULL) {
    for (uint32_t t = 0; t < count; ++t) {
      for (int i = 0; i < 3; ++i) {
        memcpy(triangles[t].vertex[i].position, rastercheck_position(draw, t, i),
               4 * sizeof(float));
      }
    }
    result = draw_images(draw, out, triangles, rgba);
  }
  free(triangles);
  free(rgba);
  return result;
}

static const rastercheck_plugin plugin = {
    .size = sizeof(rastercheck_plugin),
    .abi = RASTERCHECK_PLUGIN_ABI,
    .name = "image",
    .version = "1.0",
    .contract = &contract,
    .draw = draw_all,
};

const rastercheck_plugin* rastercheck_plugin_get(void) { return &plugin; }
