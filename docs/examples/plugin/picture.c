/*
 * A little pipeline in C11, as a RasterCheck plugin: it draws pictures, with depth functions,
 * blending, two formats, resolving and textures. docs/judge-your-rasterizer.md tells how pictures
 * are judged.
 *
 * The second half of this file is the pipeline: what becomes of a fragment. The first half makes
 * the fragments, as little.c does but with fewer kinds of cases; little.c derives the bounds.
 * draw() hands the fragments over as they are, draw_picture() puts them through the pipeline. As
 * both have the same fragments, the contract promises pictures to the bit, but for one thing: texel
 * coordinates are attributes, which are rounded to float32.
 */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "rastercheck/plugin.h"

#define GRID 256          /* points per pixel and axis */
#define GUARD_BAND 32768. /* pixels; as contract.guard_band is where it is 0 */
#define MOST_DEPTH 65536. /* of z/w at vertices */
#define MOST_ATTRIBUTES 8

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 8,
    .rounding = RASTERCHECK_ROUNDING_NEAREST_EVEN,
    .position_error = 0x1p-27F,
    .clip_tolerance = 1,
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH,
    .smooth = {.constant = 0.5F + 0x1p-24F},
    .noperspective = {.constant = 0.5F + 0x1p-24F},
    .depth = {.constant = 0.5F + 0x1p-9F},
    .lacks = RASTERCHECK_LACKS_NONPOSITIVE_W | RASTERCHECK_LACKS_CLIP_DISTANCES |
             RASTERCHECK_LACKS_DEPTH_CLAMP | RASTERCHECK_LACKS_VIEWPORT_FRACTIONS |
             RASTERCHECK_LACKS_CENTER | RASTERCHECK_LACKS_CENTROID,
    .max_attributes = MOST_ATTRIBUTES,
    .pictures = RASTERCHECK_PICTURES_ROUNDED_COORDINATES,
};

/* ------------------------------------------------------------------------------------------------
 * Fragments
 */

/* A sample that a triangle covers, and what the triangle has there. */
typedef struct {
  uint32_t triangle;
  size_t sample; /* its place in arrays of the shape [height][width][samples] */
  float depth;
  float values[MOST_ATTRIBUTES];
} fragment;

/* What is done with a draw's fragments, which come triangle by triangle. */
typedef void take(void* target, const fragment* f);

/* A triangle in the window. Edge i lies opposite vertex i: E_i = a u + b v + c is positive inside,
 * an integer, and exact in double. */
typedef struct {
  uint32_t number, vertex[3];
  int64_t x[3], y[3]; /* snapped */
  int64_t a[3], b[3], c[3];
  double z[3], w[3];
} triangle;

static uint32_t refuse(char* message, uint32_t size, const char* why) {
  strncpy(message, why, size - 1);
  return RASTERCHECK_UNSUPPORTED;
}

