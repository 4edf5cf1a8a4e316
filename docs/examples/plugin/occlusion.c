/*
 * A little occlusion culler in C11, as a RasterCheck plugin: a hierarchical depth buffer.
 * docs/judge-your-rasterizer.md tells how cullers are judged.
 *
 * Occluders go into a buffer with one depth for each sample and, above it, the greatest depth of
 * each tile of 4×4 pixels. The occludee is called occluded if it is nowhere nearer than the buffer;
 * most tiles tell that without a look at their samples.
 *
 * Rounding makes answers cautious, never wrong, as every number is a range that holds the exact one
 * (struct range). An occluder covers a sample only if it certainly does, and lies at the farthest
 * depth of its range; the occludee is wherever it may be, at the nearest depth. So the contract
 * promises the exact triangle, though nothing here is exact.
 *
 * Nothing is clipped. A triangle's edges are linear functions of the window position that come from
 * homogeneous coordinates, and vertices with w <= 0 are like others (Olano and Greer 1997); near
 * plane, far plane and clip distances are three more such functions.
 */
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "rastercheck/plugin.h"

#define TILE 4      /* pixels along a side */
#define STEPS 65535 /* depths are stored as 16-bit integers */

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_EXACT,
};

/* All numbers from lo to hi. */
typedef struct {
  double lo, hi;
} range;

/* An operation on doubles, rounded to nearest, has the exact result between its neighbours. */
static range wider(double lo, double hi) {
  return (range){nextafter(lo, -INFINITY), nextafter(hi, INFINITY)};
}
static range just(double number) { return (range){number, number}; }
static range sum(range a, range b) { return wider(a.lo + b.lo, a.hi + b.hi); }
static range difference(range a, range b) { return wider(a.lo - b.hi, a.hi - b.lo); }
static range product(range a, range b) {
  const double p[4] = {a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi};
  return wider(fmin(fmin(p[0], p[1]), fmin(p[2], p[3])), fmax(fmax(p[0], p[1]), fmax(p[2], p[3])));
}
/* b > 0 */
static range quotient(range a, range b) {
  return wider(a.lo / (a.lo < 0 ? b.lo : b.hi), a.hi / (a.hi < 0 ? b.hi : b.lo));
}
static range negative(range a) { return (range){-a.hi, -a.lo}; }

/* Some of the window: u and v in pixels. A sample is a point. */
typedef struct {
  range u, v;
} place;

/* What is known of a triangle. Edge i is E_i = a u + b v + c, and det its value at vertex i, times
 * w: Σ E_i w_i = det everywhere. Inside, all E_i and det are positive, by orient(). */
typedef struct {
  const rastercheck_draw* draw;
  const uint32_t* vertex;
  range a[3], b[3], c[3], det;
  bool is_certain; /* false if the sign of det is not: nothing is known then */
} triangle;

static const float* position(const triangle* t, int i) {
  return t->draw->positions + 4 * (size_t)t->vertex[i];
}

/* X, Y and w of a vertex: window coordinates times w. */
static void to_window(const triangle* t, int i, range p[3]) {
  const rastercheck_draw* draw = t->draw;
  const float* clip = position(t, i);
  const range w = just(clip[3]);
  const double half_width = draw->viewport_width / 2.0, half_height = draw->viewport_height / 2.0;
  const double y = draw->rules == RASTERCHECK_RULES_D3D ? -clip[1] : clip[1];
  p[0] = sum(product(just(clip[0]), just(half_width)),
             product(w, sum(just(draw->viewport_x), just(half_width))));
  p[1] = sum(product(just(y), just(half_height)),
             product(w, sum(just(draw->viewport_y), just(half_height))));
  p[2] = w;
}

