// A shared edge covers each sample once: where two triangles meet at an edge, no sample is drawn by
// both, and none between them is left out. The APIs promise this (Vulkan: for polygons on either
// side of the edge). The law checks pairs that form a convex quadrilateral:
//
//        v3 ───── v2        A = (v0, v1, v2)   B = (v0, v2, v3)   the pair, shared edge v0 v2
//        │  B  ╱  │         C = (v0, v1, v3)   D = (v1, v2, v3)   the other diagonal
//        │  ╱  A  │
//        v0 ───── v1
//
// If all four have the same orientation, the quadrilateral is convex, and A ∪ B = C ∪ D. A backend
// that snaps may move the vertices, so all four must have that orientation wherever the contract
// lets the vertices be placed, and no vertex may be clipped, since clipping makes new vertices.
// Then, whatever the placement,
//
//   no sample is drawn by both A and B                           else it is `extra`, and
//   a sample required in C or in D is drawn by A or by B         else it is `missing`.
//
// Where the contract leaves the owner of a sample open (near the quadrilateral's outline, or on the
// diagonal between C and D), the sample is required neither in C nor in D, so it is not checked. If
// the contract names a tie rule, the rule gives the outline's samples the same answer in C and D as
// in A and B, because it depends only on the edge and its inside.
//
// Each triangle is drawn as if alone: the case's depth test is removed. Pairs with a user clip
// distance that is not positive at every vertex are left out: the distance is linear only in each
// triangle, so it would cut C and D along other lines than A and B.

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::shared_edge_covers_once_law {
namespace {

using records::FragmentClass;
using records::Verdict;

/// Two triangles that share an edge and traverse it in opposite directions.
struct TrianglePair {
  std::uint32_t first = 0;                 ///< index of A, the smaller
  std::uint32_t second = 0;                ///< index of B
  std::array<std::uint32_t, 4> corners{};  ///< v0 v1 v2 v3, indices of vertices
};

std::vector<TrianglePair> pairs_of(const cases::Case& c) {
  std::multimap<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>>
      opposite;  // edge → each triangle so far that has it, and its third vertex
  std::vector<TrianglePair> pairs;
  for (std::uint32_t t = 0; t < c.triangles.size(); ++t) {
    const cases::Triangle& triangle = c.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      // This triangle is B = (v0, v2, v3).
      const std::uint32_t v0 = triangle[i];
      const std::uint32_t v2 = triangle[(i + 1) % 3];
      const std::uint32_t v3 = triangle[(i + 2) % 3];
      const auto [begin, end] = opposite.equal_range({v2, v0});
      for (auto it = begin; it != end; ++it) {
        pairs.push_back({it->second.first, t, {v0, it->second.second, v2, v3}});
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      opposite.insert({{triangle[i], triangle[(i + 1) % 3]}, {t, triangle[(i + 2) % 3]}});
    }
  }
  return pairs;
}

/// The samples that a triangle drew, in ascending order.
using Samples = std::vector<std::array<std::uint32_t, 3>>;  // y, x, sample

std::vector<Samples> samples_by_triangle(const cases::Case& c, const cases::Fragments& drawn) {
  std::vector<Samples> by_triangle(c.triangles.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn.triangle[i] >= by_triangle.size()) continue;
    by_triangle[drawn.triangle[i]].push_back({drawn.y[i], drawn.x[i], drawn.sample[i]});
  }
  for (Samples& samples : by_triangle) std::sort(samples.begin(), samples.end());
  return by_triangle;
}

class SharedEdgeCheck {
 public:
  SharedEdgeCheck(const cases::Case& c, cases::Contract contract, const cases::Fragments& drawn)
      : case_(&c),
        contract_(std::move(contract)),
        samples_(samples_by_triangle(c, drawn)),
        state_(c),
        tally_(c) {
    contract_.triangles.clear();  // the oracle is asked about other triangles
    state_.attributes.clear();
    state_.attribute_values.clear();
    state_.clip_distances.clear();
    state_.clip_distance_count = 0;
    state_.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}};
  }

  Check run() {
    for (const TrianglePair& pair : pairs_of(*case_)) check_pair(pair);
    return has_pairs_ ? tally_.finish()
                      : not_applicable(
                            "no two triangles with a common edge certainly lie side by side "
                            "without being clipped");
  }

 private:
  bool has_positive_distances(const TrianglePair& pair) const {
    return std::all_of(pair.corners.begin(), pair.corners.end(), [this](std::uint32_t vertex) {
      const auto distances = case_->clip_distances_of(vertex);
      return std::all_of(distances.begin(), distances.end(), [](float d) { return d > 0; });
    });
  }

  void check_pair(const TrianglePair& pair) {
    if (!has_positive_distances(pair)) return;
    cases::Case quad = state_;
    quad.positions.clear();
    for (const std::uint32_t vertex : pair.corners) {
      quad.positions.push_back(case_->positions[vertex]);
    }
    const oracle::SceneTruth scene(quad, contract_);
    const oracle::TriangleTruth a(scene, 0);
    const oracle::TriangleTruth b(scene, 1);
    const oracle::TriangleTruth c(scene, 2);
    const oracle::TriangleTruth d(scene, 3);
    for (const oracle::TriangleTruth* truth : {&a, &b, &c, &d}) {
      if (!truth->has_certain_orientation() || truth->orientation() != a.orientation()) return;
    }

    has_pairs_ = true;
    const auto& corners = quad.positions;
    if (corners[0].w != corners[1].w || corners[0].w != corners[2].w ||
        corners[0].w != corners[3].w) {
      tally_.label("different w");
    }
    find_doubles(pair, a);
    find_gaps(pair, a, c, d);
  }

  /// Reports samples drawn by both triangles.
  void find_doubles(const TrianglePair& pair, const oracle::TriangleTruth& a) {
    Samples both;
    std::set_intersection(samples_[pair.first].begin(), samples_[pair.first].end(),
                          samples_[pair.second].begin(), samples_[pair.second].end(),
                          std::back_inserter(both));
    for (const auto& sample : both) report(pair, sample, FragmentClass::extra, a);
  }

  /// Reports samples inside the quadrilateral that are drawn by neither triangle.
  void find_gaps(const TrianglePair& pair, const oracle::TriangleTruth& a,
                 const oracle::TriangleTruth& c, const oracle::TriangleTruth& d) {
    const oracle::PixelBox of_c = c.pixels();
    const oracle::PixelBox of_d = d.pixels();
    const oracle::PixelBox pixels{std::min(of_c.x0, of_d.x0), std::min(of_c.y0, of_d.y0),
                                  std::max(of_c.x1, of_d.x1), std::max(of_c.y1, of_d.y1)};
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      for (int x = pixels.x0; x < pixels.x1; ++x) {
        for (int s = 0; s < case_->framebuffer.samples; ++s) {
          if (c.judge(x, y, s).verdict != Verdict::required &&
              d.judge(x, y, s).verdict != Verdict::required) {
            continue;
          }
          see_required(pair,
                       {static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x),
                        static_cast<std::uint32_t>(s)},
                       a);
        }
      }
    }
  }

  void see_required(const TrianglePair& pair, const std::array<std::uint32_t, 3>& sample,
                    const oracle::TriangleTruth& a) {
    ++tally_.counts().required;
    const bool by_first =
        std::binary_search(samples_[pair.first].begin(), samples_[pair.first].end(), sample);
    const bool by_second =
        std::binary_search(samples_[pair.second].begin(), samples_[pair.second].end(), sample);
    if (!by_first && !by_second) return report(pair, sample, FragmentClass::missing, a);
    tally_.see(by_first ? pair.first : pair.second);
    if (by_first != by_second) tally_.pass(records::AttributeKind::coverage);

    // Labels how close to the shared edge the sample was.
    const auto [y, x, s] = sample;
    const records::SampleVerdict decision =
        a.judge(static_cast<int>(x), static_cast<int>(y), static_cast<int>(s));
    if (decision.verdict == Verdict::permitted) tally_.label("permitted");
    if (decision.reason == records::Reason::tie || decision.reason == records::Reason::snapping) {
      tally_.label(records::to_string(decision.reason));
    }
  }

  void report(const TrianglePair& pair, const std::array<std::uint32_t, 3>& sample,
              FragmentClass fragment_class, const oracle::TriangleTruth& a) {
    const auto [y, x, s] = sample;
    const bool is_missing = fragment_class == FragmentClass::missing;
    const std::string first = std::to_string(pair.first);
    const std::string second = std::to_string(pair.second);
    const std::string who = is_missing
                                ? "neither triangle " + first + " nor " + second + " draws it"
                                : "triangle " + first + " draws it as well";
    records::Violation violation =
        violation_at({is_missing ? pair.first : pair.second, y, x, s}, fragment_class,
                     is_missing ? "required: one of the two triangles must cover it"
                                : "forbidden: only one of the two triangles may cover it",
                     who + "; they share the edge of vertices " + std::to_string(pair.corners[0]) +
                         " and " + std::to_string(pair.corners[2]));
    violation.distance = a.distance(static_cast<int>(x), static_cast<int>(y), static_cast<int>(s));
    tally_.report(violation);
  }

  const cases::Case* case_;
  cases::Contract contract_;
  std::vector<Samples> samples_;  ///< [triangle]
  cases::Case state_;             ///< the case without its vertices
  bool has_pairs_ = false;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  clip.depth_test = cases::DepthTest::none;
  const Result<backends::Drawn> drawn = draw_promised(clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  return SharedEdgeCheck(clip, drawn->contract, drawn->fragments).run();
}

