// A triangulation of the screen covers each sample once: if triangles with common edges fill an
// outline around the whole viewport, exactly one of them draws each sample of the viewport,
// wherever their vertices lie: on samples, beyond the screen, with any w > 0. If one plane cuts all
// triangles, the same holds on the plane's inner side, and no sample is drawn on the other side.
//
// Why. Let p be a point of the window, all w > 0 and all triangles of one orientation. A triangle
// winds once around p if it covers p, and otherwise not at all. An edge that two triangles traverse
// in opposite directions adds nothing to the sum of windings. So the number of triangles that cover
// p is the outline's winding number around p; the outline is the edges that only one triangle has.
// The number is the same all over the viewport if no edge of the outline meets the viewport. The
// law requires both ends of each outline edge to lie beyond the same side of the viewport. It
// counts the turns around the viewport's middle by the edges that cross the ray from the middle to
// the right: both ends have x > w, and y changes its sign.
//
// Ties. If E(p) = 0, inside is A > 0, or A = 0 and σ B > 0 (RULES §2). That is the same as E > 0 at
// p + (ε, σ ε²) for small ε, which is a point on no edge. So ties are covered once as well, even at
// a vertex that many triangles share.
//
// A plane. A clip distance d_i = ±x_i or ±y_i at all vertices interpolates to ±x/w or ±y/w in every
// triangle, so its inside is one half of the viewport. The same holds for z_i = ±x_i or ±y_i:
// inside is −1 <= z/w <= 1 (OpenGL), which is the whole viewport, or 0 <= z/w, which is one half.
// On the line where a clip distance is 0, a sample is drawn at most once, as the distance's own
// normal decides. Nothing is rounded: the case's numbers are only compared.
//
// Snapping moves a vertex alike for all its triangles, but may flip thin triangles, and clipping
// makes new vertices in each triangle: such cases are left out. A contract may name no tie rule, or
// keep no grid, so that each edge may be off a little independently. Two adjacent triangles then
// still share their edge, but three around a vertex need not agree, so samples that more than two
// triangles may cover are left out. All other samples are decided without the oracle, which is
// asked only about samples that are not drawn once. Samples on the viewport's far border may be
// drawn or not (§2) and are not checked.
//
// Culling, a depth test and attributes do not matter, and are removed.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "properties/exact_sum.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/triangulations.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::triangulation_covers_once_law {
namespace {

using cases::ClipVertex;
using records::FragmentClass;
using records::Verdict;

/// The half of the viewport that is drawn: sign · n >= 0, where n is x/w or y/w.
struct HalfPlane {
  bool is_along_x = false;
  int sign = 1;
  bool is_closed = false;  ///< true if samples on its line are certainly drawn
};

/// Returns the half-plane if `number` is ±x or ±y at all vertices; else nothing.
template <typename Number>
std::optional<HalfPlane> half_plane_of(const cases::Case& c, const Number& number) {
  for (const bool is_along_x : {true, false}) {
    for (const int sign : {1, -1}) {
      bool holds = true;
      for (std::size_t v = 0; v < c.positions.size(); ++v) {
        const ClipVertex& p = c.positions[v];
        const float n = is_along_x ? p.x : p.y;
        holds = holds && number(v) == static_cast<float>(sign) * n;
      }
      if (holds) return HalfPlane{is_along_x, sign, false};
    }
  }
  return std::nullopt;
}

/// Returns the planes that cut all triangles alike; nothing if anything else may clip.
std::optional<std::vector<HalfPlane>> half_planes_of(const cases::Case& c) {
  std::vector<HalfPlane> planes;
  const float near = near_depth(c);
  const bool has_depths = c.depth_clamp || std::all_of(c.positions.begin(), c.positions.end(),
                                                       [near](const ClipVertex& p) {
                                                         return p.z >= near * p.w && p.z <= p.w;
                                                       });
  if (!has_depths) {
    auto plane = half_plane_of(c, [&c](std::size_t v) { return c.positions[v].z; });
    if (!plane) return std::nullopt;
    plane->is_closed = true;
    // −1 <= z/w <= 1 is the whole viewport.
    if (c.rules != cases::Rules::opengl) planes.push_back(*plane);
  }
  for (std::size_t d = 0; d < c.clip_distance_count; ++d) {
    const auto distance = [&c, d](std::size_t v) { return c.clip_distances_of(v)[d]; };
    bool keeps_all = true;
    for (std::size_t v = 0; v < c.positions.size(); ++v) keeps_all = keeps_all && distance(v) > 0;
    if (keeps_all) continue;
    const auto plane = half_plane_of(c, distance);
    if (!plane) return std::nullopt;
    planes.push_back(*plane);
  }
  return planes;
}

/// How often a sample must be drawn.
enum class Times { none, once, at_most_once, any };

/// The viewport and the half-planes that cut it, without rounding.
class Screen {
 public:
  /// `error`: how far the viewport's sides may be off, in pixels.
  static std::optional<Screen> of(const cases::Case& c, std::vector<HalfPlane> planes,
                                  const cases::Contract& contract) {
    Screen screen(c, std::move(planes), contract);
    screen.error_ = contract.has_open_viewport() ? contract.viewport_error : 0;
    const cases::Viewport& v = c.viewport;
    const std::array begins{double{v.x}, double{v.y}};
    const std::array sizes{double{v.width}, double{v.height}};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto end = exact_sum(begins[axis], sizes[axis]);
      if (!end || sizes[axis] == 0) return std::nullopt;
      const auto twice_middle = exact_sum(begins[axis], *end);
      if (!twice_middle) return std::nullopt;
      screen.low_[axis] = std::min(begins[axis], *end);
      screen.high_[axis] = std::max(begins[axis], *end);
      screen.twice_middle_[axis] = *twice_middle;
      screen.turn_[axis] = sizes[axis] < 0 ? -1 : 1;
    }
    if (c.rules == cases::Rules::d3d) screen.turn_[1] = -screen.turn_[1];
    return screen;
  }