/* Makes the edges positive inside; false if the triangle is certainly culled. */
static bool orient(triangle* t) {
  t->is_certain = t->det.lo > 0 || t->det.hi < 0;
  if (!t->is_certain) return true;
  const rastercheck_draw* draw = t->draw;
  const bool is_ccw = (t->det.lo > 0) == (draw->rules == RASTERCHECK_RULES_OPENGL); /* y up */
  const bool is_front = is_ccw == (draw->front_face == RASTERCHECK_FRONT_FACE_CCW);
  if (t->det.hi < 0) {
    t->det = negative(t->det);
    for (int i = 0; i < 3; ++i) {
      t->a[i] = negative(t->a[i]);
      t->b[i] = negative(t->b[i]);
      t->c[i] = negative(t->c[i]);
    }
  }
  return draw->cull != (is_front ? RASTERCHECK_CULL_FRONT : RASTERCHECK_CULL_BACK);
}

static bool set_up(const rastercheck_draw* draw, uint32_t number, triangle* t) {
  range p[3][3];
  t->draw = draw;
  t->vertex = draw->indices + 3 * (size_t)number;
  for (int i = 0; i < 3; ++i) to_window(t, i, p[i]);
  for (int i = 0; i < 3; ++i) {
    const range *j = p[(i + 1) % 3], *k = p[(i + 2) % 3];
    t->a[i] = difference(product(j[1], k[2]), product(j[2], k[1]));
    t->b[i] = difference(product(j[2], k[0]), product(j[0], k[2]));
    t->c[i] = difference(product(j[0], k[1]), product(j[1], k[0]));
  }
  t->det =
      sum(sum(product(t->a[0], p[0][0]), product(t->b[0], p[0][1])), product(t->c[0], p[0][2]));
  return orient(t);
}

static void edges_at(const triangle* t, place at, range e[3]) {
  for (int i = 0; i < 3; ++i) {
    e[i] = sum(sum(product(t->a[i], at.u), product(t->b[i], at.v)), t->c[i]);
  }
}

/* Σ n_i E_i: what has the values n_i / w_i at the vertices, times det. */
static range weighted(const range e[3], const range n[3]) {
  return sum(sum(product(n[0], e[0]), product(n[1], e[1])), product(n[2], e[2]));
}

/* At some place, a triangle covers all samples, may cover some, or covers none. */
typedef enum { NONE, SOME, ALL } cover;

static cover least(cover a, cover b) { return a < b ? a : b; }
static cover inside(range distance) {
  return distance.lo > 0 ? ALL : distance.hi >= 0 ? SOME : NONE;
}

/* Between two sides of the viewport, of which the nearer one belongs to it. */
static cover between(range u, double begin, double size) {
  const range end = sum(just(begin), just(size));
  const range lo = size > 0 ? just(begin) : end, hi = size > 0 ? end : just(begin);
  return least(inside(difference(u, lo)), inside(difference(hi, u)));
}

static cover planes(const triangle* t, const range e[3]) {
  const rastercheck_draw* draw = t->draw;
  const uint32_t distances = draw->clip_distance_count;
  range near_plane[3], far_plane[3], n[3];
  for (int i = 0; i < 3; ++i) {
    const range z = just(position(t, i)[2]), w = just(position(t, i)[3]);
    near_plane[i] = draw->rules == RASTERCHECK_RULES_OPENGL ? sum(z, w) : z;
    far_plane[i] = difference(w, z);
  }
  cover covers = ALL;
  if (!draw->depth_clamp) {
    covers = least(covers, inside(weighted(e, near_plane)));
    covers = least(covers, inside(weighted(e, far_plane)));
  }
  for (uint32_t d = 0; d < distances; ++d) {
    for (int i = 0; i < 3; ++i) {
      n[i] = just(draw->clip_distances[(size_t)t->vertex[i] * distances + d]);
    }
    covers = least(covers, inside(weighted(e, n)));
  }
  return covers;
}

static cover covers_at(const triangle* t, place at, const range e[3]) {
  const rastercheck_draw* draw = t->draw;
  const cover in_viewport = least(between(at.u, draw->viewport_x, draw->viewport_width),
                                  between(at.v, draw->viewport_y, draw->viewport_height));
  if (!t->is_certain) return least(in_viewport, SOME);
  const cover in_edges = least(least(inside(e[0]), inside(e[1])), inside(e[2]));
  return in_edges == NONE ? NONE : least(least(in_viewport, in_edges), planes(t, e));
}