// --- the law's own cases: quadrilaterals, strips, meshes and fans -------------------------------

/// How the vertices of a case get their weights.
enum class LayoutWeights { equal, powers_of_two, free };

/// Maps a mesh's own coordinates to the screen.
struct Layout {
  WindowPoint origin;
  WindowPoint right;  ///< pixels per cell
  WindowPoint down;
  bool is_on_grid = false;
  LayoutWeights weights = LayoutWeights::equal;

  WindowPoint at(double s, double t) const {
    return {origin.u + s * right.u + t * down.u, origin.v + s * right.v + t * down.v};
  }
};

Layout random_layout(Draw& draw, const cases::Case& c, bool is_on_grid) {
  Layout layout;
  layout.is_on_grid = is_on_grid;
  if (is_on_grid) {
    layout.origin = visible_sample(draw, c);
    const int width = draw.between(1, 10);
    const int height = draw.one_in(2) ? width : draw.between(1, 10);
    const int slant = draw.one_in(2) ? 0 : draw.between(-2, 2);
    const double unit = draw.pick(std::array{1.0, 1.0, 0.5, 0.25});
    layout.right = {unit * width, unit * slant};
    layout.down = {-unit * slant, unit * height};
    layout.weights = draw.pick(std::array{LayoutWeights::equal, LayoutWeights::powers_of_two});
    return layout;
  }
  // Turned by a rational rotation: (1 − t²)/(1 + t²) and 2t/(1 + t²) are cosine and sine.
  layout.origin = visible_point(draw, c);
  const double t = double{draw.uniform(-1, 1)};
  const double cosine = (1 - t * t) / (1 + t * t);
  const double sine = 2 * t / (1 + t * t);
  const double width = draw.one_in(4) ? 0.3 : double{draw.uniform(1, 12)};
  const double height = draw.one_in(2) ? width : double{draw.uniform(0.25F, 12)};
  layout.right = {width * cosine, width * sine};
  layout.down = {-height * sine, height * cosine};
  layout.weights =
      draw.pick(std::array{LayoutWeights::equal, LayoutWeights::free, LayoutWeights::free});
  return layout;
}

