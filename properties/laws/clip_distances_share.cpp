// Complementary clip distances share what is drawn: a triangle cut by a user clip distance d, and
// the same triangle cut by −d, together draw exactly what is drawn without either, and nothing
// twice.
//
// Why. A sample is inside iff f = Σ e_i d_i > 0, and −d turns f into −f. A zero is decided by f's
// own normal, which −d reverses (RULES §2). So each sample that is drawn without d is drawn with
// exactly one of d and −d, except that it is drawn with both if
//
//   f ≡ 0                    the distance decides nothing: inside with either sign
//   D3D: f = 0 at a sample   f >= 0 is inside
//
// The oracle identifies these samples: it requires them in both drawings. The case's other
// distances and the rest of its state stay as they are. Each triangle is drawn as if alone: the
// case's depth test is removed.
//
// Samples: those that the contract decides in all three drawings. The cut adds snapped vertices to
// a snapped triangle, and near these the oracle leaves samples open (RULES §3). The oracle also
// leaves samples with f = 0 open under a contract that names no tie rule.

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "properties/generator.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::clip_distances_share_law {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::Reason;
using records::SampleVerdict;
using records::Verdict;

/// The case without its clip distance `index`.
cases::Case without_distance(const cases::Case& c, std::size_t index) {
  cases::Case changed = c;
  --changed.clip_distance_count;
  changed.clip_distances.clear();
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    for (std::size_t d = 0; d < c.clip_distance_count; ++d) {
      if (d != index) changed.clip_distances.push_back(c.clip_distances_of(v)[d]);
    }
  }
  return changed;
}

/// The case with its clip distance `index` negated.
cases::Case with_opposite(const cases::Case& c, std::size_t index) {
  cases::Case changed = c;
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    float& distance = changed.clip_distances[v * c.clip_distance_count + index];
    distance = -distance;
  }
  return changed;
}

/// One of the three drawings, and the oracle's verdicts on its case.
class JudgedDrawing {
 public:
  /// The case must outlive this object.
  static Result<JudgedDrawing> make(const cases::Case& c, backends::Backend& backend) {
    const Result<backends::Drawn> drawn = draw_promised(c, backend);
    if (!drawn) return tl::unexpected(drawn.error());
    return JudgedDrawing(c, drawn->contract, drawn->fragments);
  }

  const std::vector<cases::SamplePlace>& places() const { return places_; }
  bool has(const cases::SamplePlace& place) const {
    return std::binary_search(places_.begin(), places_.end(), place);
  }

  SampleVerdict judge(const cases::SamplePlace& place) {
    return verdicts_.judge(place.triangle, place);
  }
  const oracle::TriangleTruth& truth(std::uint32_t triangle) { return verdicts_.truth(triangle); }

 private:
  JudgedDrawing(const cases::Case& c, const cases::Contract& contract,
                const cases::Fragments& drawn)
      : verdicts_(c, contract) {
    // Fragments outside the case, and repeated ones, are left to laws about coverage.
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (is_of_case(c, drawn.place_of(i))) places_.push_back(drawn.place_of(i));
    }
    std::sort(places_.begin(), places_.end());
    places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  }

  Verdicts verdicts_;
  std::vector<cases::SamplePlace> places_;  ///< ascending
};

class SharingCheck {
 public:
  explicit SharingCheck(const cases::Case& c) : tally_(c) {}

  void run(std::size_t distance, JudgedDrawing& whole, JudgedDrawing& kept, JudgedDrawing& rest) {
    distance_ = distance;
    std::vector<cases::SamplePlace> parts;
    std::set_union(kept.places().begin(), kept.places().end(), rest.places().begin(),
                   rest.places().end(), std::back_inserter(parts));
    std::vector<cases::SamplePlace> all;
    std::set_union(parts.begin(), parts.end(), whole.places().begin(), whole.places().end(),
                   std::back_inserter(all));
    for (const cases::SamplePlace& place : all) see(place, whole, kept, rest);
    // If the plane passes between a triangle's samples, both parts drew some of them.
    std::vector<std::uint32_t> shared;
    std::set_intersection(of_kept_.begin(), of_kept_.end(), of_rest_.begin(), of_rest_.end(),
                          std::back_inserter(shared));
    if (!shared.empty()) tally_.label("shared triangle");
    of_kept_.clear();
    of_rest_.clear();
  }

