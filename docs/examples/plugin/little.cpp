// A little rasterizer in C++20, as a RasterCheck plugin.
// docs/judge-your-rasterizer.md tells how to build it and how to have it judged.
//
// Window positions are snapped to a grid of 1/256 pixel. After that, coverage is exact: edges have
// integer coefficients, and the tie rule decides for a sample exactly on an edge. Values are
// computed from the same integers, in double, and rounded to float32 once, at the end.
//
// It does not clip. It refuses triangles with some w <= 0, and triangles that reach farther than
// 32768 pixels. It says so (`lacks`, RASTERCHECK_UNSUPPORTED), so they do not count against it.
//
// Below, u = 2^-53 is the relative error of an operation on doubles. A float32 step is more than
// 2^-24 of the number itself, so u is less than 2^-29 of a step.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "rastercheck/plugin.h"

namespace {

constexpr std::int64_t kGrid = 256;   // points per pixel and axis
constexpr double kGuardBand = 32768;  // pixels; the default of contract.guard_band
constexpr double kMostDepth = 65536;  // limit for |z/w| at vertices
constexpr std::size_t kMostSamples = 16;

using Triple = std::array<double, 3>;  // a number for each vertex

// The plugin's promises. Members that are not set are 0: ties as asked, and no limits but `lacks`.
constexpr rastercheck_contract contract() {
  rastercheck_contract c{};
  c.size = sizeof(c);
  c.coverage = RASTERCHECK_COVERAGE_SNAPPED;
  c.subpixel_bits = 8;
  c.rounding = RASTERCHECK_ROUNDING_NEAREST_EVEN;
  c.position_error = 0x1p-27F;  // see window_position()
  c.clip_tolerance = 1;         // a cut runs between snapped vertices, so it moves by half a unit
  c.basis = RASTERCHECK_BASIS_SNAPPED;
  c.keeps = RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH;
  c.smooth.constant = 0.5F + 0x1p-24F;         // see weighted_mean()
  c.noperspective.constant = 0.5F + 0x1p-24F;  // the same
  c.depth.constant = 0.5F + 0x1p-9F;           // see depth_at()
  c.lacks = RASTERCHECK_LACKS_NONPOSITIVE_W | RASTERCHECK_LACKS_CENTER;
  return c;
}
constexpr rastercheck_contract kContract = contract();

// A point in grid units.
struct Point {
  std::int64_t u = 0;
  std::int64_t v = 0;
};

// E = a u + b v + c is twice the area between an edge and a point, positive inside, 0 on the edge.
// Coordinates are at most 2^23 from the origin, so a and b are within 2^24 and E is within 2^50.
// These are exact in int64 and in double.
struct Edge {
  std::int64_t a = 0;
  std::int64_t b = 0;
  std::int64_t c = 0;

  constexpr std::int64_t at(Point p) const { return a * p.u + b * p.v + c; }
  constexpr Edge operator-() const { return {-a, -b, -c}; }
};

constexpr Edge edge_between(Point p, Point q) {
  const Edge through_origin{p.v - q.v, q.u - p.u, 0};
  return {through_origin.a, through_origin.b, -through_origin.at(p)};
}

struct Triangle {
  std::array<std::uint32_t, 3> vertex{};
  std::array<Point, 3> corner{};  // snapped
  std::array<Edge, 3> edge{};     // edge i lies opposite vertex i
  Triple z{};
  Triple w{};
  Triple depth{};  // z/w

