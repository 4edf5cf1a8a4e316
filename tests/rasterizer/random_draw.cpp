#include "tests/rasterizer/random_draw.h"

#include <array>

namespace rastercheck::rasterizer {
namespace {

/// A clip-space number that puts a corner on a dyadic grid of the window, if the viewport is
/// dyadic.
float on_grid(Random& random) { return static_cast<float>(random.between(-20, 20)) / 8; }

glm::vec4 random_corner(Random& random, int kind) {
  const float w = random.pick({1.0F, 1.0F, 0.5F, 4.0F});
  const float z = random.one_in(3) ? on_grid(random) / 2 : random.real(-3, -1);
  switch (kind) {
    case 0:  // on a grid
      return {on_grid(random) * w, on_grid(random) * w, z * w, w};
    case 1:  // ordinary
      return {random.real(-2, 1), random.real(-2, 1), z, std::abs(random.real(-2, 2)) + 0.125F};
    case 2:  // w of any sign, or 0
      return {random.real(-2, 1), random.real(-2, 1), z, random.real(-3, 2)};
    case 3:  // on a grid, with w of any sign
      return {on_grid(random), on_grid(random), z, static_cast<float>(random.between(-2, 2))};
    case 4:  // any size
      return {random.any_real(), random.any_real(), random.any_real(), random.any_real()};
    case 5:  // x and y of any size, in front of the eye
      return {random.any_real(), random.any_real(), z, 1};
    case 6:  // far beyond the window
      return {random.real(0, 120), random.real(0, 120), z, 1};
    default:  // near the smallest numbers
      return {random.real(-149, -146), random.real(-149, -146), random.real(-149, -147),
              std::abs(random.real(-149, -147))};
  }
}

glm::vec4 scaled(const glm::vec4& p, float factor) {
  return {p.x * factor, p.y * factor, p.z * factor, p.w * factor};
}

/// Puts the corners into a special position, scales them, or leaves them as they are.
void disturb(Random& random, std::array<glm::vec4, 3>& p) {
  switch (random.between(0, 7)) {
    case 0: {  // nearly, or exactly, on a line with the others
      const auto t = static_cast<float>(random.between(-8, 16)) / 8;
      for (int i = 0; i < 4; ++i) p[2][i] = p[0][i] + t * (p[1][i] - p[0][i]);
      if (random.one_in(2)) p[2].x = std::nextafter(p[2].x, 8.0F);
      break;
    }
    case 1:  // an edge through the middle of the viewport
      p[1].x = -p[0].x;
      p[1].y = -p[0].y;
      p[1].w = p[0].w;
      break;
    case 2:  // one w for all three, as on a plane at one distance
      p[1].w = p[0].w;
      p[2].w = p[0].w;
      break;
    case 3:  // one depth z/w for all three
      for (glm::vec4& q : p) q.z = q.w / 4;
      break;
    case 4:  // the same window positions from other numbers
      for (glm::vec4& q : p) q = scaled(q, std::ldexp(1.0F, random.between(-120, 30)));
      break;
    case 5:
      p[0] = scaled(p[0], std::ldexp(1.0F, random.between(-100, 30)));
      break;
    default:
      break;
  }
  for (glm::vec4& q : p) {
    for (int i = 0; i < 4; ++i) {
      if (!std::isfinite(q[i])) q[i] = 1;
    }
  }
}

State random_state(Random& random, const TargetSize& size) {
  State state;
  state.convention = random.pick({Convention::opengl, Convention::vulkan, Convention::d3d});
  state.fill_rule = random.pick({FillRule::top_left, FillRule::bottom_left});
  state.cull = random.pick({Cull::none, Cull::none, Cull::none, Cull::back, Cull::front});
  state.front_face = random.pick({FrontFace::ccw, FrontFace::cw});
  state.depth_clamp = random.one_in(2);
  state.clip_distance_count = random.one_in(3) ? 2 : 0;
  using I = Interpolation;
  using L = Location;
  const auto place = [&random] { return random.pick({L::sample, L::center, L::centroid}); };
  state.attributes = {{I::smooth, place()},
                      {I::noperspective, place()},
                      {I::flat, place()},
                      {I::smooth, L::sample},
                      {I::noperspective, L::sample}};
  const auto kind = static_cast<ViewportKind>(random.between(0, 7));
  state.viewport = random_viewport(random, random.one_in(3) ? ViewportKind::plain : kind, size);
  if (random.one_in(4)) {
    state.scissor = {{random.between(-2, 3), random.between(-2, 3)},
                     {random.between(0, 9), random.between(0, 9)}};
  }
  return state;
}

}  // namespace

Viewport random_viewport(Random& random, ViewportKind kind, const TargetSize& size) {
  const glm::vec2 target{size.width, size.height};
  Viewport viewport{{0, 0}, target, 0, 1};
  if (random.one_in(2)) {
    viewport.min_depth = random.pick({0.0F, 1.0F, 0.25F, 0x1p-140F});
    viewport.max_depth = random.pick({0.0F, 1.0F, 0.75F, 0.1F});
  }
  // Each axis is chosen separately, so that odd and plain axes occur together.
  for (int i = 0; i < 2; ++i) {
    float& origin = viewport.origin[i];
    float& extent = viewport.size[i];
    switch (random.one_in(4) ? ViewportKind::plain : kind) {
      case ViewportKind::plain:
        break;
      case ViewportKind::on_a_grid:
        origin = static_cast<float>(random.between(-512, 512)) / 256;
        extent = static_cast<float>(random.between(64, 4'000)) / 256;
        break;
      case ViewportKind::tenths:
        origin = static_cast<float>(random.between(-20, 20)) * 0.1F;
        extent = static_cast<float>(random.between(1, 90)) * 0.1F;
        break;
      case ViewportKind::subnormal:
        origin = random.pick({0x1p-149F, -0x1p-149F, 0x1.8p-130F, 0.0F, 0.5F});
        extent = random.pick({0x1p-149F, 0x1p-126F, target[i], 1.5F});
        break;
      case ViewportKind::narrow:
        origin = static_cast<float>(random.between(0, 16)) / 4;
        extent = random.pick({1e-30F, 1e-7F, 0x1p-20F});
        break;
      case ViewportKind::enormous:
        origin = random.pick({-1.5e38F, -3.4e38F, -1e5F, -3e20F});
        extent = random.pick({3e38F, 3.4028235e38F, 6e20F, 2e5F});
        break;
      case ViewportKind::mirrored:
        origin = target[i] + static_cast<float>(random.between(-4, 4)) / 16;
        extent = -target[i];
        break;
      case ViewportKind::any:
        origin = random.any_real();
        extent = random.any_real();
        break;
    }
  }
  return viewport;
}

SmallMesh random_mesh(Random& random, const State& state) {
  SmallMesh mesh;
  const int kind = random.between(0, 7);
  std::array<glm::vec4, 3> p;
  for (glm::vec4& q : p) q = random_corner(random, random.one_in(8) ? 2 : kind);
  disturb(random, p);
  mesh.positions.assign(p.begin(), p.end());
  mesh.triangles = {{0, 1, 2}};
  for (std::size_t i = 0; i < 3 * state.attributes.size(); ++i) {
    mesh.attributes.push_back(random.one_in(4) ? random.any_real() : random.real(-2, 2));
  }
  for (std::size_t i = 0; i < 3 * state.clip_distance_count; ++i) {
    mesh.clip_distances.push_back(random.one_in(3) ? random.real(-149, 100) : on_grid(random) + 1);
  }
  return mesh;
}

RandomDraw random_draw(Random& random) {
  RandomDraw draw;
  draw.size = {random.between(1, 7), random.between(1, 6), random.pick({1, 1, 2, 4, 8, 16})};
  draw.state = random_state(random, draw.size);
  draw.mesh = random_mesh(random, draw.state);
  return draw;
}

}  // namespace rastercheck::rasterizer
