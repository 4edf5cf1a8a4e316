#include "backends/upright_viewport.h"

namespace rastercheck::backends {
namespace {

/// Turns one axis of a viewport. Returns false if float32 cannot hold the position of its other
/// side.
bool turn(float& origin, float& size) {
  const double side = double{origin} + double{size};
  origin = static_cast<float>(side);
  size = -size;
  return double{origin} == side;
}

}  // namespace

std::optional<cases::Case> with_upright_viewport(const cases::Case& c, NegativeSizes taken) {
  const bool turns_x = c.viewport.width < 0;
  const bool turns_y = c.viewport.height < 0 && taken == NegativeSizes::none;
  if (!turns_x && !turns_y) return std::nullopt;
  cases::Case upright = c;
  cases::Viewport& viewport = upright.viewport;
  if (turns_x && !turn(viewport.x, viewport.width)) return std::nullopt;
  if (turns_y && !turn(viewport.y, viewport.height)) return std::nullopt;
  for (cases::ClipVertex& p : upright.positions) {
    if (turns_x) p.x = -p.x;
    if (turns_y) p.y = -p.y;
  }
  return upright;
}

}  // namespace rastercheck::backends