/* The depth, in steps of the buffer, wherever the triangle may cover the place. */
static range depth_at(const triangle* t, const range e[3]) {
  const rastercheck_draw* draw = t->draw;
  const double n = draw->min_depth, f = draw->max_depth, least_depth = fmin(n, f);
  range z[3], depth = {0, STEPS};
  if (!t->is_certain) return depth;
  for (int i = 0; i < 3; ++i) z[i] = just(position(t, i)[2]);
  depth = quotient(weighted(e, z), t->det);
  if (draw->rules == RASTERCHECK_RULES_OPENGL) depth = product(sum(depth, just(1)), just(0.5));
  depth = sum(just(n), product(difference(just(f), just(n)), depth));
  /* What is not clamped was clipped. */
  depth.lo = fmin(fmax(depth.lo, least_depth), fmax(n, f));
  depth.hi = fmin(fmax(depth.hi, least_depth), fmax(n, f));
  return product(depth, just(STEPS));
}

static uint16_t away(range steps) { return (uint16_t)fmin(ceil(steps.hi), STEPS); }
static uint16_t towards(range steps) { return (uint16_t)fmax(floor(steps.lo), 0); }

typedef struct {
  const rastercheck_draw* draw;
  uint32_t across, down; /* tiles */
  uint16_t* depth;       /* [row][column][sample] */
  uint16_t* farthest;    /* [tile]: the greatest depth of its samples */
} buffer;

/* Pixels of a tile, within the framebuffer. */
typedef struct {
  uint32_t x0, y0, x1, y1;
} box;

static uint32_t smaller(uint32_t a, uint32_t b) { return a < b ? a : b; }

static box box_of(const buffer* b, uint32_t tile) {
  const uint32_t x = tile % b->across * TILE, y = tile / b->across * TILE;
  return (box){x, y, smaller(x + TILE, b->draw->width), smaller(y + TILE, b->draw->height)};
}

static place place_of(box pixels) {
  return (place){{pixels.x0, pixels.x1}, {pixels.y0, pixels.y1}};
}

static bool is_in_scissor(const rastercheck_draw* draw, uint32_t x, uint32_t y) {
  return (int64_t)x >= draw->scissor_x && (int64_t)y >= draw->scissor_y &&
         (int64_t)x < (int64_t)draw->scissor_x + draw->scissor_width &&
         (int64_t)y < (int64_t)draw->scissor_y + draw->scissor_height;
}

static bool is_whole_in_scissor(const rastercheck_draw* draw, box b) {
  return is_in_scissor(draw, b.x0, b.y0) && is_in_scissor(draw, b.x1 - 1, b.y1 - 1);
}

/* What is done at a sample that may be covered; false ends the walk. */
typedef bool visit(uint16_t* stored, cover covers, range steps);

static bool each_sample(buffer* b, const triangle* t, box pixels, visit* take) {
  for (uint32_t y = pixels.y0; y < pixels.y1; ++y) {
    for (uint32_t x = pixels.x0; x < pixels.x1; ++x) {
      if (!is_in_scissor(b->draw, x, y)) continue;
      for (uint32_t s = 0; s < b->draw->samples; ++s) {
        const float* in_pixel = b->draw->sample_positions + 2 * s;
        const place at = {just(x + (double)in_pixel[0]), just(y + (double)in_pixel[1])};
        range e[3];
        edges_at(t, at, e);
        const cover covers = covers_at(t, at, e);
        if (covers == NONE) continue;
        uint16_t* stored = b->depth + ((size_t)y * b->draw->width + x) * b->draw->samples + s;
        if (!take(stored, covers, depth_at(t, e))) return false;
      }
    }
  }
  return true;
}

/* Calls `take(pixels, tile, covers, steps)`, with ranges over all of a tile, for tiles that the
 * triangle may cover a sample of. */
typedef bool visit_tile(buffer* b, const triangle* t, uint32_t tile, cover covers, range steps);

static bool each_tile(buffer* b, const triangle* t, visit_tile* take) {
  for (uint32_t tile = 0; tile < b->across * b->down; ++tile) {
    const box pixels = box_of(b, tile);
    range e[3];
    edges_at(t, place_of(pixels), e);
    const cover covers = covers_at(t, place_of(pixels), e);
    if (covers != NONE && !take(b, t, tile, covers, depth_at(t, e))) return false;
  }
  return true;
}

