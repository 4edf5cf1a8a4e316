#include "properties/campaign/internal/case_moves.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "cases/contract.h"
#include "oracle/triangle_truth.h"
#include "properties/float_numbers.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using cases::ClipVertex;

// Sizes of steps. A step's exponent is chosen evenly, so that small and large steps are equally
// likely: how far a move has to go to raise an error is not known beforehand.

/// A number moves by at most 2^22 floats, which is half of its binade.
constexpr int kMostFloats = 22;
/// If all numbers move at once, each moves by at most 2^3 floats: enough for other roundings
/// everywhere, and too little to change what makes the case hard.
constexpr int kMostFloatsOfAll = 3;
/// A vertex moves towards the horizon, or a triangle grows, by a factor of at most 2^6 at a time:
/// the limit of the stratum "near horizon" is 2^4.
constexpr int kMostScale = 6;
/// A vertex moves to 2^-k of its distance from the opposite edge, 1 <= k <= 8: the limit of the
/// stratum "sliver" is 2^-6.
constexpr int kMostFlattening = 8;
/// A triangle moves by at most 2^3 pixels, and at least 2^-8 pixels, the usual subpixel grid.
constexpr int kMostPixels = 3;
constexpr int kLeastPixels = -8;

cases::Triangle& triangle_in_focus(Case& c, const MoveFocus& focus) {
  return c.triangles[focus.at.triangle];
}

int any_corner(Draw& draw) { return draw.between(0, 2); }

/// Returns the numbers of the triangle that decide the value in focus: positions, and the values of
/// the attribute.
std::vector<float*> numbers_in_focus(Case& c, const MoveFocus& focus) {
  std::vector<float*> numbers;
  for (const std::uint32_t vertex : triangle_in_focus(c, focus)) {
    ClipVertex& p = c.positions[vertex];
    numbers.insert(numbers.end(), {&p.x, &p.y, &p.z, &p.w});
    if (!focus.attribute) continue;
    numbers.push_back(&c.attribute_values[vertex * c.attributes.size() + *focus.attribute]);
  }
  return numbers;
}

/// Returns the values of the attribute in focus at the triangle's vertices; nullptrs if the depth
/// is in focus.
std::array<float*, 3> values_in_focus(Case& c, const MoveFocus& focus) {
  std::array<float*, 3> values{};
  if (!focus.attribute) return values;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t vertex = triangle_in_focus(c, focus)[i];
    values[i] = &c.attribute_values[vertex * c.attributes.size() + *focus.attribute];
  }
  return values;
}

ClipVertex times(const ClipVertex& p, double factor) {
  return {to_float(p.x * factor), to_float(p.y * factor), to_float(p.z * factor),
          to_float(p.w * factor)};
}

/// (1 − t) a + t b in clip space: a point of the line through both, in the window as well.
ClipVertex mixed(const ClipVertex& a, const ClipVertex& b, double t) {
  const auto mix = [t](float from, float to) {
    return to_float((1 - t) * double{from} + t * double{to});
  };
  return {mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z), mix(a.w, b.w)};
}

/// A random number in [2^lo, 2^(hi+1)) whose exponent is chosen evenly.
double factor_between(Draw& draw, int lo, int hi) {
  const int exponent = draw.between(lo, hi);
  return (1 + double{draw.unit()}) * power_of_two(exponent);
}

/// The window position of the sample in focus; empty if the viewport has no area, or if the
/// framebuffer lacks the sample.
std::optional<WindowPoint> sample_point(const Case& c, const MoveFocus& focus) {
  if (c.viewport.width == 0 || c.viewport.height == 0) return std::nullopt;
  const std::vector<WindowPoint> points = sample_points(c, cases::contract_of(c));
  if (focus.at.sample >= points.size()) return std::nullopt;
  const WindowPoint& p = points[focus.at.sample];
  return WindowPoint{focus.at.x + p.u, focus.at.y + p.v};
}

/// The clip position that appears at the sample in focus, with the weight and the depth of a
/// vertex; empty if there is none.
std::optional<ClipVertex> at_sample(const Case& c, const MoveFocus& focus, const ClipVertex& like) {
  const std::optional<WindowPoint> p = sample_point(c, focus);
  if (!p || like.w == 0) return std::nullopt;
  return at_window(c, *p, to_float(double{like.z} / double{like.w}), like.w);
}

// ---- moves of positions and values

bool float_neighbour(Case& c, const MoveFocus& focus, Draw& draw) {
  const std::vector<float*> numbers = numbers_in_focus(c, focus);
  float& number =
      *numbers[static_cast<std::size_t>(draw.between(0, static_cast<int>(numbers.size()) - 1))];
  const int exponent = draw.between(0, kMostFloats);
  const int size = 1 << exponent;
  number = stepped(number, draw.one_in(2) ? size : -size);
  return true;
}