  Times times(int x, int y, int sample) const {
    const WindowPoint& at = pattern_[static_cast<std::size_t>(sample)];
    const std::array position{x + at.u, y + at.v};
    if (!is_in_scissor(x, y)) return Times::none;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double past_low = position[axis] - low_[axis];
      const double before_high = high_[axis] - position[axis];
      if (past_low < -kUp * error_ || before_high < -kUp * error_) return Times::none;
      if (before_high == 0 || is_open(past_low) || is_open(before_high)) return Times::any;
    }
    Times result = Times::once;
    for (const HalfPlane& plane : planes_) {
      const std::size_t axis = plane.is_along_x ? 0 : 1;
      const double twice = 2 * position[axis];  // a comparison is exact, a difference need not be
      if (is_open((twice - twice_middle_[axis]) / 2)) return Times::any;
      const int side = (twice > twice_middle_[axis]) - (twice < twice_middle_[axis]);
      const int inside = side * turn_[axis] * plane.sign;
      if (inside < 0) return Times::none;
      if (inside == 0 && !plane.is_closed) result = Times::at_most_once;
    }
    return result;
  }

 private:
  Screen(const cases::Case& c, std::vector<HalfPlane> planes, const cases::Contract& contract)
      : planes_(std::move(planes)), pattern_(sample_points(c, contract)), scissor_(c.scissor) {}

  bool is_in_scissor(int x, int y) const {
    if (!scissor_) return true;
    const auto holds = [](std::int64_t begin, std::int64_t size, int at) {
      return at >= begin && at < begin + size;
    };
    return holds(scissor_->x, scissor_->width, x) && holds(scissor_->y, scissor_->height, y);
  }

  /// Allows for more than a few roundings of doubles.
  static constexpr double kUp = 1 + 0x1p-40;
  /// True if a line at that distance may lie on either side of the sample.
  bool is_open(double distance) const { return error_ > 0 && std::fabs(distance) <= kUp * error_; }

  std::vector<HalfPlane> planes_;
  std::vector<WindowPoint> pattern_;
  std::optional<cases::Scissor> scissor_;
  double error_ = 0;
  std::array<double, 2> low_{};
  std::array<double, 2> high_{};
  std::array<double, 2> twice_middle_{};
  std::array<int, 2> turn_{};
};

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Returns the edges that no other triangle traverses in the opposite direction; nothing if an edge
/// occurs twice in one direction.
std::optional<std::vector<Edge>> outline_of(const cases::Case& c) {
  std::set<Edge> edges;
  for (const cases::Triangle& triangle : c.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!edges.insert({triangle[i], triangle[(i + 1) % 3]}).second) return std::nullopt;
    }
  }
  std::vector<Edge> outline;
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from})) outline.emplace_back(from, to);
  }
  return outline;
}

