#include "oracle/internal/triangle_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "oracle/internal/number.h"
#include "oracle/internal/scene.h"

namespace rastercheck::oracle {
namespace {

constexpr double kFarAway = std::numeric_limits<double>::infinity();

/// How far from the exact triangle to look for covered samples, in pixels: as far as the contract
/// lets them be, and at least one pixel more.
double spread_of(const SceneTruth& scene, const cases::TrianglePromise& promise) {
  const cases::Contract& contract = scene.contract();
  double spread = 1;  // a margin of one pixel
  if (contract.conservative) {
    // A pixel is open if its square, grown by this, touches the triangle; rounded upwards.
    spread += (double{contract.conservative->growth} + double{contract.conservative->error}) *
              (1 + 0x1p-50);
  }
  if (!contract.coverage) return spread;
  spread += (1 + promise.position_error + promise.clip_tolerance + promise.side_tolerance) /
            contract.coverage->steps();
  if (contract.has_open_viewport()) {
    // The moves of vertices grow with the viewport (TriangleSetup::open_viewport).
    spread = spread * cases::most_growth(scene.source().viewport, contract.viewport_error) +
             contract.viewport_error + 1;
  }
  return spread;
}

/// A triangle's window positions in pixels, each coordinate less than `error` from the exact one.
struct NearVertices {
  std::array<std::array<double, 2>, 3> at{};  ///< [vertex][axis]
  double error = 0;
};

/// Empty if some w is not positive, or a position is not finite.
std::optional<NearVertices> near_vertices(const cases::Case& source, std::size_t triangle) {
  const cases::Viewport& viewport = source.viewport;
  // Halves may be negative, as a viewport may be either way round.
  const std::array<double, 2> half{viewport.width / 2.0, viewport.height / 2.0};
  const std::array<double, 2> middle{viewport.x + half[0], viewport.y + half[1]};
  NearVertices near;
  for (std::size_t i = 0; i < 3; ++i) {
    const cases::ClipVertex& p = source.positions[source.triangles[triangle][i]];
    if (!(exact_double(p.w) > 0)) return std::nullopt;
    const std::array<double, 2> clip{exact_double(p.x), source.rules == cases::Rules::d3d
                                                            ? -exact_double(p.y)
                                                            : exact_double(p.y)};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double share = clip[axis] / exact_double(p.w) * half[axis];
      near.at[i][axis] = middle[axis] + share;
      if (!std::isfinite(near.at[i][axis])) return std::nullopt;
      // Far more than the roundings can add in any rounding mode.
      near.error = std::max(near.error, (std::abs(share) + std::abs(middle[axis])) * 0x1p-40);
    }
  }
  return near;
}

/// True if a snapped triangle is certainly drawn whole: no vertex lies beyond a clip plane, a clip
/// distance or the viewport, which every guard band holds. Comparisons are exact.
bool is_surely_whole(const SceneTruth& scene, const cases::Triangle& vertices) {
  const cases::Case& source = scene.source();
  if (scene.contract().has_open_viewport() || source.clip_distance_count > 0) return false;
  return std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t vertex) {
    const cases::ClipVertex& p = source.positions[vertex];
    const double w = exact_double(p.w);
    const double z = exact_double(p.z);
    const double near_z = scene.scene().conventions().near_z * w;
    return std::abs(exact_double(p.x)) <= w && std::abs(exact_double(p.y)) <= w &&
           (source.depth_clamp || (near_z <= z && z <= w));
  });
}

/// True if the triangle is culled wherever the contract lets its vertices be placed, so that every
/// sample is forbidden. Closed meshes have as many such triangles as others, which then need no
/// exact set-up.
///
/// With all w > 0, the orientation is the sign of twice the area, the cross product of two sides.
/// It is affine in each vertex. If every vertex moves by at most r along both axes, it changes by
/// at most r Σ (|Δu| + |Δv|) over the three sides, plus 8 r² for moves that meet in one product. r
/// is the largest move of a placement plus the error of the positions, counted twice: the second is
/// far more than the roundings of the area, 2^-51 of products of sides, as no side is longer than
/// 2^41 errors.
bool is_surely_culled(const SceneTruth& scene, std::size_t triangle,
                      const cases::TrianglePromise& promise, const NearVertices& near) {
  const cases::Case& source = scene.source();
  if (!scene.scene().culls_anything()) return false;
  double move = 2 * near.error;
  if (const cases::Coverage& coverage = scene.contract().coverage) {
    if (!is_surely_whole(scene, source.triangles[triangle])) return false;
    move += (1 + double{promise.position_error}) / coverage->steps();
  }
  std::array<std::array<double, 2>, 3> side{};
  double lengths = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      side[i][axis] = near.at[(i + 1) % 3][axis] - near.at[i][axis];
      lengths += std::abs(side[i][axis]);
    }
  }
  const double area = side[0][0] * side[1][1] - side[0][1] * side[1][0];
  const double most_change = move * (lengths + 8 * move) * (1 + 0x1p-40);
  return std::abs(area) > most_change && scene.scene().is_culled(area > 0 ? 1 : -1);
}

/// A box that holds all samples that a triangle may cover.
PixelBox box_of(const SceneTruth& scene, std::size_t triangle,
                const cases::TrianglePromise& promise) {
  const cases::Case& source = scene.source();
  const PixelBox all{0, 0, source.framebuffer.width, source.framebuffer.height};
  if (source.primitive != cases::Primitive::triangles) {
    return TriangleTruth(scene, triangle).pixels();
  }
  if (source.camera) return all;
  const std::optional<NearVertices> near = near_vertices(source, triangle);
  if (!near) return all;
  if (is_surely_culled(scene, triangle, promise, *near)) return {0, 0, 0, 0};
  // Shifted edges may meet far away.
  const auto& conservative = scene.contract().conservative;
  if (conservative && conservative->corners == cases::ConservativeCorners::edges) return all;
  const double spread = spread_of(scene, promise) + near->error;
  std::array<double, 2> least{kFarAway, kFarAway};
  std::array<double, 2> greatest{-kFarAway, -kFarAway};
  for (const std::array<double, 2>& at : near->at) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      least[axis] = std::min(least[axis], at[axis]);
      greatest[axis] = std::max(greatest[axis], at[axis]);
    }
  }
  const auto pixel = [](double at, int most) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, static_cast<double>(most)));
  };
  return {pixel(least[0] - spread, all.x1), pixel(least[1] - spread, all.y1),
          pixel(greatest[0] + spread + 1, all.x1), pixel(greatest[1] + spread + 1, all.y1)};
}

}  // namespace

std::vector<PixelBox> boxes_of_triangles(const SceneTruth& scene) {
  const cases::Case& source = scene.source();
  std::vector<PixelBox> boxes;
  boxes.reserve(source.triangles.size());
  for (std::size_t t = 0; t < source.triangles.size(); ++t) {
    const cases::TrianglePromise promise = cases::promise_of(scene.contract(), source, t);
    boxes.push_back(promise.is_made ? box_of(scene, t, promise) : PixelBox{0, 0, 0, 0});
  }
  return boxes;
}

int rows_of_band(const cases::FramebufferSize& size) {
  constexpr int kSamples = 65536;
  return std::clamp(kSamples / (size.width * size.samples), 1, 64);
}

}  // namespace rastercheck::oracle
