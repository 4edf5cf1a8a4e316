// The nearest fragment wins: with a depth test `less`, each sample keeps, bit for bit, the fragment
// of least depth among those that the same case draws there without a test; of fragments with equal
// depths, the first.
//
// Why. `less` replaces a fragment only by a nearer one: after all triangles, in submission order,
// the fragment of least depth is left. Of fragments with equal depths, the first is left, as no
// later depth is less. A triangle's fragments depend neither on what was drawn before (OpenGL,
// "Invariance": fragments do not change with the framebuffer's contents) nor on the depth test, so
// a drawing without a test gives the candidates. The law need not know whether their values are
// right.
//
// Samples: all, except those with a NaN depth, which is neither nearer nor farther. The floats that
// the backend itself drew decide which depths are equal; −0 equals 0. A backend that promises depth
// tests in another format compares stored depths (internal/depth_order.h). Then a fragment may be
// the one that remains if each fragment drawn before it may be farther and no fragment drawn after
// it is surely nearer. The clear depth counts as a fragment drawn before all others; if the case
// does not give it, it may be 1 or beyond all depths.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "properties/judged_law.h"
#include "properties/laws/internal/depth_order.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/sample_place.h"
#include "properties/laws/internal/tally.h"
#include "properties/window_position.h"

namespace rastercheck::properties::nearest_fragment_wins_law {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// A sample's fragments in the drawing without a depth test.
struct Candidates {
  std::vector<std::size_t> all;  ///< fragments, in submission order
  std::size_t nearest = 0;       ///< the nearest fragment; the first of equals
  bool is_tied = false;          ///< true if another fragment is as near
  bool has_nan = false;          ///< true if some depth is NaN
};

class NearestCheck {
 public:
  NearestCheck(const cases::Case& c, const cases::Fragments& all, const cases::Contract& contract)
      : case_(&c), all_(&all), contract_(&contract), order_(contract.depth_format), tally_(c) {
    for (std::size_t i = 0; i < all.size(); ++i) add(i);
  }

  Check run(const cases::Fragments& tested) {
    std::set<cases::SamplePlace> seen;
    for (std::size_t i = 0; i < tested.size(); ++i) {
      const cases::SamplePlace place = tested.place_of(i);
      const auto found = candidates_.find(sample_of(place));
      if (!seen.insert(sample_of(place)).second) {
        tally_.report(violation_at(place, FragmentClass::extra,
                                   "forbidden: more than one fragment is left", ""));
      } else if (found == candidates_.end()) {
        tally_.report(violation_at(place, FragmentClass::extra,
                                   "forbidden: nothing is drawn there without a depth test", ""));
      } else if (!found->second.has_nan) {
        compare(found->second, tested, i);
      }
    }
    for (const auto& [sample, candidates] : candidates_) {
      if (seen.contains(sample) || candidates.has_nan || !has_to_be_drawn(candidates)) continue;
      tally_.report(violation_at(all_->place_of(candidates.nearest), FragmentClass::missing,
                                 "required: it is the nearest fragment there",
                                 "nothing is left there"));
    }
    tally_.counts().required = candidates_.size();
    add_labels();
    return tally_.finish();
  }

 private:
  void add(std::size_t i) {
    const float depth = depth_of(i);
    const auto [entry, is_first] =
        candidates_.try_emplace(sample_of(all_->place_of(i)), Candidates{{}, i});
    Candidates& there = entry->second;
    there.all.push_back(i);
    there.has_nan = there.has_nan || std::isnan(depth);
    if (is_first) return;
    const float least = depth_of(there.nearest);
    if (depth < least) there.nearest = i;
    if (depth <= least) there.is_tied = depth == least;
  }

  bool has_to_be_drawn(const Candidates& there) const {
    return order_.is_surely_less(depth_of(there.nearest),
                                 directed(contract_->depth_beginning(case_->depth_clear)));
  }

  /// True if the depth test may leave this fragment at its sample.
  bool may_be_left(const Candidates& there, std::size_t left) const {
    const float depth = depth_of(left);
    return std::all_of(there.all.begin(), there.all.end(), [&](std::size_t other) {
      // Of equals, the first stays or, if the contract says so, the last.
      const bool has_to_be_nearer = contract_->keeps_last_of_equals() ? other > left : other < left;
      if (has_to_be_nearer) return order_.may_be_less(depth, depth_of(other));
      return other == left || !order_.is_surely_less(depth_of(other), depth);
    });
  }

  /// Depths as compared here: negated if the contract reverses depth, so that less is nearer.
  float directed(float depth) const { return contract_->is_depth_reversed() ? -depth : depth; }
  float depth_of(std::size_t i) const { return directed(all_->depth[i]); }
  bool passes(float depth, float beginning) const {
    return contract_->keeps_last_of_equals() ? !order_.is_surely_less(beginning, depth)
                                             : order_.may_be_less(depth, beginning);
  }