/// Tells if the outline runs around the viewport once without meeting it, even if the ends of edges
/// move by up to `reach` pixels. An end counts as beyond a side if it is more than twice `reach`
/// away from the side. The second `reach` far exceeds the rounding errors in double.
class AreaOutline {
 public:
  AreaOutline(const cases::Case& c, double reach) : case_(&c) {
    margin_x_ = 4 * reach / std::abs(double{c.viewport.width});
    margin_y_ = 4 * reach / std::abs(double{c.viewport.height});
  }

  bool runs_around_once(const std::vector<Edge>& edges) const {
    int turns = 0;
    for (const auto& [from, to] : edges) {
      const ClipVertex& p = case_->positions[from];
      const ClipVertex& q = case_->positions[to];
      const bool is_right = is_beyond(p.x, p.w, margin_x_) && is_beyond(q.x, q.w, margin_x_);
      const bool is_beside = is_right ||
                             (is_beyond(-p.x, p.w, margin_x_) && is_beyond(-q.x, q.w, margin_x_)) ||
                             (is_beyond(p.y, p.w, margin_y_) && is_beyond(q.y, q.w, margin_y_)) ||
                             (is_beyond(-p.y, p.w, margin_y_) && is_beyond(-q.y, q.w, margin_y_));
      if (!is_beside) return false;
      if (is_right) turns += (q.y > 0 ? 1 : 0) - (p.y > 0 ? 1 : 0);
    }
    return turns == 1 || turns == -1;
  }

 private:
  /// n/w > 1 + margin; exact if the margin is 0.
  static bool is_beyond(float n, float w, double margin) {
    return double{n} > double{w} && (margin == 0 || double{n} > double{w} * (1 + margin));
  }

  const cases::Case* case_;
  double margin_x_ = 0;
  double margin_y_ = 0;
};

/// True if the case is a triangulation that the law can check under this contract.
bool is_triangulation(const cases::Case& c, const cases::Contract& contract, Verdicts& verdicts) {
  const bool all_in_front = std::all_of(c.positions.begin(), c.positions.end(),
                                        [](const ClipVertex& p) { return p.w > 0; });
  const auto edges = outline_of(c);
  if (!all_in_front || !edges || c.triangles.empty()) return false;
  double reach = contract.coverage ? placement_reach(*contract.coverage) : 0;
  if (contract.has_open_viewport()) {
    // In a smaller viewport, `reach` is a larger part of the screen.
    reach *= cases::most_growth(c.viewport, contract.viewport_error);
  }
  if (!AreaOutline(c, reach).runs_around_once(*edges)) return false;
  const int orientation = verdicts.truth(0).orientation();
  for (std::uint32_t t = 0; t < c.triangles.size(); ++t) {
    const oracle::TriangleTruth& truth = verdicts.truth(t);
    if (truth.orientation() == 0 || truth.orientation() != orientation) return false;
    if (contract.coverage && !truth.has_certain_orientation()) return false;
  }
  return true;
}

class CoveredOnce {
 public:
  CoveredOnce(const cases::Case& c, const cases::Contract& contract, const Screen& screen,
              Verdicts& verdicts)
      : case_(&c), contract_(contract), screen_(&screen), verdicts_(&verdicts), tally_(c) {}

