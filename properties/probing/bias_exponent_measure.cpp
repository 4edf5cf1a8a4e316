// Measures whose exponent e a depth bias of float32 depths has in r = 2^(e−23).
//
// Draws triangles whose depths have different exponents at their vertices, without and with a
// constant. The difference of the two drawings gives e. Triangles lie inside the viewport, or are
// cut at its sides or at the far plane, or pass the far plane under depth clamp, so that the
// vertices' greatest depth, clamped to the depth range or not, and that of the clipped triangle
// differ.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "properties/probing/depth_planes.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

using cases::BiasExponent;

/// Offsets are −2^(e−7): at least 2^-11 in size, far above kPlaneError, and at most 2^-4, so that
/// no sum is below 0. Negative, so that none is limited to 1.
constexpr float kConstant = -0x1p16F;
/// Depths of this size and more are drawn; the least exponent is −4.
constexpr double kLeastDepth = 0.0625;

/// Triangles of one kind, drawn in one case.
struct ExponentGroup {
  const char* where = "";
  std::vector<DepthTriangle> triangles;
  bool depth_clamp = false;
};

/// Returns the greatest |z| of what the viewport's sides and, unless depth is clamped, the depth
/// range leave of a triangle with w = 1.
double greatest_of_clipped(const DepthTriangle& triangle, bool depth_clamp) {
  struct Point {
    double u, v, z;
  };
  constexpr double kSide = 64;
  const auto corner = [&triangle](std::size_t i) {
    return Point{triangle.at[i].u, triangle.at[i].v, triangle.depth[i]};
  };
  std::vector<Point> polygon{corner(0), corner(1), corner(2)};
  const auto clip = [&polygon](const auto& inside) {
    std::vector<Point> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point& a = polygon[i];
      const Point& b = polygon[(i + 1) % polygon.size()];
      const double of_a = inside(a);
      const double of_b = inside(b);
      if (of_a >= 0) left.push_back(a);
      if ((of_a < 0) == (of_b < 0)) continue;
      const double t = of_a / (of_a - of_b);
      left.push_back({a.u + t * (b.u - a.u), a.v + t * (b.v - a.v), a.z + t * (b.z - a.z)});
    }
    polygon = left;
  };
  clip([](const Point& p) { return p.u; });
  clip([](const Point& p) { return p.v; });
  clip([](const Point& p) { return kSide - p.u; });
  clip([](const Point& p) { return kSide - p.v; });
  if (!depth_clamp) {
    clip([](const Point& p) { return p.z; });
    clip([](const Point& p) { return 1 - p.z; });
  }
  double greatest = 0;
  for (const Point& p : polygon) greatest = std::max(greatest, std::fabs(p.z));
  return greatest;
}

/// Exponents that a rule permits for one triangle.
using Exponents = std::set<int>;

/// A rule by which r may get its exponent.
struct ExponentRule {
  std::string_view words;
  Exponents (*of)(const DepthTriangle& triangle, bool depth_clamp);
  bool is_permitted;  ///< by BiasExponent::open
};

Exponents exponents_of(double z) { return z == 0 ? Exponents{} : Exponents{exponent_of(z)}; }

Exponents of_vertices(const DepthTriangle& triangle, bool /*depth_clamp*/) {
  const auto& z = triangle.depth;
  return exponents_of(std::clamp(*std::max_element(z.begin(), z.end()), 0.0, 1.0));
}

Exponents of_clipped(const DepthTriangle& triangle, bool depth_clamp) {
  const double greatest = greatest_of_clipped(triangle, depth_clamp);
  Exponents all = exponents_of(greatest);
  // A new vertex may lie one ULP below the plane that made it.
  if (!depth_clamp && greatest == 1) all.insert(-1);
  return all;
}

double magnitude(const DepthTriangle& triangle, std::size_t i) {
  return std::fabs(triangle.depth[i]);
}

Exponents of_unclamped(const DepthTriangle& triangle, bool /*depth_clamp*/) {
  return exponents_of(
      std::max({magnitude(triangle, 0), magnitude(triangle, 1), magnitude(triangle, 2)}));
}

template <std::size_t kVertex>
Exponents of_one(const DepthTriangle& triangle, bool /*depth_clamp*/) {
  return exponents_of(triangle.depth[kVertex]);
}

