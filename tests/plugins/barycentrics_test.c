/*
 * Tests rastercheck/barycentrics.h as a plugin uses it. Compiled as C99 and as C++. All expected
 * values are calculated by hand; they are multiples of powers of 2, so that doubles hold them.
 *
 * The triangle has window corners (0, 0), (8, 0) and (0, 8), w 1, 2 and 4, and z/w 0, 1/2 and 1. At
 * (2, 4) its screen barycentrics are 1/4, 1/4 and 1/2. Divided by w, these are 1/4, 1/8 and 1/8,
 * whose sum 1/2 is 1/w there; so the perspective barycentrics are 1/2, 1/4 and 1/4.
 */
#include "rastercheck/barycentrics.h"

#include <stdio.h>
#include <string.h>

static int failures = 0;

#define CHECK(is_right)                                                  \
  do {                                                                   \
    if (!(is_right)) {                                                   \
      fprintf(stderr, "%s:%d: not %s\n", __FILE__, __LINE__, #is_right); \
      ++failures;                                                        \
    }                                                                    \
  } while (0)

static int is_equal(const double a[3], double a0, double a1, double a2) {
  return a[0] == a0 && a[1] == a1 && a[2] == a2;
}

static float positions[] = {-1, -1, 0, 1, 2, -2, 1, 2, -4, 4, 4, 4};
static const rastercheck_attribute attributes[] = {
    {RASTERCHECK_SMOOTH, 0}, {RASTERCHECK_NOPERSPECTIVE, 0}, {RASTERCHECK_FLAT, 0}};
static const float values[] = {0, 0, 5, 8, 8, 6, 16, 16, 7};
static const uint32_t indices[] = {0, 1, 2};

static rastercheck_draw a_draw(uint32_t rules) {
  rastercheck_draw draw;
  memset(&draw, 0, sizeof(draw));
  draw.size = sizeof(draw);
  draw.rules = rules;
  draw.width = draw.height = 8;
  draw.samples = 4;
  draw.viewport_width = draw.viewport_height = 8;
  draw.max_depth = 1;
  draw.vertex_count = 3;
  draw.positions = positions;
  draw.attribute_count = 3;
  draw.attributes = attributes;
  draw.attribute_values = values;
  draw.triangle_count = 1;
  draw.indices = indices;
  return draw;
}

static void window_positions(void) {
  const rastercheck_draw vulkan = a_draw(RASTERCHECK_RULES_VULKAN);
  const rastercheck_draw d3d = a_draw(RASTERCHECK_RULES_D3D);
  const rastercheck_draw opengl = a_draw(RASTERCHECK_RULES_OPENGL);
  rastercheck_window_position at = rastercheck_to_window(&vulkan, 0, 1);
  CHECK(at.x == 8 && at.y == 0 && at.depth == 0.5 && at.inverse_w == 0.5);
  at = rastercheck_to_window(&d3d, 0, 1);
  CHECK(at.x == 8 && at.y == 8 && at.depth == 0.5);
  at = rastercheck_to_window(&opengl, 0, 1);
  CHECK(at.x == 8 && at.y == 0 && at.depth == 0.75);
}

static void weights(void) {
  const rastercheck_draw draw = a_draw(RASTERCHECK_RULES_VULKAN);
  rastercheck_window_position corner[3];
  double s[3], b[3], back[3], zero[3] = {1, -1, 0};
  int i;
  for (i = 0; i < 3; ++i) corner[i] = rastercheck_to_window(&draw, 0, i);
  CHECK(rastercheck_screen_barycentrics(corner, 2, 4, s) && is_equal(s, 0.25, 0.25, 0.5));
  CHECK(rastercheck_perspective_from_screen(&draw, 0, s, b) && is_equal(b, 0.5, 0.25, 0.25));
  CHECK(rastercheck_screen_from_perspective(&draw, 0, b, back) && is_equal(back, 0.25, 0.25, 0.5));
  CHECK(!rastercheck_normalize(zero) && is_equal(zero, 1, -1, 0));
  corner[2] = corner[1];
  CHECK(!rastercheck_screen_barycentrics(corner, 2, 4, s));
}

static void attributes_and_depth(void) {
  const double b[3] = {0.5, 0.25, 0.25}, s[3] = {0.25, 0.25, 0.5}, odd[3] = {0.1, 0.3, 0.7};
  const double equal[3] = {0.1, 0.1, 0.1};
  rastercheck_draw draw = a_draw(RASTERCHECK_RULES_VULKAN);
  CHECK(rastercheck_attribute_at(&draw, 0, 0, b) == 6);  /* 8/4 + 16/4 */
  CHECK(rastercheck_attribute_at(&draw, 0, 1, b) == 10); /* 8/4 + 16/2 */
  CHECK(rastercheck_attribute_at(&draw, 0, 2, b) == 5);
  CHECK(rastercheck_mean(equal, odd) == 0.1);
  CHECK(rastercheck_depth_from_screen(&draw, 0, s) == 0.625F); /* 1/4 · 1/2 + 1/2 · 1 */
  draw.min_depth = 0.25F;
  draw.max_depth = 0.75F;
  CHECK(rastercheck_depth_from_screen(&draw, 0, s) == 0.5625F);
  draw = a_draw(RASTERCHECK_RULES_OPENGL);
  CHECK(rastercheck_attribute_at(&draw, 0, 2, b) == 7);
  CHECK(rastercheck_depth_from_screen(&draw, 0, s) == 0.8125F);
}

static void clamped_depths(void) {
  rastercheck_draw draw = a_draw(RASTERCHECK_RULES_VULKAN);
  CHECK(rastercheck_clamped_depth(&draw, 1.125) == 1.125F);
  draw.depth_clamp = 1;
  CHECK(rastercheck_clamped_depth(&draw, 1.125) == 1);
  draw = a_draw(RASTERCHECK_RULES_D3D);
  draw.min_depth = 0.75F; /* the range may begin at its greater end */
  draw.max_depth = 0.25F;
  CHECK(rastercheck_clamped_depth(&draw, 1) == 0.75F);
  CHECK(rastercheck_clamped_depth(&draw, 0) == 0.25F);
}

/* Planes at 1 and 2: a = 2 and b = -2, for OpenGL 3 and -4. At 1/w = 3/4 both give depth 1/2. */
static void other_depth_buffers(void) {
  rastercheck_draw draw = a_draw(RASTERCHECK_RULES_VULKAN);
  CHECK(rastercheck_depth_from_inverse_w(&draw, 0.75, 2, -2) == 0.5F);
  CHECK(rastercheck_depth_from_w(&draw, 1, 2, -2) == 0);
  CHECK(rastercheck_depth_from_w(&draw, 2, 2, -2) == 1);
  CHECK(!rastercheck_has_projection(&draw, 2, -2, 1e-6));
  positions[6] = 2; /* z = 2 w - 2 */
  positions[10] = 6;
  CHECK(rastercheck_has_projection(&draw, 2, -2, 0));
  positions[6] = 1;
  positions[10] = 4;
  CHECK(rastercheck_reversed_z(&draw, positions + 4) == 1); /* w - z */
  draw.min_depth = 0.25F;
  CHECK(rastercheck_reversed_depth(&draw, 0.5) == 0.75);
  draw = a_draw(RASTERCHECK_RULES_OPENGL);
  CHECK(rastercheck_depth_from_inverse_w(&draw, 0.75, 3, -4) == 0.5F);
  CHECK(rastercheck_reversed_z(&draw, positions + 4) == -1);
}

static void places(void) {
  rastercheck_draw draw = a_draw(RASTERCHECK_RULES_VULKAN);
  double moved[4];
  CHECK(rastercheck_index(&draw, 3, 2, 1) == 77); /* (2 · 8 + 3) · 4 + 1 */
  CHECK(rastercheck_row(&draw, 0) == 7);
  rastercheck_move(&draw, -0.5, -0.5, positions + 4, moved); /* half a pixel is 1/8 of NDC */
  CHECK(moved[0] == 1.75 && moved[1] == -2.25 && moved[2] == 1 && moved[3] == 2);
  draw = a_draw(RASTERCHECK_RULES_D3D);
  rastercheck_move(&draw, -0.5, -0.5, positions + 4, moved);
  CHECK(moved[0] == 1.75 && moved[1] == -1.75);
}

static void a_covered_sample(void) {
  const rastercheck_draw draw = a_draw(RASTERCHECK_RULES_VULKAN);
  const double b[3] = {0.5, 0.25, 0.25};
  uint8_t coverage[2] = {0, 0};
  uint32_t triangle[2] = {9, 9};
  float depth[2] = {9, 9}, drawn[6] = {9, 9, 9, 9, 9, 9};
  rastercheck_output output;
  memset(&output, 0, sizeof(output));
  output.coverage = coverage;
  output.triangle = triangle;
  output.depth = depth;
  output.attributes = drawn;
  rastercheck_cover(&draw, &output, 1, 0, b);
  CHECK(coverage[0] == 0 && triangle[0] == 9 && depth[0] == 9 && drawn[2] == 9);
  CHECK(coverage[1] == 1 && triangle[1] == 0 && depth[1] == 0.625F);
  CHECK(drawn[3] == 6 && drawn[4] == 10 && drawn[5] == 5);
}

int main(void) {
  window_positions();
  weights();
  attributes_and_depth();
  clamped_depths();
  other_depth_buffers();
  places();
  a_covered_sample();
  return failures == 0 ? 0 : 1;
}
