/*
 * Clips every triangle at all six planes of the view volume (Sutherland and Hodgman 1974), in
 * double, then rounds the polygon's corners to a grid of 1/256 pixel and draws it as a fan.
 *
 * The sides are moved outwards to a point of the grid, by more than one unit, so that corners stay
 * on the sides and no sample lies on them. Samples are tested against the viewport itself. Clipping
 * leaves no w < 0, so vertices behind the eye need no other treatment. Refuses triangles with
 * corners so near the eye that few of their digits are right (is_exact_enough()).
 */
#include "common.h"

#define MOST_ATTRIBUTES 8
#define MOST_CORNERS 28 /* a convex polygon has 9; a plane adds half at most to any other */

static const rastercheck_contract contract = {
    .size = sizeof(rastercheck_contract),
    .coverage = RASTERCHECK_COVERAGE_SNAPPED,
    .subpixel_bits = 8,
    .rounding = RASTERCHECK_ROUNDING_NEAREST_EVEN,
    .position_error = 0x1p-7F, /* see is_exact_enough() */
    .clip_tolerance = 0.5F,    /* new corners are rounded to the grid */
    .clips = RASTERCHECK_CLIPS_BEYOND_VIEWPORT,
    .basis = RASTERCHECK_BASIS_SNAPPED,
    .keeps = RASTERCHECK_KEEPS_CONSTANTS,
    .smooth = {.constant = 0.5F + 0x1p-6F}, /* see is_exact_enough() */
    .depth = {.constant = 0.5F + 0x1p-5F},
    .lacks = RASTERCHECK_LACKS_D3D | RASTERCHECK_LACKS_CLIP_DISTANCES |
             RASTERCHECK_LACKS_NOPERSPECTIVE | RASTERCHECK_LACKS_CENTER |
             RASTERCHECK_LACKS_CENTROID,
    .sample_counts = 1 | 4,
    .max_attributes = MOST_ATTRIBUTES,
};

/* Numbers of a corner, all linear in clip space: x and y in pixels times w, z, w, attributes. */
enum { X, Y, Z, W, R, NUMBERS = R + MOST_ATTRIBUTES };

typedef struct {
  double at[MOST_CORNERS][NUMBERS];
  int count;
} polygon;

/* Triangle k of the fan has corners 0, k + 1 and k + 2. `area` is twice the area of all. */
typedef struct {
  polygon corners;
  triangle pieces[MOST_CORNERS];
  uint32_t number, provoking;
  double area;
} fan;

static double distance(const double plane[4], const double* p) {
  return plane[X] * p[X] + plane[Y] * p[Y] + plane[Z] * p[Z] + plane[W] * p[W];
}

/* Appends the point of an edge at a plane, from the end that is inside. */
static void cut(polygon* p, const double* inside, const double* outside, double t) {
  double* c = p->at[p->count++];
  for (int i = 0; i < NUMBERS; ++i) c[i] = inside[i] + t * (outside[i] - inside[i]);
}

/* Clips at one plane; false if rounding may decide whether a corner is lost (is_exact_enough()). */
static bool clip(polygon* p, const double plane[4], double size) {
  const polygon all = *p;
  p->count = 0;
  for (int i = 0; i < all.count; ++i) {
    const double *from = all.at[i], *to = all.at[(i + 1) % all.count];
    const double a = distance(plane, from), b = distance(plane, to);
    if (a < 0 && a > -0x1p-46 * size) return false;
    if (a >= 0) memcpy(p->at[p->count++], from, sizeof(all.at[i]));
    if (a >= 0 && b < 0) cut(p, from, to, a / (a - b));
    if (a < 0 && b >= 0) cut(p, to, from, b / (b - a));
  }
  return true;
}

/* True if rounding errors are within the contract. Clipping at one plane changes a number by about
 * 8 u of the vertices' greatest number, `size`; clipping at six planes, by less than 2^6 u = 2^-47.
 * Let w be that of a corner. If pixels times w are at most 2^32 w, a position is off by 2^-15
 * pixels, which is 2^-7 grid units. If z and w are at most 2^16 w, the weight 1/w has a relative
 * error of 2^-31. A mean is then off by twice that share of the greatest value, 2^-6 of a float32
 * step, and z/w by 2^-30, 2^-6 of a step of depth. */
static bool is_exact_enough(const polygon* p, const double size[2]) {
  for (int i = 0; i < p->count; ++i) {
    const double w = p->at[i][W];
    if (!(size[0] <= 0x1p32 * w && size[1] <= 0x1p16 * w)) return false;
  }
  return true;
}

