#include "tests/rasterizer/brute_force.h"

#include <algorithm>

namespace rastercheck::rasterizer {

BruteForce::BruteForce(const State& state, const SmallMesh& mesh, const glm::uvec3& corners)
    : state_(state) {
  const Rational x0 = state.viewport.origin.x;
  const Rational y0 = state.viewport.origin.y;
  const Rational half_width = Rational(state.viewport.size.x) / 2;
  const Rational half_height = Rational(state.viewport.size.y) / 2;
  std::array<Rational, 3> x;
  std::array<Rational, 3> y;
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t vertex = corners[i];
    const auto k = static_cast<std::size_t>(i);
    const glm::vec4& p = mesh.positions[vertex];
    w_[k] = p.w;
    z_[k] = p.z;
    const Rational up = state.convention == Convention::d3d ? -p.y : p.y;
    x[k] = Rational(p.x) * half_width + w_[k] * (x0 + half_width);
    y[k] = up * half_height + w_[k] * (y0 + half_height);
    const std::size_t attributes = state.attributes.size();
    for (std::size_t a = 0; a < attributes; ++a) {
      attributes_[k].emplace_back(mesh.attributes[vertex * attributes + a]);
    }
    const std::size_t distances = state.clip_distance_count;
    for (std::size_t d = 0; d < distances; ++d) {
      distances_[k].emplace_back(mesh.clip_distances[vertex * distances + d]);
    }
  }
  // The rows of the inverse of the matrix with columns (x, y, w)_i are the cross products of two
  // columns, divided by the determinant.
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    e_[i] = {y[j] * w_[k] - w_[j] * y[k], w_[j] * x[k] - x[j] * w_[k], x[j] * y[k] - y[j] * x[k]};
  }
  determinant_ = e_[0].a * x[0] + e_[0].b * y[0] + e_[0].c * w_[0];
  if (determinant_ == 0) return;
  for (Functional& e : e_) {
    e.a /= determinant_;
    e.b /= determinant_;
    e.c /= determinant_;
  }
}

bool BruteForce::is_culled() const {
  if (state_.cull == Cull::none) return false;
  const bool points_up = state_.convention == Convention::opengl;
  const bool is_counter_clockwise = points_up ? determinant_ > 0 : determinant_ < 0;
  const bool is_front = is_counter_clockwise == (state_.front_face == FrontFace::ccw);
  return state_.cull == (is_front ? Cull::front : Cull::back);
}

std::array<Rational, 3> BruteForce::weights(const Rational& u, const Rational& v) const {
  return {e_[0].at(u, v), e_[1].at(u, v), e_[2].at(u, v)};
}

BruteForce::Functional BruteForce::combined(const std::array<Rational, 3>& factors) const {
  Functional sum;
  for (std::size_t i = 0; i < 3; ++i) {
    sum.a += factors[i] * e_[i].a;
    sum.b += factors[i] * e_[i].b;
    sum.c += factors[i] * e_[i].c;
  }
  return sum;
}

/// Applies the fill rule as displayed: a sample on the edge is inside if the inward normal points
/// right, or straight down (a top edge) or straight up (a bottom edge), depending on the rule.
bool BruteForce::owns_zero(const Functional& functional) const {
  if (functional.a != 0) return functional.a > 0;
  const bool v_points_down = state_.convention != Convention::opengl;
  const bool points_down = v_points_down ? functional.b > 0 : functional.b < 0;
  const bool points_up = v_points_down ? functional.b < 0 : functional.b > 0;
  return state_.fill_rule == FillRule::top_left ? points_down : points_up;
}

bool BruteForce::is_in_viewport(const Rational& u, const Rational& v) const {
  const auto is_between = [](const Rational& at, float origin, float size) {
    const Rational from = origin;
    const Rational to = from + Rational(size);
    return size >= 0 ? from <= at && at < to : to <= at && at < from;
  };
  const Viewport& viewport = state_.viewport;
  return is_between(u, viewport.origin.x, viewport.size.x) &&
         is_between(v, viewport.origin.y, viewport.size.y);
}

bool BruteForce::covers(const Rational& u, const Rational& v) const {
  if (determinant_ == 0 || !is_in_viewport(u, v)) return false;
  for (const Functional& e : e_) {
    const Rational value = e.at(u, v);
    if (value < 0 || (value == 0 && !owns_zero(e))) return false;
  }
  if (!state_.depth_clamp) {
    const Rational z = combined(z_).at(u, v);
    const int least = state_.convention == Convention::opengl ? -1 : 0;
    if (z < least || z > 1) return false;
  }
  for (std::size_t d = 0; d < state_.clip_distance_count; ++d) {
    const Functional f = combined({distances_[0][d], distances_[1][d], distances_[2][d]});
    const Rational value = f.at(u, v);
    if (value < 0) return false;
    const bool is_nothing = f.a == 0 && f.b == 0 && f.c == 0;
    const bool keeps_zero = state_.convention == Convention::d3d || is_nothing || owns_zero(f);
    if (value == 0 && !keeps_zero) return false;
  }
  return true;
}

