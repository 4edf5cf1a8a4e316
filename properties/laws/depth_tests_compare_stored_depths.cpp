// Depth tests compare stored depths: with a depth test `less`, each sample keeps the fragment of
// least depth as stored, biased and all, and of equal ones the first; and none that is not less
// than what the buffer was cleared to, as stored.
//
// Why. Fragments are handed over as they are stored, and a drawing without a depth test has all of
// them. Storing may make different depths equal, and then the first stays. The clear value is
// stored in the format as well, to the nearest number: of 16 bits, a buffer cleared to 0.5 holds
// 32767 or 32768 of 65535, and a fragment of depth 0.5 that is stored as the same is not less.
//
// Samples: all that the triangles cover. The law applies if the contract promises that fragments do
// not change with the depth test, which keeps the nearest and the first of equals, and if depth
// tests compare the format that fragments have.

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "oracle/rational.h"
#include "oracle/stored_values.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/biased_depths.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/sample_place.h"
#include "properties/window_position.h"

namespace rastercheck::properties::depth_tests_compare_stored_depths_law {
namespace {

using records::FragmentClass;

class StoredCheck {
 public:
  StoredCheck(const cases::Case& c, const cases::Fragments& all, const cases::Fragments& left)
      : case_(&c), all_(&all), left_(&left), tally_(c) {
    if (c.depth_clear)
      clear_ = oracle::stored_depth(oracle::Rational(*c.depth_clear), c.depth_format);
  }

  Check run() {
    std::map<cases::SamplePlace, std::size_t> nearest;
    for (std::size_t i = 0; i < all_->size(); ++i) {
      const auto [at, is_first] = nearest.emplace(sample_of(all_->place_of(i)), i);
      if (is_first) continue;
      const float before = all_->depth[at->second];
      tally_.label(all_->depth[i] == before ? "equal as stored" : "distinct");
      if (all_->depth[i] < before) at->second = i;
    }
    const auto left = fragments_by_sample(*left_);
    for (const auto& [sample, i] : nearest) check_sample(i, left.find(sample), left.end());
    for (const auto& [sample, i] : left) {
      if (nearest.contains(sample)) continue;
      tally_.report(violation_at(left_->place_of(i), FragmentClass::extra,
                                 "forbidden: nothing is drawn there without a depth test", ""));
    }
    return tally_.finish();
  }

 private:
  using Left = std::map<cases::SamplePlace, std::size_t>::const_iterator;

  void check_sample(std::size_t nearest, const Left& left, const Left& none) {
    const cases::SamplePlace place = all_->place_of(nearest);
    const float depth = all_->depth[nearest];
    if (std::isnan(depth)) return;
    if (is_of_case(*case_, place)) tally_.pass_required(place.triangle);
    // Without a clear depth, the buffer may begin with 1 or anything farther.
    const bool may_be_missing = clear_ ? !(depth < *clear_) : !(depth < 1);
    const bool may_be_left = !clear_ || depth < *clear_;
    if (clear_) tally_.label(depth < *clear_ ? "nearer than cleared" : "not nearer than cleared");
    if (clear_ && depth == *clear_) tally_.label("equal to cleared");
    if (left == none) {
      if (may_be_missing) return;
      tally_.report(violation_at(place, FragmentClass::missing,
                                 "required: the nearest, stored as " + value_text(depth),
                                 "nothing is left there"));
      return;
    }
    const cases::SamplePlace drawn = left_->place_of(left->second);
    const float actual = left_->depth[left->second];
    if (!may_be_left) {
      tally_.report(violation_at(drawn, FragmentClass::extra,
                                 "forbidden: the buffer was cleared to " + value_text(*clear_) +
                                     ", and the nearest is " + value_text(depth),
                                 "left at depth " + value_text(actual)));
    } else if (drawn.triangle != place.triangle) {
      tally_.report(violation_at(drawn, FragmentClass::wrong_triangle,
                                 "forbidden: triangle " + std::to_string(place.triangle) +
                                     " is stored as " + value_text(depth) + ", nearer or first",
                                 "left at depth " + value_text(actual)));
    }
  }

  const cases::Case* case_;
  const cases::Fragments* all_;
  const cases::Fragments* left_;
  std::optional<float> clear_;  ///< as stored
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!draws_bias_or_unorm(backend)) return not_applicable(kLacksBiasAndUnorm);
  const cases::Case untested = for_depths(c, c.depth_bias);
  cases::Case tested = untested;
  tested.depth_test = cases::DepthTest::less;
  tested.depth_clear = c.depth_clear;
  const Result<backends::Drawn> all = draw_promised(untested, backend);
  if (!all) return tl::unexpected(all.error());
  const Result<backends::Drawn> left = draw_promised(tested, backend);
  if (!left) return tl::unexpected(left.error());
  const bool is_usual = left->contract.is_invariant &&
                        left->contract.depth_function == cases::KeptDepth::less &&
                        left->contract.depth_format == c.depth_format;
  if (!is_usual) return not_applicable("the contract has another depth test");
  Check check = StoredCheck(tested, all->fragments, left->fragments).run();
  if (!c.depth_bias.is_none()) add_label(check, "biased");
  if (cases::unorm_bits(c.depth_format) != 0) add_label(check, "unorm");
  return check;
}

bool is_promised(backends::Backend& backend) {
  return draws_bias_or_unorm(backend) && draws_invariantly(backend);
}

/// Draws some triangles again, less than a step nearer or farther, and clears to what one has.
Generated generate(Draw& draw) {
  Generated made = biased_case(draw);
  cases::Case& c = made.source;
  c.depth_test = cases::DepthTest::less;
  const std::size_t before = c.triangles.size();
  for (std::size_t t = 0; t < before; ++t) {
    cases::Triangle again = c.triangles[t];
    const float moved = draw.uniform(-0x1p-16F, 0x1p-16F);
    for (std::uint32_t& vertex : again) {
      cases::ClipVertex p = c.positions[vertex];
      p.z = to_float(double{p.z} + double{p.w} * double{moved});
      vertex = add_vertex_like(c, vertex, p);
    }
    if (draw.one_in(2)) c.triangles.push_back(again);
  }
  if (draw.one_in(3)) {
    const cases::ClipVertex& p = c.positions.front();
    const double share = p.w > 0 ? double{p.z} / double{p.w} : 0.5;
    const bool is_opengl = c.rules == cases::Rules::opengl;
    const double n{c.viewport.min_depth};
    const double f{c.viewport.max_depth};
    const double depth = n + (f - n) * (is_opengl ? (share + 1) / 2 : share);
    c.depth_clear = to_float(std::clamp(depth, 0.0, 1.0));
    c.depth_bias = {};
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "depth-tests-compare-stored-depths",
     .sentence = "depth tests compare stored depths",
     .reason = "`less` compares what the buffer holds with what it would hold.",
     .exceptions = "depths that are no numbers; backends whose depth test is another one, or that "
                   "promise no invariance",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend does not promise that irrelevant changes leave all bits unchanged, "
                   "or draws neither bias nor unorm depths",
     .covers = {cover(21, "equal as stored"), cover(23, "distinct"), cover(5, "equal to cleared"),
                cover(26, "biased"), cover(29, "unorm")}});

}  // namespace
}  // namespace rastercheck::properties::depth_tests_compare_stored_depths_law