static bool set_up(const rastercheck_draw* draw, uint32_t number, triangle* t) {
  const double width = draw->viewport_width, height = draw->viewport_height;
  const double sign_y = draw->rules == RASTERCHECK_RULES_D3D ? -0.5 : 0.5;
  t->number = number;
  for (int i = 0; i < 3; ++i) {
    t->vertex[i] = draw->indices[3 * (size_t)number + (size_t)i];
    const float* p = draw->positions + 4 * (size_t)t->vertex[i];
    const double x = p[0] / (double)p[3] * (width / 2) + (draw->viewport_x + width / 2);
    const double y = p[1] / (double)p[3] * (height * sign_y) + (draw->viewport_y + height / 2);
    t->z[i] = p[2];
    t->w[i] = p[3];
    if (!(fabs(x) <= GUARD_BAND && fabs(y) <= GUARD_BAND)) return false;
    if (!(fabs(t->z[i] / t->w[i]) <= MOST_DEPTH)) return false;
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

/* Whether a sample on an edge is inside. */
static bool owns(const rastercheck_draw* draw, int64_t a, int64_t b) {
  const bool is_top_left = draw->tie_rule == RASTERCHECK_TIE_RULE_TOP_LEFT;
  const bool is_y_down = draw->rules != RASTERCHECK_RULES_OPENGL;
  return a > 0 || (a == 0 && (is_top_left == is_y_down ? b > 0 : b < 0));
}

static bool is_between(int64_t u, double begin, double size) {
  const double pixels = (double)u / GRID, end = begin + size;
  return pixels >= fmin(begin, end) && pixels < fmax(begin, end);
}

/* Whether a sample is covered; e[i] is then the edge function i. */
static bool covers(const rastercheck_draw* draw, const triangle* t, int64_t u, int64_t v,
                   double e[3]) {
  double from_near = 0, from_far = 0;
  for (int i = 0; i < 3; ++i) {
    const int64_t at = edge(t, i, u, v);
    if (at < 0 || (at == 0 && !owns(draw, t->a[i], t->b[i]))) return false;
    e[i] = (double)at;
    const double weight = e[i] / t->w[i];
    from_near += (draw->rules == RASTERCHECK_RULES_OPENGL ? t->z[i] + t->w[i] : t->z[i]) * weight;
    from_far += (t->w[i] - t->z[i]) * weight;
  }
  return from_near >= 0 && from_far >= 0 && is_between(u, draw->viewport_x, draw->viewport_width) &&
         is_between(v, draw->viewport_y, draw->viewport_height);
}

static float depth_at(const rastercheck_draw* draw, const triangle* t, const double e[3]) {
  const double n = draw->min_depth, f = draw->max_depth;
  const double z[3] = {t->z[0] / t->w[0], t->z[1] / t->w[1], t->z[2] / t->w[2]};
  double depth = z[0] + ((z[1] - z[0]) * e[1] + (z[2] - z[0]) * e[2]) / (e[0] + e[1] + e[2]);
  if (draw->rules == RASTERCHECK_RULES_OPENGL) depth = (depth + 1) / 2;
  depth = n + (f - n) * depth;
  if (draw->rules == RASTERCHECK_RULES_D3D) depth = fmin(fmax(depth, fmin(n, f)), fmax(n, f));
  return (float)depth;
}

static float attribute_at(const rastercheck_draw* draw, const triangle* t, const double e[3],
                          uint32_t a) {
  const uint32_t interpolation = draw->attributes[a].interpolation;
  double sum = 0, weights = 0, r[3];
  for (int i = 0; i < 3; ++i) {
    r[i] = draw->attribute_values[(size_t)t->vertex[i] * draw->attribute_count + a];
    const double weight = interpolation == RASTERCHECK_SMOOTH ? e[i] / t->w[i] : e[i];
    sum += r[i] * weight;
    weights += weight;
  }
  if (interpolation != RASTERCHECK_FLAT) return (float)(sum / weights);
  return (float)r[draw->rules == RASTERCHECK_RULES_OPENGL ? 2 : 0];
}

static void draw_pixel(const rastercheck_draw* draw, const triangle* t, int64_t x, int64_t y,
                       take* done, void* target) {
  for (uint32_t s = 0; s < draw->samples; ++s) {
    const float* in_pixel = draw->sample_positions + 2 * s;
    const int64_t u = x * GRID + llrintf(in_pixel[0] * GRID);
    const int64_t v = y * GRID + llrintf(in_pixel[1] * GRID);
    double e[3];
    if (!covers(draw, t, u, v, e)) continue;
    fragment f = {.triangle = t->number, .depth = depth_at(draw, t, e)};
    f.sample = ((size_t)y * draw->width + (size_t)x) * draw->samples + s;
    for (uint32_t a = 0; a < draw->attribute_count; ++a) {
      f.values[a] = attribute_at(draw, t, e, a);
    }
    done(target, &f);
  }
}

static int64_t least(int64_t a, int64_t b) { return a < b ? a : b; }
static int64_t greatest(int64_t a, int64_t b) { return a > b ? a : b; }

/* Hands all fragments of a draw to `done`; null, or why it does not draw this. */
static const char* rasterize(const rastercheck_draw* draw, take* done, void* target) {
  if (!(fabs(draw->viewport_x + draw->viewport_width / 2.) <= GUARD_BAND &&
        fabs(draw->viewport_y + draw->viewport_height / 2.) <= GUARD_BAND)) {
    return "a viewport that is too far away";
  }
  for (uint32_t number = 0; number < draw->triangle_count; ++number) {
    triangle t;
    if (!set_up(draw, number, &t)) return "a vertex beyond the guard band, or z/w beyond 65536";
    if (!orient(draw, &t)) continue;
    /* Pixels that the triangle's box, the scissor and the framebuffer have in common. */
    const int64_t x_begin = least(t.x[0], least(t.x[1], t.x[2])) / GRID;
    const int64_t y_begin = least(t.y[0], least(t.y[1], t.y[2])) / GRID;
    const int64_t x_end = greatest(t.x[0], greatest(t.x[1], t.x[2])) / GRID + 1;
    const int64_t y_end = greatest(t.y[0], greatest(t.y[1], t.y[2])) / GRID + 1;
    const int64_t right = least(draw->width, (int64_t)draw->scissor_x + draw->scissor_width);
    const int64_t last = least(draw->height, (int64_t)draw->scissor_y + draw->scissor_height);
    for (int64_t y = greatest(greatest(0, draw->scissor_y), y_begin); y < least(last, y_end); ++y) {
      for (int64_t x = greatest(greatest(0, draw->scissor_x), x_begin); x < least(right, x_end);
           ++x) {
        draw_pixel(draw, &t, x, y, done, target);
      }
    }
  }
  return NULL;
}

typedef struct {
  const rastercheck_draw* draw;
  rastercheck_output* out;
} drawing;

static void hand_over(void* target, const fragment* f) {
  const rastercheck_draw* draw = ((const drawing*)target)->draw;
  rastercheck_output* out = ((const drawing*)target)->out;
  const float there = out->coverage[f->sample] ? out->depth[f->sample] : draw->depth_clear;
  if (draw->depth_test && !(f->depth < there)) return;
  out->coverage[f->sample] = 1;
  out->triangle[f->sample] = f->triangle;
  out->depth[f->sample] = f->depth;
  for (uint32_t a = 0; a < draw->attribute_count; ++a) {
    out->attributes[f->sample * draw->attribute_count + a] = f->values[a];
  }
}

static uint32_t draw_fragments(const rastercheck_draw* draw, rastercheck_output* out) {
  drawing target = {draw, out};
  const char* why = rasterize(draw, hand_over, &target);
  return why ? refuse(out->message, out->message_size, why) : RASTERCHECK_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Pictures
 */

typedef struct {
  const rastercheck_pipeline* pipeline;
  uint32_t attributes, channels;
  double* color; /* [sample][channel]: numbers of float32; of RGBA8, bytes from 0 to 255 */
  float* depth;  /* [sample] */
} framebuffer;

static bool passes(uint32_t function, float depth, float there) {
  switch (function) {
    case RASTERCHECK_COMPARE_ALWAYS:
      return true;
    case RASTERCHECK_COMPARE_LESS:
      return depth < there;
    case RASTERCHECK_COMPARE_EQUAL:
      return depth == there;
    case RASTERCHECK_COMPARE_LESS_OR_EQUAL:
      return depth <= there;
    case RASTERCHECK_COMPARE_GREATER:
      return depth > there;
    case RASTERCHECK_COMPARE_NOT_EQUAL:
      return depth != there;
    case RASTERCHECK_COMPARE_GREATER_OR_EQUAL:
      return depth >= there;
    default:
      return false;
  }
}

/* The column or row of the texel that a coordinate falls into. A float times the size is exact in
 * double, and so is fmod: nothing moves a coordinate over a texel's border. */
static size_t texel_index(uint32_t wrap, float coordinate, uint32_t size) {
  const double texel = floor((double)coordinate * size);
  if (wrap == RASTERCHECK_WRAP_CLAMP) return (size_t)fmin(fmax(texel, 0), size - 1.);
  const double period = wrap == RASTERCHECK_WRAP_MIRROR ? 2. * size : size;
  double i = fmod(texel, period);
  if (i < 0) i += period;
  return (size_t)(i < size ? i : period - 1 - i);
}

/* The fragment's colour; false if it is discarded. */
static bool shade(const framebuffer* b, const fragment* f, float color[MOST_ATTRIBUTES]) {
  const rastercheck_texture* texture = b->pipeline->texture;
  if (texture == NULL) {
    /* The alpha of three vertex colours is 1. */
    for (uint32_t c = 0; c < b->channels; ++c) color[c] = c < b->attributes ? f->values[c] : 1;
    return true;
  }
  const size_t column = texel_index(texture->wrap_s, f->values[0], texture->width);
  const size_t row = texel_index(texture->wrap_t, f->values[1], texture->height);
  const uint8_t* texel = texture->texels + 4 * (row * texture->width + column);
  for (int c = 0; c < 4; ++c) color[c] = (float)texel[c] / 255;
  return color[3] >= b->pipeline->discard_below;
}

static double clamped(double color) { return color > 0 ? fmin(color, 1) : 0; } /* NaN to 0 */

/* A number as the format keeps it. */
static double stored(const framebuffer* b, double number) {
  const bool is_float = b->pipeline->format == RASTERCHECK_COLOR_FLOAT32;
  return is_float ? (double)(float)number : fmin(nearbyint(number), 255); /* to nearest even */
}

/* Blends a colour over that of a sample. */
static void blend(framebuffer* b, size_t sample, const float color[MOST_ATTRIBUTES]) {
  const bool is_float = b->pipeline->format == RASTERCHECK_COLOR_FLOAT32;
  const double alpha = is_float ? color[3] : clamped(color[3]);
  for (uint32_t c = 0; c < b->channels; ++c) {
    double* there = &b->color[sample * b->channels + c];
    double number = is_float ? color[c] : 255 * clamped(color[c]);
    if (b->pipeline->blend == RASTERCHECK_BLEND_ADDITIVE) number += *there;
    if (b->pipeline->blend == RASTERCHECK_BLEND_OVER) {
      const double drawn = c == 3 ? number : alpha * number;
      number = drawn + (1 - alpha) * *there;
    }
    *there = stored(b, number);
  }
}

static void put_through_pipeline(void* target, const fragment* f) {
  framebuffer* b = target;
  float color[MOST_ATTRIBUTES] = {0};
  if (!passes(b->pipeline->depth_function, f->depth, b->depth[f->sample])) return;
  if (!shade(b, f, color)) return;
  if (b->pipeline->writes_depth) b->depth[f->sample] = f->depth;
  blend(b, f->sample, color);
}

/* Writes the picture. If it is resolved, each pixel is the mean of `samples` samples. */
static void write_picture(const framebuffer* b, size_t samples, rastercheck_picture* picture) {
  const size_t size = (size_t)picture->width * picture->height * picture->samples;
  const bool is_float = b->pipeline->format == RASTERCHECK_COLOR_FLOAT32;
  for (size_t i = 0; i < size; ++i) {
    picture->depth[i] = b->depth[i * samples];
    for (uint32_t c = 0; c < b->channels; ++c) {
      double sum = b->color[i * samples * b->channels + c];
      for (size_t s = 1; s < samples; ++s) sum += b->color[(i * samples + s) * b->channels + c];
      const float mean = (float)stored(b, sum / (double)samples);
      picture->color[i * b->channels + c] = is_float ? mean : mean / 255;
    }
  }
}

static uint32_t draw_picture(const rastercheck_draw* draw, const rastercheck_pipeline* pipeline,
                             rastercheck_picture* picture) {
  const size_t samples = (size_t)draw->width * draw->height * draw->samples;
  const char* why = NULL;
  if (pipeline->texture != NULL && pipeline->texture->filter != RASTERCHECK_FILTER_NEAREST) {
    why = "filtered textures";
  } else if (pipeline->texture == NULL && pipeline->shading >= RASTERCHECK_SHADING_DIFFERENCES_X) {
    why = "differences across quads, facing and window coordinates";
  }
  if (why) return refuse(picture->message, picture->message_size, why);
  framebuffer b = {pipeline, draw->attribute_count, picture->channels, NULL, NULL};
  b.color = calloc(samples * b.channels + 1, sizeof(double));
  b.depth = malloc(samples * sizeof(float));
  if (b.color != NULL && b.depth != NULL) {
    for (size_t i = 0; i < samples; ++i) b.depth[i] = pipeline->clear_depth;
    why = rasterize(draw, put_through_pipeline, &b);
    if (why == NULL) write_picture(&b, pipeline->resolves ? draw->samples : 1, picture);
  } else {
    why = "framebuffers that do not fit into memory";
  }
  free(b.color);
  free(b.depth);
  return why ? refuse(picture->message, picture->message_size, why) : RASTERCHECK_OK;
}

static const rastercheck_plugin plugin = {
    .size = sizeof(rastercheck_plugin),
    .abi = RASTERCHECK_PLUGIN_ABI,
    .name = "picture",
    .version = "1.0",
    .contract = &contract,
    .draw = draw_fragments,
    .draw_picture = draw_picture,
};

const rastercheck_plugin* rastercheck_plugin_get(void) { return &plugin; }
