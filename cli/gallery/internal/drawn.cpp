#include "cli/gallery/internal/drawn.h"

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"
#include "oracle/transform.h"
#include "oracle/triangle_truth.h"
#include "properties/drawing.h"
#include "rasterizer/methods/polygon.h"

namespace rastercheck::gallery {

namespace {

namespace ras = rasterizer;

constexpr std::string_view kPolygonMethod = "scanline-linear";
constexpr std::string_view kCoverageOfPolygons = "method:rational-linear";

ras::State state_of(const cases::Case& scene) {
  ras::State state;
  state.viewport = {{scene.viewport.x, scene.viewport.y},
                    {scene.viewport.width, scene.viewport.height},
                    scene.viewport.min_depth,
                    scene.viewport.max_depth};
  state.attributes.resize(scene.attributes.size());
  return state;
}

std::vector<ras::PolygonVertex> polygon_of(const cases::Case& scene) {
  std::vector<ras::PolygonVertex> polygon;
  for (std::size_t i = 0; i < scene.positions.size(); ++i) {
    const cases::ClipVertex& p = scene.positions[i];
    const std::span<const float> values = scene.attributes_of(i);
    polygon.push_back({{p.x, p.y, p.z, p.w}, {values.begin(), values.end()}});
  }
  return polygon;
}

/// Draws the quad's fragments; each goes to the triangle in which it lies.
Result<cases::Fragments> draw_quad(const cases::Case& quad) {
  ras::Fragments drawn;
  const std::optional<ras::PolygonFault> fault = ras::draw_polygon(
      kPolygonMethod, state_of(quad), polygon_of(quad),
      {quad.framebuffer.width, quad.framebuffer.height, quad.framebuffer.samples}, drawn);
  if (fault) {
    return tl::unexpected(
        Error{quad.name, "", "the polygon: " + std::string(ras::to_string(fault->error))});
  }
  const oracle::SceneTruth scene(quad, cases::contract_of(quad));
  const oracle::TriangleTruth first(scene, 0);
  cases::Fragments fragments;
  fragments.attribute_count = quad.attributes.size();
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const bool is_in_first =
        first.judge(drawn.x[i], drawn.y[i], drawn.sample[i]).verdict == records::Verdict::required;
    fragments.triangle.push_back(is_in_first ? 0 : 1);
  }
  fragments.x = std::move(drawn.x);
  fragments.y = std::move(drawn.y);
  fragments.sample = std::move(drawn.sample);
  fragments.depth = std::move(drawn.depth);
  fragments.attributes = std::move(drawn.attributes);
  return fragments;
}

}  // namespace

Result<DrawnScene> draw_by(std::string_view method, const cases::Case& scene) {
  Result<cases::ClipCase> clip = oracle::to_clip_case(scene, scene.name);
  if (!clip) return tl::unexpected(clip.error());
  DrawnScene drawn;
  drawn.method = method;
  drawn.scene = *std::move(clip);
  const bool is_polygon = method == kLinearPolygon;
  const std::string specification(is_polygon ? kCoverageOfPolygons : method);
  const auto backend = backends::make_backend(specification);
  if (!backend) {
    drawn.missing = specification + " is not in this version";
    return drawn;
  }
  drawn.contract = (*backend)->contract(drawn.scene);
  Result<cases::Fragments> fragments =
      is_polygon ? draw_quad(drawn.scene)
                 : backends::fragments_of(properties::draw(drawn.scene, **backend));
  if (!fragments) return tl::unexpected(fragments.error());
  drawn.fragments = *std::move(fragments);
  return drawn;
}

}  // namespace rastercheck::gallery