bool all_neighbours(Case& c, const MoveFocus& focus, Draw& draw) {
  for (float* const number : numbers_in_focus(c, focus)) {
    *number = stepped(*number, draw.between(-(1 << kMostFloatsOfAll), 1 << kMostFloatsOfAll));
  }
  return true;
}

bool copy_number(Case& c, const MoveFocus& focus, Draw& draw) {
  const std::vector<float*> numbers = numbers_in_focus(c, focus);
  const std::size_t count = numbers.size() / 3;
  const auto which = static_cast<std::size_t>(draw.between(0, static_cast<int>(count) - 1));
  const auto from = static_cast<std::size_t>(any_corner(draw));
  const std::size_t to = (from + static_cast<std::size_t>(draw.between(1, 2))) % 3;
  const float copied = *numbers[from * count + which];
  return std::exchange(*numbers[to * count + which], copied) != copied;
}

bool scale_positions(Case& c, const MoveFocus& focus, Draw& draw) {
  const double factor = factor_between(draw, -kMostScale, kMostScale);
  for (const std::uint32_t vertex : triangle_in_focus(c, focus)) {
    c.positions[vertex] = times(c.positions[vertex], factor);
  }
  return true;
}

// ---- moves of positions

bool towards_horizon(Case& c, const MoveFocus& focus, Draw& draw) {
  const cases::Triangle triangle = triangle_in_focus(c, focus);
  const auto has_less_w = [&c](std::uint32_t a, std::uint32_t b) {
    return c.positions[a].w < c.positions[b].w;
  };
  const auto [least, greatest] = std::minmax_element(triangle.begin(), triangle.end(), has_less_w);
  if (c.positions[*least].w <= 0) return false;
  // A vertex times a factor stays at its window position; only its w changes.
  const double factor = factor_between(draw, 0, kMostScale - 1);
  if (draw.one_in(2)) {
    c.positions[*greatest] = times(c.positions[*greatest], factor);
  } else {
    c.positions[*least] = times(c.positions[*least], 1 / factor);
  }
  return true;
}

bool towards_sliver(Case& c, const MoveFocus& focus, Draw& draw) {
  const cases::Triangle triangle = triangle_in_focus(c, focus);
  const auto moved = static_cast<std::size_t>(any_corner(draw));
  const double share = double{draw.unit()};
  const int exponent = draw.between(1, kMostFlattening);
  const ClipVertex foot =
      mixed(c.positions[triangle[(moved + 1) % 3]], c.positions[triangle[(moved + 2) % 3]], share);
  ClipVertex& p = c.positions[triangle[moved]];
  p = mixed(foot, p, power_of_two(-exponent));
  return true;
}

bool edge_through_sample(Case& c, const MoveFocus& focus, Draw& draw) {
  const cases::Triangle triangle = triangle_in_focus(c, focus);
  const auto start = static_cast<std::size_t>(any_corner(draw));
  const std::size_t end = (start + static_cast<std::size_t>(draw.between(1, 2))) % 3;
  const double reach = 1 + 3 * double{draw.unit()};  // the edge ends beyond the sample
  const ClipVertex& from = c.positions[triangle[start]];
  ClipVertex& to = c.positions[triangle[end]];
  const std::optional<ClipVertex> sample = at_sample(c, focus, to);
  if (!sample) return false;
  to = mixed(from, *sample, reach);
  return true;
}

bool vertex_onto_sample(Case& c, const MoveFocus& focus, Draw& draw) {
  ClipVertex& p =
      c.positions[triangle_in_focus(c, focus)[static_cast<std::size_t>(any_corner(draw))]];
  const std::optional<ClipVertex> sample = at_sample(c, focus, p);
  if (!sample) return false;
  p = *sample;
  return true;
}

bool about_sample(Case& c, const MoveFocus& focus, Draw& draw) {
  const double factor = factor_between(draw, -2, 1);
  cases::Case changed = c;
  for (const std::uint32_t vertex : triangle_in_focus(c, focus)) {
    ClipVertex& p = changed.positions[vertex];
    const std::optional<ClipVertex> sample = at_sample(c, focus, p);
    if (!sample) return false;
    p = mixed(*sample, p, factor);
  }
  c = std::move(changed);
  return true;
}

bool move_triangle(Case& c, const MoveFocus& focus, Draw& draw) {
  if (c.viewport.width == 0 || c.viewport.height == 0) return false;
  double du = factor_between(draw, kLeastPixels, kMostPixels - 1);
  if (draw.one_in(2)) du = -du;
  double dv = factor_between(draw, kLeastPixels, kMostPixels - 1);
  if (draw.one_in(2)) dv = -dv;
  for (const std::uint32_t vertex : triangle_in_focus(c, focus)) {
    ClipVertex& p = c.positions[vertex];
    p.x = to_float(double{p.x} + 2 * du / double{c.viewport.width} * double{p.w});
    p.y = to_float(double{p.y} + 2 * dv / double{c.viewport.height} * double{p.w});
  }
  return true;
}

