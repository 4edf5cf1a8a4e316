// Distinct depths are drawn in any order: a depth test `less` keeps the nearest fragment of each
// sample, whichever came first. The case's triangles, drawn in reverse order, leave the same
// fragments, bit for bit, unless the two fragments left at a sample have equal depths.
//
// Why. `less` replaces a fragment only by a nearer one. A triangle's fragments do not depend on
// what was drawn before (OpenGL, "Invariance": fragments do not change with the framebuffer's
// contents), so the two orders have the same candidate fragments. Let one order leave a and the
// other b. If a's depth were below b's, the second order would not have left b. So the depths are
// equal, or a and b are the same fragment.
//
// Samples: all. If the two depths are equal, or at most one step of the backend's depth comparison
// apart, the order decides which triangle is left, and the law accepts either; the same holds for
// NaN depths. Cases without a depth test get one. A third drawing, without a depth test, counts the
// candidates; only labels depend on it.

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "properties/judged_law.h"
#include "properties/laws/internal/depth_order.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/sample_place.h"
#include "properties/laws/internal/tally.h"
#include "properties/window_position.h"

namespace rastercheck::properties::order_of_distinct_depths_law {
namespace {

using records::AttributeKind;
using records::FragmentClass;

class OrderCheck {
 public:
  OrderCheck(const cases::Case& c, const cases::Fragments& forward,
             const cases::Fragments& backward, const cases::Contract& contract)
      : case_(&c),
        forward_(&forward),
        backward_(&backward),
        is_reversed_(contract.is_depth_reversed()),
        order_(contract.depth_format),
        tally_(c) {}

  /// `all` has the candidate fragments.
  Check run(const cases::Fragments& all) {
    const std::map<cases::SamplePlace, std::size_t> first = fragments_by_sample(*forward_);
    const std::map<cases::SamplePlace, std::size_t> second = fragments_by_sample(*backward_);
    for (const auto& [sample, i] : first) {
      const auto other = second.find(sample);
      if (other == second.end()) {
        tally_.report(violation_at(forward_->place_of(i), FragmentClass::missing,
                                   "required: something is left there in submission order",
                                   "nothing is left there in the reverse order"));
      } else {
        compare(i, other->second);
      }
    }
    for (const auto& [sample, i] : second) {
      if (first.contains(sample)) continue;
      tally_.report(violation_at(backward_->place_of(i), FragmentClass::extra,
                                 "forbidden: nothing is left there in submission order",
                                 "left in the reverse order"));
    }
    add_labels(all);
    return tally_.finish();
  }

 private:
  void add_labels(const cases::Fragments& all) {
    std::map<cases::SamplePlace, std::pair<float, int>> depths;  // least depth, and number
    for (std::size_t i = 0; i < all.size(); ++i) {
      const float depth = all.depth[i];
      const auto [at, is_first] =
          depths.try_emplace(sample_of(all.place_of(i)), std::pair{depth, 1});
      if (is_first) continue;
      tally_.label(depth == at->second.first ? "equal depths" : "distinct depths");
      at->second.first = std::min(at->second.first, depth);
      if (++at->second.second == 3) tally_.label("three and more");
    }
  }

  void compare(std::size_t i, std::size_t j) {
    const cases::SamplePlace place = forward_->place_of(i);
    const cases::SamplePlace other = backward_->place_of(j);
    const float depth = forward_->depth[i];
    const float other_depth = backward_->depth[j];
    ++tally_.counts().required;
    if (is_of_case(*case_, place)) tally_.see(place.triangle);
    if (place.triangle == other.triangle) {
      const auto difference = find_difference(*case_, *forward_, i, *backward_, j,
                                              "the triangles drawn in the reverse order; in "
                                              "submission order, they had the expected value");
      if (difference) return tally_.report(*difference);
    } else if (order_.is_surely_less(depth, other_depth) ||
               order_.is_surely_less(other_depth, depth)) {
      return tally_.report(wrong_triangle(place, depth, other, other_depth));
    }
    tally_.pass(AttributeKind::coverage);
  }