Exponents of_least(const DepthTriangle& triangle, bool /*depth_clamp*/) {
  return exponents_of(
      std::min({magnitude(triangle, 0), magnitude(triangle, 1), magnitude(triangle, 2)}));
}

/// The exponents of a vertex's depth and of the other depths' differences from it, for each of the
/// three vertices.
Exponents of_differences(const DepthTriangle& triangle, bool /*depth_clamp*/) {
  Exponents all;
  const auto& z = triangle.depth;
  for (std::size_t i = 0; i < 3; ++i) {
    all.merge(exponents_of(std::max(
        {std::fabs(z[i]), std::fabs(z[(i + 1) % 3] - z[i]), std::fabs(z[(i + 2) % 3] - z[i])})));
  }
  return all;
}

/// In order of preference.
constexpr std::array kExponentRules{
    ExponentRule{"the greatest of the vertices", &of_vertices, true},
    ExponentRule{"the greatest of the clipped triangle", &of_clipped, true},
    ExponentRule{"the greatest of the unclamped vertices", &of_unclamped, true},
    ExponentRule{"the first vertex", &of_one<0>, false},
    ExponentRule{"the second vertex", &of_one<1>, false},
    ExponentRule{"the last vertex", &of_one<2>, false},
    ExponentRule{"the least of the vertices", &of_least, false},
    ExponentRule{"the greatest of one vertex and the differences from it", &of_differences, false}};
constexpr std::size_t kOfVertices = 0;

/// Adds a triangle once with each of its vertices in front.
void add_rotations(std::vector<DepthTriangle>& all, const DepthTriangle& triangle) {
  for (std::size_t first = 0; first < 3; ++first) {
    DepthTriangle rotated;
    for (std::size_t i = 0; i < 3; ++i) {
      rotated.at[i] = triangle.at[(first + i) % 3];
      rotated.depth[i] = triangle.depth[(first + i) % 3];
    }
    all.push_back(rotated);
  }
}

ExponentGroup inside_group() {
  ExponentGroup group{"inside the viewport", {}, false};
  constexpr std::array<std::array<double, 3>, 5> kDepths{{{0.125, 0.125, 0.5},
                                                          {0.125, 0.5, 0.25},
                                                          {0.5, 0.75, 0.625},
                                                          {0.25, 0.0625, 0.125},
                                                          {0.375, 0.5, 0.0625}}};
  for (const auto& depth : kDepths) {
    DepthTriangle triangle = triangle_in_cell(4 * group.triangles.size() / 3, 0, 0, 0);
    triangle.depth = depth;
    add_rotations(group.triangles, triangle);
  }
  return group;
}

ExponentGroup sides_group() {
  ExponentGroup group{"cut at the viewport's sides", {}, false};
  // Outside at the right with a depth of more than the inner part has.
  for (const double far : {0.75, 0.5, 0.4375}) {
    const double v = 16.0 * static_cast<double>(group.triangles.size()) / 3;
    add_rotations(
        group.triangles,
        {{{{32, v}, {192, v + 8}, {32, v + 16}}}, {kLeastDepth, far, kLeastDepth}, {1, 1, 1}});
  }
  return group;
}

/// Triangles with one vertex at a depth outside the range. Under depth clamp that vertex lies
/// beyond the viewport's right side, if it may, so that the clipped triangle is another one.
ExponentGroup far_group(bool depth_clamp, bool side_clipping) {
  ExponentGroup group{depth_clamp ? "under depth clamp" : "cut at the far plane", {}, depth_clamp};
  std::vector<double> depths{4, 8, 3};
  if (depth_clamp) depths.push_back(-3);
  const double right = depth_clamp && side_clipping ? 96 : 64;
  for (const double far : depths) {
    const double v = 16.0 * static_cast<double>(group.triangles.size()) / 3;
    add_rotations(group.triangles,
                  {{{{0, v}, {right, v + 8}, {0, v + 16}}}, {0.125, far, 0.125}, {1, 1, 1}});
  }
  return group;
}

/// How many samples of a group each rule explains.
struct ExponentReading {
  std::array<std::uint64_t, kExponentRules.size()> explained{};
  std::uint64_t telling = 0;
  std::uint64_t undecided = 0;  ///< by every rule

