#include "properties/generators/internal/close_triangles.h"

#include "properties/generators/internal/exact_splits.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties {

void add_with_distances(Draw& draw, cases::Case& c, const Corners& corners,
                        const Distances& distances) {
  const auto first = static_cast<std::size_t>(draw.between(0, 2));
  const std::size_t second = (first + 1) % 3;
  const std::size_t third = (first + 2) % 3;
  add_triangle(c, corners[first], corners[second], corners[third]);
  if (c.clip_distance_count == 0) return;
  for (const std::size_t i : {first, second, third}) c.clip_distances.push_back(distances[i]);
}

void set_level_depths(Draw& draw, const cases::Case& c, Corners& corners) {
  const float k = draw.uniform(near_depth(c) * 0.75F, 0.75F);
  for (cases::ClipVertex& p : corners) p.z = to_float(double{k} * double{p.w});
}

void set_exact_depths(Draw& draw, Corners& corners) {
  const float k = draw.pick(std::array{0.5F, 0.25F, 0.125F});
  for (cases::ClipVertex& p : corners) p.z = k * p.w;
}

float tiny_float(Draw& draw) { return draw.spread(kTiny.least, kTiny.most); }

void nudge_any(Draw& draw, std::span<float* const> numbers) {
  switch (draw.between(0, 5)) {
    case 0:
      nudge_smallest(draw, numbers);
      return;
    case 1: {
      const int chosen = draw.between(0, static_cast<int>(numbers.size()) - 1);
      float& number = *numbers[static_cast<std::size_t>(chosen)];
      number = stepped(number, draw.one_in(2) ? 1 : -1);
      return;
    }
    case 2:
    case 3:
      for (float* number : numbers) {
        if (*number == 0) *number = tiny_float(draw);
      }
      return;
    default:
      return;
  }
}

double short_factor(Draw& draw) {
  const int most = draw.pick(std::array{15, 1023, 65535});
  return static_cast<double>(draw.between(1, most));
}

void add_close_edge(Draw& draw, cases::Case& c) {
  const Ray q = ray_through(c, visible_sample(draw, c));
  Corners corners;
  for (int attempt = 0; attempt < 16; ++attempt) {
    const double k = short_factor(draw);
    const auto x = split_in_two(draw, k * q.x);
    const auto y = split_in_two(draw, k * q.y);
    const auto w = split_in_two(draw, k * q.w);
    if (!x || !y || !w) continue;
    corners[0] = {(*x)[0], (*y)[0], 0, (*w)[0]};
    corners[1] = {(*x)[1], (*y)[1], 0, (*w)[1]};
    break;
  }
  const WindowPoint third = point_about(draw, c);
  const float weight = draw.uniform(0.25F, 512);
  corners[2] = at_window(c, third, 0, draw.one_in(4) ? -weight : weight);
  cases::ClipVertex& a = corners[0];
  cases::ClipVertex& b = corners[1];
  nudge_any(draw, std::array{&a.x, &a.y, &a.w, &b.x, &b.y, &b.w});
  set_level_depths(draw, c, corners);
  add_with_distances(draw, c, corners, {1, 1, 1});
}

void add_needle(Draw& draw, cases::Case& c, const Exponents& thickness) {
  const Ray q = ray_through(c, visible_sample(draw, c));
  const auto k = static_cast<double>(draw.between(1, 15));
  const bool is_upright = draw.one_in(2);
  const double along = draw.between(-255, 255) / 256.0;
  const double weight = draw.between(1, 255) / 256.0;
  const double m = draw.between(1, 3);
  const double n = draw.between(1, 3);
  const float t = draw.spread(thickness.least, thickness.most);
  const auto corner = [&](double factor, double aside) {
    const double there = factor * along * weight;
    return cases::ClipVertex{to_float(is_upright ? aside : there),
                             to_float(is_upright ? there : aside), 0, to_float(factor * weight)};
  };
  Corners corners{corner(m, double{t}), corner(n, -double{t}), {}};
  const double there = (m + n) * along * weight;
  corners[2] = {to_float(k * q.x - (is_upright ? 0 : there)),
                to_float(k * q.y - (is_upright ? there : 0)), 0,
                to_float(k * q.w - (m + n) * weight)};
  if (draw.one_in(2)) {
    set_exact_depths(draw, corners);
  } else {
    for (cases::ClipVertex& p : corners) {
      const double depth = double{draw.uniform(near_depth(c) / 2, 0.5F)};
      p.z = to_float(depth * double{p.w});
    }
  }
  add_with_distances(draw, c, corners, {1, 1, 1});
}

void add_edge_on(Draw& draw, cases::Case& c) {
  constexpr int kMost = 1 << 20;
  const auto number = [&draw](int most) { return static_cast<float>(draw.between(-most, most)); };
  const int a_w = draw.between(kMost / 8, kMost);
  const int b_w =
      draw.one_in(4) ? draw.between(-kMost, -kMost / 8) : draw.between(kMost / 8, kMost);
  const bool turns_back = !draw.one_in(4);
  int m = draw.between(1, 4);
  int n = draw.between(1, 4);
  if (turns_back || draw.one_in(2)) m = -m;
  if (turns_back || draw.one_in(2)) n = -n;
  cases::ClipVertex a{0, 0, 0, static_cast<float>(a_w)};
  cases::ClipVertex b{0, 0, 0, static_cast<float>(b_w)};
  const auto third = [m, n](float of_a, float of_b) {
    return static_cast<float>(m) * of_a + static_cast<float>(n) * of_b;  // of at most 23 bits
  };
  a.x = number(a_w);
  a.y = number(a_w);
  b.x = number(kMost);
  b.y = number(kMost);
  const bool cancels = draw.one_in(2);
  if (cancels) {  // m a + n b = 0 in x or in y
    const float common = number(kMost / 8);
    const bool is_x = draw.one_in(2);
    (is_x ? a.x : a.y) = static_cast<float>(n) * common;
    (is_x ? b.x : b.y) = -static_cast<float>(m) * common;
  }
  cases::ClipVertex last{third(a.x, b.x), third(a.y, b.y), 0, third(a.w, b.w)};
  nudge_any(draw, std::array{&last.x, &last.y, &last.w, &a.x, &b.y});
  Corners corners{a, b, last};
  set_exact_depths(draw, corners);
  add_with_distances(draw, c, corners, {1, 1, 1});
}

}  // namespace rastercheck::properties