/* Clips a triangle; false if it must be refused. */
static bool to_polygon(const rastercheck_draw* draw, const uint32_t* vertices,
                       const double planes[6][4], polygon* p) {
  const double width = draw->viewport_width, height = draw->viewport_height;
  const double middle[4] = {draw->viewport_x + width / 2, draw->viewport_y + height / 2, 0, 0};
  const double scale[4] = {width / 2, height / 2, 1, 1};
  double size[2] = {0, 0}; /* the greatest pixels times w, and z and w */
  p->count = 3;
  for (int i = 0; i < 3; ++i) {
    const float* at = draw->positions + 4 * (size_t)vertices[i];
    for (int k = 0; k < 4; ++k) {
      p->at[i][k] = at[k] * scale[k] + at[W] * middle[k];
      const double border = k < Z ? GUARD_BAND * fabs((double)at[W]) : 0;
      size[k / 2] = fmax(size[k / 2], fabs(at[k] * scale[k]) + border);
    }
    for (size_t a = 0; a < draw->attribute_count; ++a) {
      p->at[i][R + a] = draw->attribute_values[vertices[i] * draw->attribute_count + a];
    }
  }
  for (int i = 0; i < (draw->depth_clamp ? 4 : 6) && p->count > 0; ++i) {
    if (!clip(p, planes[i], size[i / 4])) return false;
  }
  return is_exact_enough(p, size);
}

/* Makes triangles of the snapped corners. If rounding reverses a triangle, the triangle is thin and
 * is not drawn. */
static void set_up_fan(fan* f) {
  for (int k = 0; k + 2 < f->corners.count; ++k) {
    triangle* t = &f->pieces[k];
    for (int i = 0; i < 3; ++i) {
      const double* c = f->corners.at[i == 0 ? 0 : k + i];
      t->w[i] = c[W];
      t->x[i] = c[X] / c[W];
      t->y[i] = c[Y] / c[W];
      t->depth[i] = c[Z] / c[W];
    }
    snap(t, 256, rint);
    f->area += t->area;
  }
}

static void visit(const rastercheck_draw* draw, rastercheck_output* out, const void* shape,
                  place at) {
  const fan* f = shape;
  const size_t count = draw->attribute_count;
  for (int k = 0; k + 2 < f->corners.count; ++k) {
    const triangle* t = &f->pieces[k];
    double e[3];
    edges_at(t, at, e);
    if (t->area * f->area <= 0 || !covers(draw, t, e)) continue;
    if (!keep(draw, out, at.index, f->number, depth_at(draw, t->depth, e))) return;
    for (int i = 0; i < 3; ++i) e[i] /= t->w[i];
    for (size_t a = 0; a < count; ++a) {
      const double(*c)[NUMBERS] = f->corners.at;
      const double r[3] = {c[0][R + a], c[k + 1][R + a], c[k + 2][R + a]};
      const bool is_flat = draw->attributes[a].interpolation == RASTERCHECK_FLAT;
      out->attributes[at.index * count + a] =
          is_flat ? draw->attribute_values[f->provoking * count + a] : (float)mean_of(r, e);
    }
    return;
  }
}

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  const double x[2] = {draw->viewport_x, (double)draw->viewport_x + draw->viewport_width};
  const double y[2] = {draw->viewport_y, (double)draw->viewport_y + draw->viewport_height};
  const double low[2] = {floor(fmin(x[0], x[1]) * 256 - 1) / 256,
                         floor(fmin(y[0], y[1]) * 256 - 1) / 256};
  const double high[2] = {ceil(fmax(x[0], x[1]) * 256 + 1) / 256,
                          ceil(fmax(y[0], y[1]) * 256 + 1) / 256};
  const bool is_opengl = draw->rules == RASTERCHECK_RULES_OPENGL;
  const double planes[6][4] = {{1, 0, 0, -low[0]},  {0, 1, 0, -low[1]},   {-1, 0, 0, high[0]},
                               {0, -1, 0, high[1]}, {0, 0, 1, is_opengl}, {0, 0, -1, 1}};
  if (!is_viewport_usable(draw)) return refuse(out, "a viewport too far away or too fine");
  for (uint32_t number = 0; number < draw->triangle_count; ++number) {
    const uint32_t* vertices = draw->indices + 3 * (size_t)number;
    fan f = {.number = number, .provoking = vertices[is_opengl ? 2 : 0]};
    if (!to_polygon(draw, vertices, planes, &f.corners)) return refuse(out, "near the eye");
    set_up_fan(&f);
    if (is_kept(draw, f.area)) each_sample(draw, out, low, high, visit, &f);
  }
  return RASTERCHECK_OK;
}

TYPICAL_PLUGIN("clipped at the viewport", contract, draw_all)