  Check run(const cases::Fragments& drawn) {
    const cases::FramebufferSize& size = case_->framebuffer;
    const auto samples = static_cast<std::size_t>(size.samples);
    std::vector<std::uint8_t> times(static_cast<std::size_t>(size.width) *
                                    static_cast<std::size_t>(size.height) * samples);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const cases::SamplePlace place = drawn.place_of(i);
      if (!is_of_case(*case_, place)) {
        report(place, FragmentClass::extra, "forbidden: no such triangle, pixel or sample");
        continue;
      }
      std::uint8_t& of_sample = times[index_of(place)];
      of_sample = static_cast<std::uint8_t>(std::min(of_sample + 1, 3));
      if (of_sample == 2) see(place, 2);
      tally_.see(place.triangle);
    }
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        for (int s = 0; s < size.samples; ++s) {
          const cases::SamplePlace place{0, static_cast<std::uint32_t>(y),
                                         static_cast<std::uint32_t>(x),
                                         static_cast<std::uint32_t>(s)};
          if (times[index_of(place)] < 2) see(place, times[index_of(place)]);
        }
      }
    }
    return tally_.finish();
  }

 private:
  std::size_t index_of(const cases::SamplePlace& place) const {
    const auto width = static_cast<std::size_t>(case_->framebuffer.width);
    const auto samples = static_cast<std::size_t>(case_->framebuffer.samples);
    return (place.y * width + place.x) * samples + place.sample;
  }

  void see(const cases::SamplePlace& place, int drawn) {
    const Times wanted = screen_->times(static_cast<int>(place.x), static_cast<int>(place.y),
                                        static_cast<int>(place.sample));
    if (wanted == Times::any) return;
    if (wanted == Times::once) ++tally_.counts().required;
    if (wanted == Times::at_most_once) tally_.label("sample on the plane");
    const bool is_right = wanted == Times::once           ? drawn == 1
                          : wanted == Times::at_most_once ? drawn < 2
                                                          : drawn == 0;
    if (is_right) {
      if (drawn == 1) tally_.pass(records::AttributeKind::coverage);
      return;
    }
    if (wanted != Times::none && is_open(place, wanted)) {
      ++tally_.counts().permitted;
      return;
    }
    if (drawn == 0) {
      report(first_covering(place), FragmentClass::missing, "required: one triangle must cover it");
    } else {
      report(place, FragmentClass::extra,
             wanted == Times::none ? "forbidden: beyond the plane or the viewport"
                                   : "forbidden: only one triangle may cover it");
    }
  }

  /// True if the contract lets three triangles decide independently of each other.
  bool is_open(const cases::SamplePlace& place, Times wanted) {
    const bool is_strict = contract_.has_one_owner_of_ties() && contract_.is_on_grid;
    if (is_strict) return false;
    if (wanted == Times::at_most_once) return true;
    int possible = 0;
    for (std::uint32_t t = 0; t < case_->triangles.size(); ++t) {
      possible += verdicts_->judge(t, place).verdict != Verdict::forbidden ? 1 : 0;
    }
    return possible > 2;
  }

  /// The place with the first triangle that may cover it.
  cases::SamplePlace first_covering(cases::SamplePlace place) {
    for (std::uint32_t t = 0; t < case_->triangles.size(); ++t) {
      place.triangle = t;
      if (verdicts_->judge(t, place).verdict != Verdict::forbidden) return place;
    }
    place.triangle = 0;
    return place;
  }

  void report(const cases::SamplePlace& place, FragmentClass fragment_class,
              const std::string& exact) {
    tally_.report(violation_at(place, fragment_class, exact, "in a triangulation of the screen"));
  }

  const cases::Case* case_;
  cases::Contract contract_;
  const Screen* screen_;
  Verdicts* verdicts_;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  clip.depth_test = cases::DepthTest::none;
  clip.cull = cases::Cull::none;
  clip.attributes.clear();
  clip.attribute_values.clear();
  const cases::Contract contract = backend.contract(clip);
  Verdicts verdicts(clip, contract);
  const auto planes = half_planes_of(clip);
  const auto screen = planes ? Screen::of(clip, *planes, contract) : std::nullopt;
  if (!screen || !is_triangulation(clip, contract, verdicts)) {
    return not_applicable(
        "the case is not a triangulation of the screen that cannot be clipped or turned over");
  }
  const Result<backends::Drawn> drawn = draw_promised(clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  Check found = CoveredOnce(clip, contract, *screen, verdicts).run(drawn->fragments);
  if (!planes->empty()) add_label(found, "half of the screen");
  if (clip.clip_distance_count > 0) add_label(found, "clip distances");
  if (contract.coverage) add_label(found, "snapped");
  return found;
}

const LawRegistration kRegistration(
    {.id = "a-triangulation-of-the-screen-covers-each-sample-once",
     .sentence = "a triangulation of the screen covers each sample once",
     .reason = "Triangles of one orientation cover a point as often as their outline runs around "
               "it, and a tie is decided as for a point next to it.",
     .exceptions = "snapped triangles that are clipped or may turn round; where no tie rule is "
                   "named, samples that more than two may cover; the far border of the viewport",
     .generate = &triangulated_screen,
     .check = &check,
     .is_promised = &draws_all_parts_once,
     .unpromised = "the backend does not promise that parts cover, once, what the whole covers",
     .needs_samples = true,
     .covers = {cover(8, "clip distances"), cover_decided(6, "half of the screen"),
                cover(15, "several samples"), cover_decided(11, "snapped")}});

}  // namespace
}  // namespace rastercheck::properties::triangulation_covers_once_law
