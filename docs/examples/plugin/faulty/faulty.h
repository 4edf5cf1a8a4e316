/*
 * little.c without its rastercheck_plugin_get(). Each file here includes this header and defines
 * that function for a plugin with one fault. The comment at its top quotes RasterCheck's message:
 *
 *     rastercheck run --backend plugin:./crash.so --property 'coverage*' --seed 1
 */
#define rastercheck_plugin_get little_get
#include "../little.c"
#undef rastercheck_plugin_get

RASTERCHECK_PLUGIN_EXPORT const rastercheck_plugin* rastercheck_plugin_get(void);

/* Returns the plugin with another draw function. */
static inline const rastercheck_plugin* little_with_draw(
    uint32_t (*other)(const rastercheck_draw* draw, rastercheck_output* out)) {
  static rastercheck_plugin faulty;
  faulty = *little_get();
  faulty.draw = other;
  return &faulty;
}

/* Returns the plugin with another contract. */
static inline const rastercheck_plugin* little_with_contract(const rastercheck_contract* other) {
  static rastercheck_plugin faulty;
  faulty = *little_get();
  faulty.contract = other;
  return &faulty;
}

/* True if some vertices are farther apart than half the viewport's width. Most real faults also
 * concern only some draws. */
static inline bool is_wide(const rastercheck_draw* draw) {
  float low = INFINITY, high = -INFINITY;
  for (uint32_t i = 0; i < 3 * draw->triangle_count; ++i) {
    const float* p = draw->positions + 4 * (size_t)draw->indices[i];
    low = fminf(low, p[0] / p[3]);
    high = fmaxf(high, p[0] / p[3]);
  }
  return high - low > 1;
}

/* The number of samples in the framebuffer. */
static inline size_t sample_count(const rastercheck_draw* draw) {
  return (size_t)draw->width * draw->height * draw->samples;
}
