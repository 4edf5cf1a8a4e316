/*
 * Lets a C++ exception leave draw(), which is called from C.
 *
 * RasterCheck: “draw() threw an exception: vector::_M_range_check”
 */
#define rastercheck_plugin_get little_get
#include "../little.cpp"
#undef rastercheck_plugin_get

extern "C" RASTERCHECK_PLUGIN_EXPORT const rastercheck_plugin* rastercheck_plugin_get(void);

static uint32_t draw_beyond(const rastercheck_draw* draw, rastercheck_output* output) {
  const std::vector<int> few(1);
  if (few.at(draw->width) > 0) return RASTERCHECK_FAILED;
  return little_get()->draw(draw, output);
}

const rastercheck_plugin* rastercheck_plugin_get(void) {
  static rastercheck_plugin throwing = *little_get();
  throwing.draw = &draw_beyond;
  return &throwing;
}