  Check finish() { return tally_.finish(); }

 private:
  void see(const cases::SamplePlace& place, JudgedDrawing& whole, JudgedDrawing& kept,
           JudgedDrawing& rest) {
    const SampleVerdict of_whole = whole.judge(place);
    const SampleVerdict of_kept = kept.judge(place);
    const SampleVerdict of_rest = rest.judge(place);
    for (const SampleVerdict& decision : {of_whole, of_kept, of_rest}) {
      if (decision.verdict != Verdict::permitted) continue;
      ++tally_.counts().permitted;
      return tally_.label("permitted");
    }
    const bool is_zero = of_whole.reason != Reason::tie &&
                         (of_kept.reason == Reason::tie || of_rest.reason == Reason::tie);
    if (is_zero) tally_.label("zero at a sample");
    const bool is_in_both =
        of_kept.verdict == Verdict::required && of_rest.verdict == Verdict::required;
    if (is_in_both) tally_.label("drawn with both");

    const bool by_kept = kept.has(place);
    const bool by_rest = rest.has(place);
    if (by_kept) of_kept_.insert(place.triangle);
    if (by_rest) of_rest_.insert(place.triangle);
    if (!whole.has(place)) {
      report(place, FragmentClass::extra, "forbidden: it is not drawn without the distance",
             by_kept ? "drawn with it" : "drawn with its opposite", whole);
      return;
    }
    ++tally_.counts().required;
    tally_.see(place.triangle);
    if (is_in_both && by_kept != by_rest) {
      report(place, FragmentClass::missing, "required: with the distance and with its opposite",
             by_kept ? "drawn with the distance only" : "drawn with its opposite only", kept);
    } else if (!by_kept && !by_rest) {
      report(place, FragmentClass::missing, "required: with the distance or with its opposite",
             "drawn with neither, and without the distance", kept);
    } else if (by_kept && by_rest && !is_in_both) {
      report(place, FragmentClass::extra, "forbidden: with more than one of the two",
             "drawn with the distance and with its opposite", kept);
    } else {
      tally_.pass(AttributeKind::coverage);
    }
  }

  void report(const cases::SamplePlace& place, FragmentClass fragment_class,
              const std::string& exact, const std::string& what, JudgedDrawing& nearest) {
    records::Violation violation = violation_at(
        place, fragment_class, exact, "clip distance " + std::to_string(distance_) + ": " + what);
    violation.distance = nearest.truth(place.triangle)
                             .distance(static_cast<int>(place.x), static_cast<int>(place.y),
                                       static_cast<int>(place.sample));
    tally_.report(violation);
  }

  std::size_t distance_ = 0;
  std::set<std::uint32_t> of_kept_;  ///< triangles that drew a decided sample
  std::set<std::uint32_t> of_rest_;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  clip.depth_test = cases::DepthTest::none;
  if (clip.clip_distance_count == 0) return not_applicable("the case has no clip distances");
  SharingCheck sharing(clip);
  for (std::size_t d = 0; d < clip.clip_distance_count; ++d) {
    const cases::Case without = without_distance(clip, d);
    const cases::Case opposite = with_opposite(clip, d);
    Result<JudgedDrawing> whole = JudgedDrawing::make(without, backend);
    if (!whole) return tl::unexpected(whole.error());
    Result<JudgedDrawing> kept = JudgedDrawing::make(clip, backend);
    if (!kept) return tl::unexpected(kept.error());
    Result<JudgedDrawing> rest = JudgedDrawing::make(opposite, backend);
    if (!rest) return tl::unexpected(rest.error());
    sharing.run(d, *whole, *kept, *rest);
  }
  return sharing.finish();
}

// --- the law's own cases: distances whose zeros run through what is drawn -----------------------

void set_distance(cases::Case& c, std::uint32_t vertex, std::size_t index, double value) {
  c.clip_distances[vertex * c.clip_distance_count + index] = to_float(value);
}