Rational BruteForce::depth(const Rational& u, const Rational& v) const {
  return clamped_to_range(plane_depth(u, v));
}

Rational BruteForce::plane_depth(const Rational& u, const Rational& v) const {
  return in_range(combined(z_).at(u, v));
}

Rational BruteForce::steepness() const {
  const Functional z = combined(z_);
  return std::max(Rational(abs(z.a)), Rational(abs(z.b))) * abs(in_range(1) - in_range(0));
}

/// The depth of z in clip space, divided by w.
Rational BruteForce::in_range(const Rational& z) const {
  const Rational near = state_.viewport.min_depth;
  const Rational far = state_.viewport.max_depth;
  const Rational share = state_.convention == Convention::opengl ? Rational((z + 1) / 2) : z;
  return near + (far - near) * share;
}

Rational BruteForce::clamped_to_range(const Rational& depth) const {
  const Rational least = std::min(state_.viewport.min_depth, state_.viewport.max_depth);
  const Rational greatest = std::max(state_.viewport.min_depth, state_.viewport.max_depth);
  return depth < least ? least : depth > greatest ? greatest : depth;
}

/// State::depth_bias of the triangle.
Rational BruteForce::offset() const {
  const DepthBias& bias = state_.depth_bias;
  const bool is_d3d = state_.convention == Convention::d3d;
  Rational r;
  if (state_.depth_format == DepthFormat::float32) {
    Rational most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Rational depth =
          w_[i] > 0 ? clamped_to_range(in_range(z_[i] / w_[i]))
                    : Rational(std::max(state_.viewport.min_depth, state_.viewport.max_depth));
      if (depth > most) most = depth;
    }
    r = most == 0 ? Rational(0) : power_of_two(floor_log2(most) - 23);
  } else {
    const int bits = state_.depth_format == DepthFormat::unorm16 ? 16 : 24;
    r = power_of_two(-bits);
    // 1/(2^b − 1) = 2^-b (1 + 2^-b + 2^-2b + …), of which float32 has two terms of 16 bits; of 24
    // bits, 2^-24 is half a unit in the last place and what follows rounds it up.
    if (is_d3d) r *= 1 + power_of_two(bits == 16 ? -16 : -23);
  }
  const Rational sum = steepness() * Rational(bias.slope) + r * Rational(bias.constant);
  const Rational clamp = bias.clamp;
  if (clamp > 0 && sum > clamp) return clamp;
  return clamp < 0 && sum < clamp ? clamp : sum;
}

Rational BruteForce::biased_depth(const Rational& u, const Rational& v) const {
  Rational depth = plane_depth(u, v);
  if (!state_.depth_bias.is_none()) depth += offset();
  if (state_.depth_clamp || state_.convention == Convention::d3d) return clamped_to_range(depth);
  return depth < 0 ? Rational(0) : depth > 1 ? Rational(1) : depth;
}

Rational BruteForce::reciprocal_w(const Rational& u, const Rational& v) const {
  return combined({1, 1, 1}).at(u, v);
}

Rational BruteForce::attribute(std::size_t index, const Rational& u, const Rational& v) const {
  const Interpolation interpolation = state_.attributes[index].interpolation;
  if (interpolation == Interpolation::flat) {
    return attributes_[state_.convention == Convention::opengl ? 2 : 0][index];
  }
  const std::array<Rational, 3> e = weights(u, v);
  const bool is_smooth = interpolation == Interpolation::smooth;
  Rational value = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    value += attributes_[i][index] * e[i] * (is_smooth ? Rational(1) : w_[i]);
  }
  return is_smooth ? Rational(value / (e[0] + e[1] + e[2])) : value;
}

Rational BruteForce::scale(std::size_t index) const {
  Rational greatest = 0;
  for (const std::vector<Rational>& values : attributes_) {
    const Rational size = abs(values[index]);
    if (size > greatest) greatest = size;
  }
  return greatest;
}

std::vector<std::array<Rational, 2>> brute_force_pattern(int samples) {
  using Sixteenths = std::vector<std::array<int, 2>>;
  Sixteenths table;
  if (samples == 1) table = {{8, 8}};
  if (samples == 2) table = {{12, 12}, {4, 4}};
  if (samples == 4) table = {{6, 2}, {14, 6}, {2, 10}, {10, 14}};
  if (samples == 8) {
    table = {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}};
  }
  if (samples == 16) {
    table = {{9, 9},  {7, 5}, {5, 10}, {12, 7}, {3, 6}, {10, 13}, {13, 11}, {11, 3},
             {6, 14}, {8, 1}, {4, 2},  {2, 12}, {0, 8}, {15, 4},  {14, 15}, {1, 0}};
  }
  std::vector<std::array<Rational, 2>> pattern;
  for (const auto& [x, y] : table) pattern.push_back({Rational(x) / 16, Rational(y) / 16});
  return pattern;
}

}  // namespace rastercheck::rasterizer