std::uint32_t add_laid_out(Draw& draw, cases::Case& c, const Layout& layout, double s, double t) {
  const float depth = draw.uniform(0.0625F, 0.9375F);
  float w = 1;
  if (layout.weights == LayoutWeights::powers_of_two) {
    w = draw.pick(std::array{0.25F, 0.5F, 1.0F, 2.0F, 4.0F});
  } else if (layout.weights == LayoutWeights::free) {
    w = draw.uniform(0.1F, 4);
  }
  return add_vertex(c, at_window(c, layout.at(s, t), depth, w));
}

/// Adds a triangle, starting with a random vertex.
void add_turned(Draw& draw, cases::Case& c, cases::Triangle triangle) {
  const int turns = draw.between(0, 2);
  std::rotate(triangle.begin(), triangle.begin() + turns, triangle.end());
  c.triangles.push_back(triangle);
}

/// Adds cells in rows and columns, each cut along a diagonal. Off the grid, vertices are moved, but
/// cells stay convex.
void add_mesh(Draw& draw, cases::Case& c, const Layout& layout) {
  const int columns = draw.between(1, 1 + draw.size() / 34);
  const int rows = draw.between(1, 1 + draw.size() / 50);
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  for (int t = 0; t <= rows; ++t) {
    for (int s = 0; s <= columns; ++s) {
      double moved_s = s - columns / 2.0;
      double moved_t = t - rows / 2.0;
      if (!layout.is_on_grid) {
        moved_s += double{draw.uniform(-0.2F, 0.2F)};
        moved_t += double{draw.uniform(-0.2F, 0.2F)};
      }
      add_laid_out(draw, c, layout, moved_s, moved_t);
    }
  }
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  const bool is_mirrored = draw.one_in(2);
  for (std::uint32_t t = 0; std::cmp_less(t, rows); ++t) {
    for (std::uint32_t s = 0; std::cmp_less(s, columns); ++s) {
      std::array<std::uint32_t, 4> cell{first + t * stride + s, first + t * stride + s + 1,
                                        first + (t + 1) * stride + s + 1,
                                        first + (t + 1) * stride + s};
      if (is_mirrored) std::reverse(cell.begin(), cell.end());
      if (draw.one_in(2)) std::rotate(cell.begin(), cell.begin() + 1, cell.end());
      add_turned(draw, c, {cell[0], cell[1], cell[2]});
      add_turned(draw, c, {cell[0], cell[2], cell[3]});
    }
  }
}