bool turn_vertices(Case& c, const MoveFocus& focus, Draw& draw) {
  cases::Triangle& triangle = triangle_in_focus(c, focus);
  const int turn = draw.between(1, 2);
  std::rotate(triangle.begin(), triangle.begin() + turn, triangle.end());
  return true;
}

bool depth_to_plane(Case& c, const MoveFocus& focus, Draw& draw) {
  if (focus.attribute) return false;
  ClipVertex& p =
      c.positions[triangle_in_focus(c, focus)[static_cast<std::size_t>(any_corner(draw))]];
  p.z = draw.one_in(2) ? p.w : near_depth(c) * p.w;
  return true;
}

// ---- moves of values

bool towards_cancellation(Case& c, const MoveFocus& focus, Draw& draw) {
  const std::array<float*, 3> values = values_in_focus(c, focus);
  const auto shares = vertex_shares(c, focus);
  if (values[0] == nullptr || !shares) return false;
  const auto changed = static_cast<std::size_t>(any_corner(draw));
  // Solves Σ share_i r_i = 0 for one r_i.
  double rest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != changed) rest += (*shares)[i] * double{*values[i]};
  }
  if ((*shares)[changed] == 0 || rest == 0) return false;
  *values[changed] = to_float(-rest / (*shares)[changed]);
  return true;
}

bool towards_top_of_binade(Case& c, const MoveFocus& focus, Draw& draw) {
  const std::array<float*, 3> values = values_in_focus(c, focus);
  if (values[0] == nullptr) return false;
  // Errors are counted in ULP of the greatest value. Just below a power of two, an error that is a
  // share of the value is the most ULP.
  float& value = *values[static_cast<std::size_t>(any_corner(draw))];
  if (value == 0) return false;
  const int below = draw.between(1, 1 << kMostFloatsOfAll);
  const int exponent = std::ilogb(value);
  const double top = power_of_two(exponent + 1);
  value = std::copysign(stepped(to_float(top), -below), value);
  return true;
}

bool equal_magnitudes(Case& c, const MoveFocus& focus, Draw& draw) {
  const std::array<float*, 3> values = values_in_focus(c, focus);
  if (values[0] == nullptr) return false;
  const float greatest =
      std::max({std::fabs(*values[0]), std::fabs(*values[1]), std::fabs(*values[2])});
  if (greatest == 0) return false;
  for (float* const value : values) *value = draw.one_in(2) ? greatest : -greatest;
  return true;
}

bool scale_values_in_focus(Case& c, const MoveFocus& focus, Draw& draw) {
  const std::array<float*, 3> values = values_in_focus(c, focus);
  if (values[0] == nullptr) return false;
  const double factor = factor_between(draw, -1, 0);
  for (float* const value : values) *value = to_float(*value * factor);
  return true;
}

constexpr auto kMoves = std::to_array<CaseMove>({
    {"one number to a neighbouring float", &float_neighbour},
    {"all numbers to neighbouring floats", &all_neighbours},
    {"a number equal to another vertex's", &copy_number},
    {"positions scaled", &scale_positions},
    {"a vertex towards the horizon", &towards_horizon},
    {"a vertex towards a sliver", &towards_sliver},
    {"an edge through the sample", &edge_through_sample},
    {"a vertex onto the sample", &vertex_onto_sample},
    {"scaled about the sample", &about_sample},
    {"the triangle moved", &move_triangle},
    {"the vertices in another order", &turn_vertices},
    {"a depth onto a clip plane", &depth_to_plane},
    {"values towards cancellation", &towards_cancellation},
    {"a value to the top of its binade", &towards_top_of_binade},
    {"values of equal magnitude", &equal_magnitudes},
    {"values scaled", &scale_values_in_focus},
});

}  // namespace

std::span<const CaseMove> case_moves() { return kMoves; }

const CaseMove* find_move(std::string_view name) {
  const auto* const found = std::find_if(
      kMoves.begin(), kMoves.end(), [name](const CaseMove& move) { return move.name == name; });
  return found == kMoves.end() ? nullptr : found;
}

std::optional<std::array<double, 3>> vertex_shares(const Case& c, const MoveFocus& focus) {
  const oracle::SceneTruth scene(c, cases::contract_of(c));
  const oracle::TriangleTruth truth(scene, focus.at.triangle);
  const auto edges = truth.edges(static_cast<int>(focus.at.x), static_cast<int>(focus.at.y),
                                 static_cast<int>(focus.at.sample));
  if (!edges) return std::nullopt;
  const bool is_noperspective = focus.attribute && c.attributes[*focus.attribute].interpolation ==
                                                       cases::Interpolation::noperspective;
  std::array<double, 3> shares{};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double w = c.positions[c.triangles[focus.at.triangle][i]].w;
    shares[i] = (*edges)[i].nearest_double() * (is_noperspective ? w : 1);
    sum += shares[i];
  }
  if (sum == 0 || !std::isfinite(sum)) return std::nullopt;
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace rastercheck::properties