  Triple edges_at(Point p) const {
    return {static_cast<double>(edge[0].at(p)), static_cast<double>(edge[1].at(p)),
            static_cast<double>(edge[2].at(p))};
  }
};

// A window coordinate in pixels. The result and `middle` are within 2^15, so c / w * scale is
// within 2^16. The division and the product are off by u 2^16 each, `middle` and the sum by u 2^15
// each. Together, this is less than 2^-35 pixels or 2^-27 grid units. (scale is half a viewport:
// exact.)
double window_position(double c, double w, double scale, double middle) {
  return c / w * scale + middle;
}

// The mean of the vertices' values. The weights have the same sign and a relative error of u. With
// the products, the sums and the quotient, the mean is off by 8 u of the greatest value, which is
// 2^-26 of a float32 step, and by half a step from its rounding.
float weighted_mean(const Triple& r, const Triple& weight) {
  return static_cast<float>((r[0] * weight[0] + r[1] * weight[1] + r[2] * weight[2]) /
                            (weight[0] + weight[1] + weight[2]));
}

bool is_between(std::int64_t u, double begin, double size) {
  const double pixels = static_cast<double>(u) / kGrid;
  const auto [low, high] = std::minmax({begin, begin + size});
  return pixels >= low && pixels < high;
}

// True if begin + size is exact, so that the far side of the viewport is where it should be.
bool is_exact_sum(double begin, double size) {
  const double end = begin + size;
  return end - begin == size && end - size == begin;
}

class Drawing {
 public:
  Drawing(const rastercheck_draw& draw, rastercheck_output& out)
      : draw_(draw),
        out_(out),
        is_opengl_(draw.rules == RASTERCHECK_RULES_OPENGL),
        is_d3d_(draw.rules == RASTERCHECK_RULES_D3D),
        positions_(draw.positions, std::size_t{4} * draw.vertex_count),
        attributes_(draw.attributes, draw.attribute_count),
        indices_(draw.indices, std::size_t{3} * draw.triangle_count) {}

  std::uint32_t run() {
    if (!has_plain_viewport()) {
      return refuse("a viewport that is too far away, or of too many digits");
    }
    for (std::uint32_t number = 0; number < draw_.triangle_count; ++number) {
      std::optional<Triangle> t = triangle(indices_.subspan(std::size_t{3} * number).first<3>());
      if (!t) return refuse("a vertex beyond the guard band, or z/w beyond 65536");
      if (orient(*t)) draw_triangle(*t, number);
    }
    return RASTERCHECK_OK;
  }

 private:
  std::uint32_t refuse(std::string_view why) {
    why.copy(out_.message, out_.message_size - 1);
    return RASTERCHECK_UNSUPPORTED;
  }

  bool has_plain_viewport() const {
    return std::abs(middle_x()) <= kGuardBand && std::abs(middle_y()) <= kGuardBand &&
           is_exact_sum(draw_.viewport_x, draw_.viewport_width) &&
           is_exact_sum(draw_.viewport_y, draw_.viewport_height);
  }
  double middle_x() const { return double{draw_.viewport_x} + double{draw_.viewport_width} / 2; }
  double middle_y() const { return double{draw_.viewport_y} + double{draw_.viewport_height} / 2; }

  // Nothing if a vertex lies too far away.
  std::optional<Triangle> triangle(std::span<const std::uint32_t, 3> vertices) const {
    Triangle t;
    const double height = is_d3d_ ? -draw_.viewport_height : draw_.viewport_height;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto p = positions_.subspan(std::size_t{4} * vertices[i]).first<4>();
      const double x = window_position(p[0], p[3], double{draw_.viewport_width} / 2, middle_x());
      const double y = window_position(p[1], p[3], height / 2, middle_y());
      t.vertex[i] = vertices[i];
      t.z[i] = p[2];
      t.w[i] = p[3];
      t.depth[i] = t.z[i] / t.w[i];
      if (!(std::abs(x) <= kGuardBand && std::abs(y) <= kGuardBand)) return std::nullopt;
      if (!(std::abs(t.depth[i]) <= kMostDepth)) return std::nullopt;
      // Rounds to nearest even, the default rounding mode.
      t.corner[i] = {std::llrint(x * kGrid), std::llrint(y * kGrid)};
    }
    for (std::size_t i = 0; i < 3; ++i) {
      t.edge[i] = edge_between(t.corner[(i + 1) % 3], t.corner[(i + 2) % 3]);
    }
    return t;
  }

  // Makes edges positive inside. Returns false if the triangle has no area or is culled.
  bool orient(Triangle& t) const {
    const std::int64_t area = t.edge[0].at(t.corner[0]);
    const bool is_ccw = (area > 0) == is_opengl_;  // y up
    const bool is_front = is_ccw == (draw_.front_face == RASTERCHECK_FRONT_FACE_CCW);
    if (area < 0) std::ranges::transform(t.edge, t.edge.begin(), std::negate<>());
    return area != 0 && draw_.cull != (is_front ? RASTERCHECK_CULL_FRONT : RASTERCHECK_CULL_BACK);
  }