/// Sets the distance a (u − u0) + b (v − v0) at window position (u, v), where (u0, v0) is a sample
/// and a and b are integers. Since Σ e_i (u_i w_i) = u and Σ e_i w_i = 1, a vertex gets w times
/// this distance. The distance is exact if the vertex's position is exact. So the zeros run exactly
/// through samples, on the same line for all triangles.
void set_line_through_sample(Draw& draw, cases::Case& c, std::size_t index) {
  const WindowPoint sample = visible_sample(draw, c);
  const int a = draw.between(-3, 3);
  const int b = a == 0 ? 1 : draw.between(-3, 3);
  const double turn = c.rules == cases::Rules::d3d ? -1 : 1;
  const cases::Viewport& to = c.viewport;
  for (std::uint32_t v = 0; v < c.positions.size(); ++v) {
    const cases::ClipVertex& p = c.positions[v];
    const double w = double{p.w};
    const double u =
        double{p.x} * double{to.width} / 2 + w * (double{to.x} + double{to.width} / 2 - sample.u);
    const double y = double{p.y} * double{to.height} / 2 * turn +
                     w * (double{to.y} + double{to.height} / 2 - sample.v);
    set_distance(c, v, index, a * u + b * y);
  }
}

/// Sets opposite distances at every triangle's first and second vertex. The third vertex gets any
/// distance, or zero, so that the plane passes through it.
void set_opposites(Draw& draw, cases::Case& c, std::size_t index) {
  for (const cases::Triangle& triangle : c.triangles) {
    const float distance = draw.uniform(-1, 1);
    const float third = draw.one_in(2) ? 0.0F : draw.uniform(-1, 1);
    set_distance(c, triangle[0], index, double{distance});
    set_distance(c, triangle[1], index, -double{distance});
    set_distance(c, triangle[2], index, double{third});
  }
}

/// Sets the distance of many vertices to zero, which gives planes along edges and through vertices,
/// or no plane at all.
void set_zeros(Draw& draw, cases::Case& c, std::size_t index) {
  const int one_in = draw.pick(std::array{2, 3, 64});
  for (std::uint32_t v = 0; v < c.positions.size(); ++v) {
    const float distance = draw.one_in(one_in) ? draw.uniform(-1, 1) : 0.0F;
    set_distance(c, v, index, double{distance});
  }
}

void set_any(Draw& draw, cases::Case& c, std::size_t index) {
  for (std::uint32_t v = 0; v < c.positions.size(); ++v) {
    const float distance = draw.spread(-8, 2);
    set_distance(c, v, index, double{distance});
  }
}

Generated generate(Draw& draw) {
  Generated made;
  if (draw.one_in(2)) {
    made = generate_any(draw);
  } else {
    made.stratum = "on-grid";
    made.source = find_generator(made.stratum)->make(draw);
  }
  cases::Case& c = made.source;
  c.clip_distance_count = draw.one_in(4) ? 2 : 1;
  add_clip_distances(draw, c);
  for (std::size_t d = 0; d < c.clip_distance_count; ++d) {
    switch (draw.between(0, 5)) {
      case 0:
        set_opposites(draw, c, d);
        break;
      case 1:
        set_zeros(draw, c, d);
        break;
      case 2:
        set_any(draw, c, d);
        break;
      default:
        set_line_through_sample(draw, c, d);
    }
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "complementary-clip-distances-share-what-is-drawn",
     .sentence = "complementary clip distances share what is drawn",
     .reason = "f = Σ e_i d_i is positive, negative or a zero that its own normal decides, and −d "
               "turns all three round.",
     .exceptions = "distances that are zero everywhere, zeros under D3D, which are inside of both, "
                   "and samples that a contract leaves open in one of the three drawings",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_all_parts_once,
     .unpromised = "the backend does not promise that parts cover, once, what the whole covers",
     .needs_samples = true,
     .covers = {cover(38, "clipped"), cover(7, "drawn with both"), cover(16, "several samples"),
                cover(27, "shared triangle"), cover_decided(5, "zero at a sample")}});

}  // namespace
}  // namespace rastercheck::properties::clip_distances_share_law
