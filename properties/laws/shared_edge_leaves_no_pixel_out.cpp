// A shared edge leaves no touched pixel out: where outer coverage (cases::Conservative) draws two
// triangles that meet at an edge, each pixel that their union touches is drawn by one of them.
// The law checks pairs that form a convex quadrilateral, as a-shared-edge-covers-each-sample-once
// does:
//
//        v3 ───── v2        A = (v0, v1, v2)   B = (v0, v2, v3)   the pair, shared edge v0 v2
//        │  B  ╱  │         C = (v0, v1, v3)   D = (v1, v2, v3)   the other diagonal
//        │  ╱  A  │
//        v0 ───── v1
//
// If all four have the same orientation wherever the contract lets vertices be placed, and none is
// clipped, A ∪ B = C ∪ D. What a pixel's grown square has in common with C ∪ D has an area, and so
// has its part in A or in B. So a pixel that C or D must cover is drawn by A or by B, else it is
// `missing`. Unlike samples, pixels along the edge are drawn by both.
//
// Each triangle is drawn as if alone: the case's depth test is removed. Pairs with a user clip
// distance that is not positive at every vertex are left out, because it would cut C and D along
// other lines than A and B.

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties::shared_edge_leaves_no_pixel_out_law {
namespace {

using records::FragmentClass;
using records::Verdict;

/// Two triangles that share an edge and traverse it in opposite directions.
struct Neighbors {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::array<std::uint32_t, 4> corners{};  ///< v0 v1 v2 v3, indices of vertices
};

std::vector<Neighbors> neighbors_in(const cases::Case& c) {
  struct Side {
    std::uint32_t triangle = 0;
    std::uint32_t apex = 0;
  };
  std::multimap<std::pair<std::uint32_t, std::uint32_t>, Side> sides;  // by edge
  for (std::uint32_t t = 0; t < c.triangles.size(); ++t) {
    const cases::Triangle& v = c.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) sides.insert({{v[i], v[(i + 1) % 3]}, {t, v[(i + 2) % 3]}});
  }
  std::vector<Neighbors> all;
  for (const auto& [edge, of_a] : sides) {
    // A traverses the edge from v2 to v0, B from v0 to v2.
    const auto [begin, end] = sides.equal_range({edge.second, edge.first});
    for (auto of_b = begin; of_b != end; ++of_b) {
      if (of_a.triangle >= of_b->second.triangle) continue;
      all.push_back({of_a.triangle,
                     of_b->second.triangle,
                     {edge.second, of_a.apex, edge.first, of_b->second.apex}});
    }
  }
  return all;
}

class GapSearch {
 public:
  GapSearch(const cases::Case& c, cases::Contract contract, const cases::Fragments& drawn)
      : case_(&c), contract_(std::move(contract)), state_(c), tally_(c) {
    contract_.triangles.clear();  // the oracle is asked about other triangles
    state_.attributes.clear();
    state_.attribute_values.clear();
    state_.clip_distances.clear();
    state_.clip_distance_count = 0;
    state_.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}};
    for (std::size_t i = 0; i < drawn.size(); ++i) drawn_.insert(drawn.place_of(i));
  }

  Check run() {
    for (const Neighbors& pair : neighbors_in(*case_)) check_pair(pair);
    return has_pairs_ ? tally_.finish()
                      : not_applicable(
                            "no two triangles with a common edge certainly lie side by side "
                            "without being clipped");
  }

 private:
  void check_pair(const Neighbors& pair) {
    cases::Case quad = state_;
    quad.positions.clear();
    for (const std::uint32_t vertex : pair.corners) {
      const auto distances = case_->clip_distances_of(vertex);
      if (!std::all_of(distances.begin(), distances.end(), [](float d) { return d > 0; })) return;
      quad.positions.push_back(case_->positions[vertex]);
    }
    const oracle::SceneTruth scene(quad, contract_);
    const oracle::TriangleTruth a(scene, 0);
    for (std::size_t t = 0; t < 4; ++t) {
      const oracle::TriangleTruth truth(scene, t);
      if (!truth.has_certain_orientation() || truth.orientation() != a.orientation()) return;
    }
    has_pairs_ = true;
    for (const std::size_t t : {std::size_t{2}, std::size_t{3}})
      check_pixels(pair, oracle::TriangleTruth(scene, t));
  }

  void check_pixels(const Neighbors& pair, const oracle::TriangleTruth& half) {
    const oracle::PixelBox box = half.pixels();
    for (int y = box.y0; y < box.y1; ++y) {
      for (int x = box.x0; x < box.x1; ++x) {
        if (half.judge(x, y, 0).verdict == Verdict::required) {
          see_required(pair, static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x));
        }
      }
    }
  }

  void see_required(const Neighbors& pair, std::uint32_t y, std::uint32_t x) {
    ++tally_.counts().required;
    const bool by_first = drawn_.contains({pair.first, y, x, 0});
    const bool by_second = drawn_.contains({pair.second, y, x, 0});
    if (by_first && by_second) tally_.label("drawn by both");
    if (by_first || by_second) {
      tally_.see(by_first ? pair.first : pair.second);
      tally_.pass(records::AttributeKind::coverage);
      return;
    }
    const cases::SamplePlace place{pair.first, y, x, 0};
    if (!reported_.insert(place).second) return;
    tally_.report(violation_at(
        place, FragmentClass::missing, "required: one of the two triangles must cover the pixel",
        "neither triangle " + std::to_string(pair.first) + " nor " + std::to_string(pair.second) +
            " draws it; they share the edge of vertices " + std::to_string(pair.corners[0]) +
            " and " + std::to_string(pair.corners[2])));
  }

  const cases::Case* case_;
  cases::Contract contract_;
  std::set<cases::SamplePlace> drawn_;
  std::set<cases::SamplePlace> reported_;
  cases::Case state_;  ///< the case without its vertices
  bool has_pairs_ = false;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!covers_touched_pixels(backend)) return not_applicable();
  cases::ClipCase clip = c;
  clip.depth_test = cases::DepthTest::none;
  const Result<backends::Drawn> drawn = draw_promised(clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  return GapSearch(clip, drawn->contract, drawn->fragments).run();
}

/// The cases of the law about samples have pairs of all kinds.
Generated generate(Draw& draw) {
  return find_law("a-shared-edge-covers-each-sample-once")->generate(draw);
}

const LawRegistration kRegistration(
    {.id = "a-shared-edge-leaves-no-touched-pixel-out",
     .sentence = "a shared edge leaves no touched pixel out",
     .reason = "What a pixel has in common with two triangles lies in one of them or in the other "
               "(RULES §11).",
     .exceptions =
         "pairs that form no convex quadrilateral however they are placed, and clipped ones",
     .generate = &generate,
     .check = &check,
     .is_promised = &covers_touched_pixels,
     .unpromised = "the backend does not cover all pixels that triangles touch",
     .covers = {cover(45, "drawn by both"), cover(18, "several samples")}});

}  // namespace
}  // namespace rastercheck::properties::shared_edge_leaves_no_pixel_out_law