  void compare(const Candidates& there, const cases::Fragments& tested, std::size_t i) {
    const cases::SamplePlace place = tested.place_of(i);
    const cases::SamplePlace nearest = all_->place_of(there.nearest);
    const auto left = std::find_if(there.all.begin(), there.all.end(), [&](std::size_t one) {
      return all_->place_of(one).triangle == place.triangle;
    });
    if (left == there.all.end() || !may_be_left(there, *left)) {
      const std::string_view tied = contract_->keeps_last_of_equals()
                                        ? " is as near and was drawn last"
                                        : " is as near and was drawn first";
      const std::string why(there.is_tied ? tied : " is nearer");
      return tally_.report(violation_at(
          place, FragmentClass::wrong_triangle,
          "forbidden: triangle " + std::to_string(nearest.triangle) + why,
          "at depth " + value_text(tested.depth[i]) + ", the nearest of " +
              std::to_string(there.all.size()) + " at " + value_text(all_->depth[there.nearest])));
    }
    const bool is_beyond =
        case_->depth_clear && !passes(depth_of(*left), directed(*case_->depth_clear));
    if (is_beyond) {
      return tally_.report(violation_at(
          place, FragmentClass::extra,
          "forbidden: it is not nearer than the value that the depth buffer is cleared to",
          "at depth " + value_text(tested.depth[i])));
    }
    const auto difference = find_difference(
        *case_, *all_, *left, tested, i,
        "drawn with the depth test `less`; the drawing without a test has the expected value");
    if (difference) return tally_.report(*difference);
    tally_.pass(AttributeKind::coverage);
  }

  void add_labels() {
    for (const auto& [sample, there] : candidates_) {
      const cases::SamplePlace nearest = all_->place_of(there.nearest);
      if (is_of_case(*case_, nearest)) tally_.see(nearest.triangle);
      if (there.all.size() > 1) tally_.label("overdraw");
      if (there.all.size() > 2) tally_.label("three and more");
      if (there.is_tied) tally_.label("equal nearest");
      if (there.nearest != there.all.front()) tally_.label("farther drawn first");
    }
  }

  const cases::Case* case_;
  const cases::Fragments* all_;
  const cases::Contract* contract_;
  DepthOrder order_;
  std::map<cases::SamplePlace, Candidates> candidates_;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  clip.depth_test = cases::DepthTest::none;
  const Result<backends::Drawn> all = draw_promised(clip, backend);
  if (!all) return tl::unexpected(all.error());
  clip.depth_test = cases::DepthTest::less;
  const Result<backends::Drawn> tested = draw_promised(clip, backend);
  if (!tested) return tl::unexpected(tested.error());
  return NearestCheck(clip, all->fragments, tested->contract).run(tested->fragments);
}

// --- the law's own cases: triangles repeated, unchanged or moved in depth -----------------------

/// Appends a triangle with copies of another triangle's vertices and their values.
void repeat_triangle(cases::Case& c, const cases::Triangle& triangle) {
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  for (const std::uint32_t vertex : triangle) add_vertex_like(c, vertex, c.positions[vertex]);
  c.triangles.push_back({first, first + 1, first + 2});
}

Generated generate(Draw& draw) {
  Generated made = overlapping_case(draw);
  cases::Case& c = made.source;
  c.depth_test = cases::DepthTest::less;
  const int more = draw.between(0, 2);
  for (int i = 0; i < more; ++i) {
    const int like = draw.between(0, static_cast<int>(c.triangles.size()) - 1);
    const cases::Triangle triangle = c.triangles[static_cast<std::size_t>(like)];
    repeat_triangle(c, triangle);
    // Starts the copy with another vertex, moves it nearer or farther as a whole, tilts it, or
    // leaves it unchanged.
    const std::size_t last = c.positions.size() - 3;
    switch (draw.between(0, 3)) {
      case 0:
        c.triangles.back() = {c.triangles.back()[1], c.triangles.back()[2], c.triangles.back()[0]};
        break;
      case 1: {
        const int sixteenths = draw.between(-4, 4);
        for (std::size_t corner = 0; corner < 3; ++corner) {
          cases::ClipVertex& p = c.positions[last + corner];
          p.z = to_float(double{p.z} + double{p.w} * sixteenths / 16);
        }
        break;
      }
      case 2: {
        cases::ClipVertex& p = c.positions[last];
        const float depth = random_depth(draw, c);
        p.z = to_float(double{depth} * double{p.w});
        break;
      }
      default:
        break;
    }
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "the-nearest-fragment-wins",
     .sentence = "the nearest fragment wins",
     .reason = "`less` replaces what is at a sample by what is nearer, and by nothing else, and "
               "fragments do not depend on the test.",
     .exceptions = "samples at which a depth is no number; backends that promise no invariance",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_invariantly,
     .unpromised = "the backend does not promise that irrelevant changes leave all bits unchanged",
     .covers = {cover(30, "overdraw"), cover(20, "equal nearest"), cover(20, "farther drawn first"),
                cover(20, "three and more"), cover(5, "clipped"), cover(5, "several samples")}});

}  // namespace
}  // namespace rastercheck::properties::nearest_fragment_wins_law