  // Decides whether a sample is inside where a linear function is 0, by the function's gradient (a,
  // b).
  bool owns_zero(double a, double b) const {
    const bool is_top_left = draw_.tie_rule == RASTERCHECK_TIE_RULE_TOP_LEFT;
    return a > 0 || (a == 0 && (is_top_left == !is_opengl_ ? b > 0 : b < 0));
  }

  // Returns Σ d_i E_i / w_i. Each term has a relative error of a few u, as if d_i had it, so the
  // cut runs 2^-50 of the triangle's size beside its right place.
  static double cut(const Triple& d, const Triple& weight) {
    return d[0] * weight[0] + d[1] * weight[1] + d[2] * weight[2];
  }

  // True if a sample is on the wrong side of a clip distance. If the distance is 0, its gradient
  // decides.
  bool is_clipped(const Triangle& t, const Triple& d, const Triple& weight) const {
    const double sum = cut(d, weight);
    if (sum != 0 || is_d3d_) return sum < 0;
    double a = 0;
    double b = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      a += d[i] * (static_cast<double>(t.edge[i].a) / t.w[i]);
      b += d[i] * (static_cast<double>(t.edge[i].b) / t.w[i]);
    }
    return !(a == 0 && b == 0) && !owns_zero(a, b);
  }

  bool covers(const Triangle& t, Point p) const {
    Triple weight;
    Triple near_plane;
    Triple far_plane;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge& edge = t.edge[i];
      const std::int64_t e = edge.at(p);
      if (e < 0) return false;
      if (e == 0 && !owns_zero(static_cast<double>(edge.a), static_cast<double>(edge.b))) {
        return false;
      }
      weight[i] = static_cast<double>(e) / t.w[i];
      near_plane[i] = is_opengl_ ? t.z[i] + t.w[i] : t.z[i];
      far_plane[i] = t.w[i] - t.z[i];
    }
    if (!is_between(p.u, draw_.viewport_x, draw_.viewport_width)) return false;
    if (!is_between(p.v, draw_.viewport_y, draw_.viewport_height)) return false;
    if (draw_.depth_clamp == 0 && (cut(near_plane, weight) < 0 || cut(far_plane, weight) < 0)) {
      return false;
    }
    for (std::size_t d = 0; d < draw_.clip_distance_count; ++d) {
      Triple distance;
      for (std::size_t i = 0; i < 3; ++i) {
        distance[i] =
            draw_.clip_distances[t.vertex[i] * std::size_t{draw_.clip_distance_count} + d];
      }
      if (is_clipped(t, distance, weight)) return false;
    }
    return true;
  }

  // z/w is linear in the window, so it is the mean of z/w at the vertices, weighted by E_i. Adding
  // differences to the value of one vertex keeps equal values equal. Let Q be the greatest |z/w|.
  // Quotients are off by u Q. Differences, products, their sum and its quotient are off by 2 u Q
  // each, and the sum with the first value by u Q. This makes 10 u Q. The depth range adds 3 u Q,
  // which makes 13 u Q of its greater end. With Q = 2^16 this is less than 2^-9 of a float32 step.
  float depth_at(const Triangle& t, Point p) const {
    const double n = draw_.min_depth;
    const double f = draw_.max_depth;
    const Triple e = t.edges_at(p);
    const Triple& z = t.depth;
    double depth = z[0] + ((z[1] - z[0]) * e[1] + (z[2] - z[0]) * e[2]) / (e[0] + e[1] + e[2]);
    if (is_opengl_) depth = (depth + 1) / 2;
    depth = n + (f - n) * depth;
    if (draw_.depth_clamp != 0 || is_d3d_) {
      depth = std::clamp(depth, std::min(n, f), std::max(n, f));
    }
    return static_cast<float>(depth);
  }

  // Writes the attributes at a sample, or at the point that counts as the pixel's centroid.
  void shade(const Triangle& t, Point sample, Point centroid, std::span<float> values) const {
    for (std::size_t a = 0; a < values.size(); ++a) {
      const auto [interpolation, location] = attributes_[a];
      Triple r;
      for (std::size_t i = 0; i < 3; ++i) {
        r[i] = draw_.attribute_values[t.vertex[i] * values.size() + a];
      }
      Triple weight = t.edges_at(location == RASTERCHECK_AT_CENTROID ? centroid : sample);
      if (interpolation == RASTERCHECK_SMOOTH) {  // perspective
        std::ranges::transform(weight, t.w, weight.begin(), std::divides<>());
      }
      values[a] = interpolation == RASTERCHECK_FLAT ? static_cast<float>(r[is_opengl_ ? 2 : 0])
                                                    : weighted_mean(r, weight);
    }
  }

  void draw_pixel(const Triangle& t, std::uint32_t number, std::int64_t x, std::int64_t y) {
    std::array<Point, kMostSamples> at{};
    std::array<bool, kMostSamples> is_covered{};
    const std::size_t samples = draw_.samples;
    for (std::size_t s = 0; s < samples; ++s) {
      const float* position = draw_.sample_positions + 2 * s;
      at[s] = {x * kGrid + std::llrint(position[0] * float{kGrid}),
               y * kGrid + std::llrint(position[1] * float{kGrid})};
      is_covered[s] = covers(t, at[s]);
    }
    const auto covered = std::span(is_covered).first(samples);
    const bool is_full = std::ranges::find(covered, false) == covered.end();
    const auto first = std::ranges::find(covered, true) - covered.begin();
    if (static_cast<std::size_t>(first) == samples) return;
    const Point centre{x * kGrid + kGrid / 2, y * kGrid + kGrid / 2};
    const Point centroid = is_full ? centre : at[static_cast<std::size_t>(first)];
    for (std::size_t s = 0; s < samples; ++s) {
      const std::size_t i =
          (static_cast<std::size_t>(y) * draw_.width + static_cast<std::size_t>(x)) * samples + s;
      if (!covered[s]) continue;
      const float depth = depth_at(t, at[s]);
      const float before = out_.coverage[i] != 0 ? out_.depth[i] : draw_.depth_clear;
      if (draw_.depth_test != 0 && !(depth < before)) continue;
      out_.coverage[i] = 1;
      out_.triangle[i] = number;
      out_.depth[i] = depth;
      const std::size_t count = attributes_.size();
      if (count > 0) shade(t, at[s], centroid, {out_.attributes + i * count, count});
    }
  }

  void draw_triangle(const Triangle& t, std::uint32_t number) {
    // Draws pixels that are in the triangle's bounding box, the scissor rectangle and the
    // framebuffer.
    const auto [u_least, u_most] = std::minmax({t.corner[0].u, t.corner[1].u, t.corner[2].u});
    const auto [v_least, v_most] = std::minmax({t.corner[0].v, t.corner[1].v, t.corner[2].v});
    const std::int64_t left = draw_.scissor_x;
    const std::int64_t low = draw_.scissor_y;
    const std::int64_t x_begin = std::max({std::int64_t{0}, left, u_least / kGrid});
    const std::int64_t y_begin = std::max({std::int64_t{0}, low, v_least / kGrid});
    const std::int64_t x_end =
        std::min({std::int64_t{draw_.width}, left + draw_.scissor_width, u_most / kGrid + 1});
    const std::int64_t y_end =
        std::min({std::int64_t{draw_.height}, low + draw_.scissor_height, v_most / kGrid + 1});
    for (std::int64_t y = y_begin; y < y_end; ++y) {
      for (std::int64_t x = x_begin; x < x_end; ++x) draw_pixel(t, number, x, y);
    }
  }

  const rastercheck_draw& draw_;
  rastercheck_output& out_;
  bool is_opengl_;
  bool is_d3d_;
  std::span<const float> positions_;  // [vertex][4]
  std::span<const rastercheck_attribute> attributes_;
  std::span<const std::uint32_t> indices_;  // [triangle][3]
};

// No exception may leave a function that is called from C.
std::uint32_t draw(const rastercheck_draw* draw, rastercheck_output* out) {
  try {
    return Drawing(*draw, *out).run();
  } catch (const std::exception& e) {
    std::string_view(e.what()).copy(out->message, out->message_size - 1);
    return RASTERCHECK_FAILED;
  }
}

constexpr rastercheck_plugin kPlugin{
    .size = sizeof(rastercheck_plugin),
    .abi = RASTERCHECK_PLUGIN_ABI,
    .name = "little",
    .version = "1.0",
    .contract = &kContract,
    .draw = &draw,
    .query = nullptr,         // no occlusion culler
    .draw_picture = nullptr,  // fragments only
};

}  // namespace

const rastercheck_plugin* rastercheck_plugin_get() { return &kPlugin; }