static bool hide_sample(uint16_t* stored, cover covers, range steps) {
  if (covers == ALL && away(steps) < *stored) *stored = away(steps);
  return true;
}

static bool hide_tile(buffer* b, const triangle* t, uint32_t tile, cover covers, range steps) {
  const box pixels = box_of(b, tile);
  const size_t row = (size_t)b->draw->width * b->draw->samples;
  if (towards(steps) >= b->farthest[tile]) return true; /* behind all of it */
  if (covers == ALL && is_whole_in_scissor(b->draw, pixels)) {
    for (uint32_t y = pixels.y0; y < pixels.y1; ++y) {
      for (uint32_t i = pixels.x0 * b->draw->samples; i < pixels.x1 * b->draw->samples; ++i) {
        hide_sample(&b->depth[y * row + i], ALL, steps);
      }
    }
  } else {
    each_sample(b, t, pixels, hide_sample);
  }
  uint16_t farthest = 0;
  for (uint32_t y = pixels.y0; y < pixels.y1; ++y) {
    for (uint32_t i = pixels.x0 * b->draw->samples; i < pixels.x1 * b->draw->samples; ++i) {
      if (b->depth[y * row + i] > farthest) farthest = b->depth[y * row + i];
    }
  }
  b->farthest[tile] = farthest;
  return true;
}

/* True as long as nothing is visible. */
static bool is_hidden_sample(uint16_t* stored, cover covers, range steps) {
  (void)covers;
  return towards(steps) >= *stored;
}

static bool is_hidden_tile(buffer* b, const triangle* t, uint32_t tile, cover covers, range steps) {
  (void)covers;
  if (towards(steps) >= b->farthest[tile]) return true;
  return each_sample(b, t, box_of(b, tile), is_hidden_sample);
}

static uint32_t answer_query(const rastercheck_query* query, rastercheck_answer* answer) {
  const rastercheck_draw* draw = query->occludee;
  buffer b = {draw, (draw->width + TILE - 1) / TILE, (draw->height + TILE - 1) / TILE, NULL, NULL};
  const size_t samples = (size_t)draw->width * draw->height * draw->samples;
  const size_t tiles = (size_t)b.across * b.down;
  b.depth = malloc((samples + tiles) * sizeof(uint16_t));
  if (b.depth == NULL) {
    strncpy(answer->message, "no memory for the depth buffer", answer->message_size - 1);
    return RASTERCHECK_FAILED;
  }
  b.farthest = b.depth + samples;
  const uint16_t clear = away(product(just(draw->depth_clear), just(STEPS)));
  for (size_t i = 0; i < samples + tiles; ++i) b.depth[i] = clear;

  triangle t;
  for (uint32_t i = 0; i < query->occluders->triangle_count; ++i) {
    if (set_up(query->occluders, i, &t) && t.is_certain) each_tile(&b, &t, hide_tile);
  }
  bool is_hidden = true;
  for (uint32_t i = 0; i < draw->triangle_count && is_hidden; ++i) {
    is_hidden = !set_up(draw, i, &t) || each_tile(&b, &t, is_hidden_tile);
  }
  free(b.depth);
  answer->visibility = is_hidden ? RASTERCHECK_OCCLUDED : RASTERCHECK_VISIBLE;
  return RASTERCHECK_OK;
}

static uint32_t draw_nothing(const rastercheck_draw* draw, rastercheck_output* out) {
  (void)draw;
  strncpy(out->message, "an occlusion culler draws nothing", out->message_size - 1);
  return RASTERCHECK_UNSUPPORTED;
}

static const rastercheck_plugin plugin = {
    .size = sizeof(rastercheck_plugin),
    .abi = RASTERCHECK_PLUGIN_ABI,
    .name = "occlusion",
    .version = "1.0",
    .contract = &contract,
    .draw = draw_nothing,
    .query = answer_query,
};

const rastercheck_plugin* rastercheck_plugin_get(void) { return &plugin; }
