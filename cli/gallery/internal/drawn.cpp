#include "cli/gallery/internal/drawn.h"

#include <memory>
#include <utility>

#include "backends/backend.h"
#include "oracle/transform.h"
#include "properties/drawing.h"

namespace rastercheck::gallery {

Result<Drawn> draw_by(std::string_view method, const cases::Case& scene) {
  Result<cases::Case> clip = oracle::to_clip_case(scene, scene.name);
  if (!clip) return tl::unexpected(clip.error());
  Drawn drawn;
  drawn.method = method;
  drawn.scene = *std::move(clip);
  const std::string specification(method == kLinearPolygon ? "method:screen-linear" : method);
  const auto backend = backends::make_backend(specification);
  if (!backend) {
    drawn.missing = specification + " is not in this version";
    return drawn;
  }
  drawn.contract = (*backend)->contract(drawn.scene);
  Result<cases::Framebuffer> fragments = properties::draw(drawn.scene, **backend);
  if (!fragments) return tl::unexpected(fragments.error());
  drawn.fragments = *std::move(fragments);
  return drawn;
}

}  // namespace rastercheck::gallery