  /// Reports the farther of the two fragments as the wrong one.
  records::Violation wrong_triangle(const cases::SamplePlace& place, float depth,
                                    const cases::SamplePlace& other, float other_depth) const {
    const bool is_first_wrong = (other_depth < depth) != is_reversed_;
    const cases::SamplePlace& nearer = is_first_wrong ? other : place;
    records::Violation violation = violation_at(
        is_first_wrong ? place : other, FragmentClass::wrong_triangle,
        "forbidden: triangle " + std::to_string(nearer.triangle) + " is nearer", "drawn in ");
    violation.note += is_first_wrong ? "submission order" : "the reverse order";
    violation.note += ", at depth " + value_text(is_first_wrong ? depth : other_depth) +
                      "; the other order leaves triangle " + std::to_string(nearer.triangle) +
                      " at " + value_text(is_first_wrong ? other_depth : depth);
    return violation;
  }

  const cases::Case* case_;
  const cases::Fragments* forward_;
  const cases::Fragments* backward_;
  bool is_reversed_;
  DepthOrder order_;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  if (clip.triangles.size() < 2) return not_applicable("the case has fewer than two triangles");
  clip.depth_test = cases::DepthTest::none;
  const Result<backends::Drawn> all = draw_promised(clip, backend);
  if (!all) return tl::unexpected(all.error());
  clip.depth_test = cases::DepthTest::less;
  const Result<backends::Drawn> forward = draw_promised(clip, backend);
  if (!forward) return tl::unexpected(forward.error());
  cases::Case reversed = clip;
  std::reverse(reversed.triangles.begin(), reversed.triangles.end());
  Result<backends::Drawn> backward = draw_promised(reversed, backend);
  if (!backward) return tl::unexpected(backward.error());
  const auto count = static_cast<std::uint32_t>(clip.triangles.size());
  for (std::uint32_t& triangle : backward->fragments.triangle) {
    if (triangle < count) triangle = count - 1 - triangle;
  }
  return OrderCheck(clip, forward->fragments, backward->fragments, forward->contract)
      .run(all->fragments);
}

// --- the law's own cases: triangles that intersect each other ------------------------------------

/// Appends a copy of a vertex at another depth.
std::uint32_t add_at_depth(Draw& draw, cases::Case& c, std::uint32_t vertex) {
  cases::ClipVertex p = c.positions[vertex];
  // Half of the depths are in eighths, which gives equal depths and planes that intersect at
  // samples.
  const int eighths = draw.between(1, 7);
  const float free = random_depth(draw, c);
  p.z = to_float(double{p.w} * (draw.one_in(2) ? eighths / 8.0 : double{free}));
  return add_vertex_like(c, vertex, p);
}

/// Adds triangles of the existing vertices, moved in depth. They lie before, behind or across the
/// other triangles.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  c.depth_test = cases::DepthTest::less;
  if (!draw.one_in(4)) c.cull = cases::Cull::none;
  const int vertices = static_cast<int>(c.positions.size());
  const int before = static_cast<int>(c.triangles.size());
  const int more = draw.between(1, 4);
  for (int i = 0; i < more; ++i) {
    const int like = draw.between(0, before - 1);
    cases::Triangle triangle = c.triangles[static_cast<std::size_t>(like)];
    const int changed = draw.between(0, 2);
    const int other = draw.between(0, vertices - 1);
    if (draw.one_in(2))
      triangle[static_cast<std::size_t>(changed)] = static_cast<std::uint32_t>(other);
    for (std::uint32_t& vertex : triangle) vertex = add_at_depth(draw, c, vertex);
    c.triangles.push_back(triangle);
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "distinct-depths-are-drawn-in-any-order",
     .sentence = "distinct depths are drawn in any order",
     .reason = "The test keeps what is nearer, and a triangle's fragments do not depend on what "
               "was drawn before.",
     .exceptions = "samples at which the two orders leave the same depth; backends that promise no "
                   "invariance",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_invariantly,
     .unpromised = "the backend does not promise that irrelevant changes leave all bits unchanged",
     .covers = {cover(13, "clipped"), cover(45, "depth test"), cover(36, "distinct depths"),
                cover(7, "equal depths"), cover(17, "several samples"), cover(23, "three and more"),
                cover(9, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::order_of_distinct_depths_law
