/*
 * A tiny rasterizer that gives only an image. Put yours in its place: draw_image() hands the
 * triangles to your rasterizer and copies its image to `rgba`.
 *
 * Window positions are rounded to a grid of 1/256 pixel. Edges are then integers, and a sample on
 * an edge belongs to the triangle at its right or below it.
 */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "image.h"

#define GRID 256 /* points per pixel and axis */

typedef struct {
  int64_t x[3], y[3];
} corners;

/* Twice the area of a triangle with edge i and a point, positive inside. */
static int64_t edge(const corners* c, int i, int64_t x, int64_t y, int64_t turn) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  return turn * ((c->x[k] - c->x[j]) * (y - c->y[j]) - (c->y[k] - c->y[j]) * (x - c->x[j]));
}

/* Whether a sample on edge i is inside: it is on a left edge, or on a horizontal top edge. */
static int owns_ties(const corners* c, int i, int64_t turn) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const int64_t dx = turn * (c->x[k] - c->x[j]), dy = turn * (c->y[k] - c->y[j]);
  return dy < 0 || (dy == 0 && dx > 0);
}

static void draw_pixel(const image_triangle* t, const double weight[3], double* depth,
                       uint8_t* pixel) {
  double z = 0, sum = 0, w[3];
  int i, channel;
  for (i = 0; i < 3; ++i) {
    z += weight[i] * (t->vertex[i].position[2] / (double)t->vertex[i].position[3]);
    w[i] = weight[i];
    w[i] /= t->vertex[i].position[3]; /* perspective */
    sum += w[i];
  }
  if (!(z < *depth)) return;
  *depth = z;
  for (channel = 0; channel < 3; ++channel) {
    double color = 0;
    for (i = 0; i < 3; ++i) color += w[i] / sum * t->vertex[i].color[channel];
    pixel[channel] = (uint8_t)(color * 255 + 0.5);
  }
  pixel[3] = 255;
}

static void draw_triangle(const image_triangle* t, uint32_t width, uint32_t height, double* depths,
                          uint8_t* rgba) {
  corners c;
  int64_t area, turn, x, y;
  int i;
  for (i = 0; i < 3; ++i) {
    const float* p = t->vertex[i].position;
    const double w = p[3];
    c.x[i] = llrint((p[0] / w + 1) / 2 * width * GRID);
    c.y[i] = llrint((p[1] / w + 1) / 2 * height * GRID);
  }
  area = edge(&c, 0, c.x[0], c.y[0], 1);
  turn = area < 0 ? -1 : 1;
  for (y = 0; y < (int64_t)height && area != 0; ++y) {
    for (x = 0; x < (int64_t)width; ++x) {
      const size_t at = (size_t)y * width + (size_t)x;
      int is_inside = 1;
      double weight[3];
      for (i = 0; i < 3; ++i) {
        const int64_t e = edge(&c, i, x * GRID + GRID / 2, y * GRID + GRID / 2, turn);
        is_inside = is_inside && (e > 0 || (e == 0 && owns_ties(&c, i, turn)));
        weight[i] = (double)e / ((double)area * (double)turn);
      }
      if (is_inside) draw_pixel(t, weight, &depths[at], &rgba[4 * at]);
    }
  }
}

void draw_image(const image_triangle* triangles, uint32_t count, uint32_t width, uint32_t height,
                uint8_t* rgba) {
  const size_t pixels = (size_t)width * height;
  double* depths = (double*)malloc(pixels * sizeof(double));
  size_t i;
  if (depths == NULL) abort();
  for (i = 0; i < pixels; ++i) depths[i] = DBL_MAX;
  for (i = 0; i < count; ++i) draw_triangle(&triangles[i], width, height, depths, rgba);
  free(depths);
}