/// Adds triangles around a hub. The ring is round enough that neighbours form convex
/// quadrilaterals.
void add_fan(Draw& draw, cases::Case& c, const Layout& layout) {
  constexpr std::array<WindowPoint, 8> kRing{WindowPoint{4, 0},  {3, 3},   {0, 4},  {-3, 3},
                                             WindowPoint{-4, 0}, {-3, -3}, {0, -4}, {3, -3}};
  const double scale = layout.is_on_grid ? 1.0 : 0.25;
  const std::uint32_t hub = add_laid_out(draw, c, layout, 0, 0);
  for (const WindowPoint& p : kRing) add_laid_out(draw, c, layout, scale * p.u, scale * p.v);
  for (std::uint32_t i = 0; i < 8; ++i) {
    add_turned(draw, c, {hub, hub + 1 + i, hub + 1 + (i + 1) % 8});
  }
}

/// Adds a quadrilateral whose shared edge runs exactly through a sample and whose other diagonal
/// runs through a point nearby. Weights are not powers of two.
void add_quad_through_sample(Draw& draw, cases::Case& c) {
  const WindowPoint sample = visible_sample(draw, c);
  const int du = draw.between(-3, 3);
  const int dv = draw.between(-3, 3);
  const float depth = draw.pick(std::array{0.25F, 0.5F, 0.75F});
  const auto shared = edge_through(draw, c, sample, depth);
  const auto other = edge_through(draw, c, {sample.u + du, sample.v + dv}, depth);
  const std::uint32_t v0 = add_vertex(c, shared[0]);
  const std::uint32_t v1 = add_vertex(c, other[0]);
  const std::uint32_t v2 = add_vertex(c, shared[1]);
  const std::uint32_t v3 = add_vertex(c, other[1]);
  add_turned(draw, c, {v0, v1, v2});
  add_turned(draw, c, {v0, v2, v3});
}

Generated generate(Draw& draw) {
  const bool is_on_grid = draw.one_in(2);
  StateRequest request;
  request.is_on_grid = is_on_grid;
  request.has_clip_distances = false;
  request.most_side = 48;
  Generated made;
  cases::Case& c = made.source;
  c = random_state(draw, request);
  c.depth_test = cases::DepthTest::none;
  if (!draw.one_in(4)) c.cull = cases::Cull::none;
  const int kind = draw.between(0, is_on_grid ? 5 : 3);
  const int shapes = draw.between(1, 3);
  for (int i = 0; i < shapes; ++i) {
    if (kind > 3) {
      add_quad_through_sample(draw, c);
      continue;
    }
    const Layout layout = random_layout(draw, c, is_on_grid);
    if (kind == 3) {
      add_fan(draw, c, layout);
    } else {
      add_mesh(draw, c, layout);
    }
  }
  add_attribute_values(draw, c);
  if (kind > 3) {
    made.stratum = "quads through samples";
  } else {
    made.stratum =
        std::string(kind == 3 ? "fans" : "meshes") + (is_on_grid ? " on grid" : " off grid");
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "a-shared-edge-covers-each-sample-once",
     .sentence = "a shared edge covers each sample once",
     .reason = "The two sides of an edge are the same numbers with opposite signs, and a zero is "
               "inside of one of them (RULES §2).",
     .exceptions =
         "pairs that form no convex quadrilateral however they are placed, and clipped ones",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_all_parts_once,
     .unpromised = "the backend does not promise that parts cover, once, what the whole covers",
     .needs_samples = true,
     .covers = {cover(40, "different w"), cover(16, "several samples"), cover_decided(16, "tie")}});

}  // namespace
}  // namespace rastercheck::properties::shared_edge_covers_once_law