  void add(const DepthTriangle& triangle, bool depth_clamp, double exponent) {
    // Errors of the difference are well below a quarter of a binade.
    constexpr double kQuarter = 0.25;
    const int whole = static_cast<int>(std::lround(exponent));
    const bool is_whole = std::fabs(exponent - whole) < kQuarter;
    std::array<bool, kExponentRules.size()> explains{};
    for (std::size_t i = 0; i < kExponentRules.size(); ++i) {
      explains[i] = is_whole && kExponentRules[i].of(triangle, depth_clamp).contains(whole);
    }
    if (std::all_of(explains.begin(), explains.end(), [](bool one) { return one; })) {
      ++undecided;
      return;
    }
    ++telling;
    for (std::size_t i = 0; i < kExponentRules.size(); ++i) explained[i] += explains[i] ? 1U : 0U;
  }
};

ExponentReading read_exponents(Subject& subject, const ExponentGroup& group, double float_ratio) {
  ExponentReading reading;
  DepthState state{.depth_clamp = group.depth_clamp};
  const auto without = draw_planes(subject, group.triangles, state);
  state.bias.constant = kConstant;
  const auto with = draw_planes(subject, group.triangles, state);
  if (!without || !with) return reading;
  for (const BiasedFragment& fragment : biased_fragments(subject, *without, *with)) {
    // Depths at the range's ends may have been limited.
    if (fragment.with <= 0 || fragment.without >= 1) continue;
    const double unit = fragment.offset() / (double{kConstant} * float_ratio);
    const double exponent = unit > 0 ? std::log2(unit) + 23 : HUGE_VAL;
    reading.add(group.triangles[fragment.triangle], group.depth_clamp, std::min(exponent, 1000.0));
  }
  return reading;
}

/// Adds a group's row. Returns true if the rule of cases::BiasExponent::vertices explains it.
bool add_exponent(Subject& subject, const ExponentGroup& group, const ExponentReading& reading) {
  const BiasExponent declared = subject.declared().depth_bias.exponent;
  const char* const says =
      declared == BiasExponent::vertices ? kExponentRules[kOfVertices].words.data() : "of any part";
  const auto best = std::max_element(reading.explained.begin(), reading.explained.end()) -
                    reading.explained.begin();
  const ExponentRule& rule = kExponentRules[static_cast<std::size_t>(best)];
  const std::uint64_t explained = reading.explained[static_cast<std::size_t>(best)];
  const bool is_explained = explained == reading.telling;
  const bool is_of_vertices = reading.explained[kOfVertices] == reading.telling;
  subject
      .add(fmt::format("exponent of bias, {}", group.where), says,
           is_explained ? std::string(rule.words) : "of no kind tried",
           is_explained || explained == 0 ? "" : fmt::format("at best {}", rule.words),
           sure_of("samples", explained, reading.telling - explained, reading.undecided))
      .contradicts = !is_of_vertices &&
                     (declared == BiasExponent::vertices || !is_explained || !rule.is_permitted);
  return is_of_vertices;
}

}  // namespace

void measure_bias_exponent(Subject& subject, BiasSight& sight) {
  const cases::Capabilities capabilities = subject.capabilities();
  std::vector<ExponentGroup> groups{inside_group()};
  const bool has_sides = capabilities.has(cases::Feature::side_clipping);
  if (has_sides) groups.push_back(sides_group());
  if (capabilities.has(cases::Feature::depth_clipping))
    groups.push_back(far_group(false, has_sides));
  if (capabilities.has(cases::Feature::depth_clamp)) groups.push_back(far_group(true, has_sides));
  bool is_of_vertices = true;
  bool is_seen = false;
  for (const ExponentGroup& group : groups) {
    const ExponentReading reading = read_exponents(subject, group, *sight.float_ratio);
    if (reading.telling == 0) continue;
    is_seen = true;
    is_of_vertices = add_exponent(subject, group, reading) && is_of_vertices;
  }
  if (!is_seen) return;
  sight.found.exponent = is_of_vertices ? BiasExponent::vertices : BiasExponent::open;
  if (sight.found.exponent != subject.declared().depth_bias.exponent) sight.differs = true;
}

}  // namespace rastercheck::properties
