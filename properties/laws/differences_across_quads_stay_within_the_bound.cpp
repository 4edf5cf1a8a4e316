// Differences across quads stay within the bound: between two adjacent pixels of a 2×2 quad, from
// the even to the odd one, every attribute of a fragment changes by a number that agrees with the
// triangle's own map to within the contract's bound (cases::Contract::quad_share).
//
// Why. APIs shade quads so that a shader may use dFdx. If a fragment's neighbour lies beyond the
// triangle's edge, the framebuffer, the scissor or the viewport, a helper pixel takes its place,
// with the value of the same map N/D at that pixel. So the difference is exact up to the errors of
// the two values. A helper that takes another triangle's value, or is clamped to the edge, makes a
// seam of wrong derivatives along every outline.
//
// Left out: neighbours behind the eye's horizon, where the map has its pole and RULES §4 leaves
// values undefined; neighbours just before the horizon ("next to the horizon": 1/w is less than
// 2^-16 of the fragment's), where 1/w is mostly rounding error; centroids with several samples, as
// a helper pixel need not have a centroid; noperspective values with some w <= 0; and contracts
// that allow several placements.
//
// The APIs define dFdx and dFdy by the values that a shader is given, and hardly bound these at
// helper pixels. So a driver's differences (cases::PictureBounds) are held against the values that
// it draws itself: at two pixels of a quad that the same triangle covers, the difference is that of
// the two drawn values. Triangles that may be clipped are left out, as a driver may draw them in
// pieces with planes of their own, and so are several samples.
//
// x or y is chosen at random (choices.h). Without depth test and blending, the last triangle drawn
// is visible. Samples: some of the drawn samples at which the last triangle is required; up to half
// of the checked samples lie beside a sample that was not drawn. Only backends that draw pictures
// and promise a bound, or pictures of the fragments that they draw, are judged.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "oracle/judged_number.h"
#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/seen_triangles.h"
#include "properties/laws/internal/tally.h"
#include "properties/random_state.h"

namespace rastercheck::properties::differences_across_quads_stay_within_the_bound_law {
namespace {

using oracle::WindowAxis;
using records::AttributeKind;
using records::FragmentClass;

/// The greatest number of samples of a case that are judged.
constexpr std::size_t kMostSamples = 64;

constexpr float kNotDrawn = std::numeric_limits<float>::infinity();

cases::Pipeline pipeline_of(WindowAxis axis) {
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::always;
  pipeline.clear_depth = kNotDrawn;
  pipeline.shading = axis == WindowAxis::x ? cases::Shading::differences_along_x
                                           : cases::Shading::differences_along_y;
  return pipeline;
}

class DifferencesCheck {
 public:
  DifferencesCheck(const cases::Case& c, const cases::Contract& contract, WindowAxis axis,
                   const cases::Picture& picture)
      : case_(&c),
        axis_(axis),
        quad_share_(*contract.quad_share),
        seen_(c, contract),
        picture_(&picture),
        tally_(c) {}

  Check run() {
    tally_.label(axis_ == WindowAxis::x ? "along x" : "along y");
    std::vector<std::size_t> beside_drawn;
    std::vector<std::size_t> beside_others;
    for (std::size_t at = 0; at < picture_->depth.size(); ++at) {
      if (picture_->depth[at] == kNotDrawn) continue;
      (is_drawn(neighbor(place_at(*picture_, at))) ? beside_drawn : beside_others).push_back(at);
    }
    const auto chosen = some_of(beside_others, kMostSamples / 2);
    for (const std::size_t at : chosen) check_sample(at);
    for (const std::size_t at : some_of(beside_drawn, kMostSamples - chosen.size())) {
      check_sample(at);
    }
    return tally_.finish();
  }

 private:
  cases::SamplePlace neighbor(const cases::SamplePlace& place) const {
    cases::SamplePlace other = place;
    (axis_ == WindowAxis::x ? other.x : other.y) ^= 1U;
    return other;
  }

  bool is_in_framebuffer(const cases::SamplePlace& place) const {
    return std::cmp_less(place.x, picture_->size.width) &&
           std::cmp_less(place.y, picture_->size.height);
  }

  bool is_drawn(const cases::SamplePlace& place) const {
    return is_in_framebuffer(place) && picture_->depth[index_at(*picture_, place)] != kNotDrawn;
  }

  void check_sample(std::size_t at) {
    const auto place = seen_.find(*picture_, at);
    if (!place) return;
    tally_.pass_required(place->triangle);
    add_place_labels(*place);
    const std::size_t count = case_->attributes.size();
    for (std::uint32_t a = 0; a < count; ++a) {
      check_difference(*place, a, picture_->color[at * count + a]);
    }
  }

  void add_place_labels(const cases::SamplePlace& place) {
    const cases::SamplePlace other = neighbor(place);
    if (!is_in_framebuffer(other)) {
      tally_.label("beyond the framebuffer");
    } else if (seen_.truth(place.triangle)
                   .judge(static_cast<int>(other.x), static_cast<int>(other.y),
                          static_cast<int>(other.sample))
                   .verdict == records::Verdict::forbidden) {
      tally_.label("beyond the triangle");
    }
  }

  void check_difference(const cases::SamplePlace& place, std::uint32_t attribute, float computed) {
    const oracle::TriangleTruth& truth = seen_.truth(place.triangle);
    const auto difference =
        truth.is_value_free(attribute)
            ? std::nullopt
            : truth.quad_difference(attribute, axis_, static_cast<int>(place.x),
                                    static_cast<int>(place.y), static_cast<int>(place.sample),
                                    quad_share_);
    if (!difference) return tally_.label("no one difference");
    if (difference->is_next_to_horizon) return tally_.label("next to the horizon");
    const oracle::JudgedNumber judged =
        oracle::judge_number(difference->exact, difference->allowed, computed);
    const AttributeKind kind = records::kind_of(case_->attributes[attribute].interpolation);
    if (judged.is_cancelled) tally_.label("cancellation");
    if (judged.fragment_class == FragmentClass::correct) return tally_.pass(kind);
    records::Violation violation = violation_at(
        place, judged.fragment_class, judged.exact.to_string(),
        fmt::format("the difference along window {} in its quad; errors in ULP of the difference",
                    axis_ == WindowAxis::x ? "x" : "y"),
        {kind, attribute, computed});
    violation.error = judged.error;
    violation.bound = judged.bound;
    tally_.report(violation);
  }

  const cases::Case* case_;
  WindowAxis axis_;
  float quad_share_;
  SeenTriangles seen_;
  const cases::Picture* picture_;
  Tally tally_;
};

/// The fragments of a triangle, by pixel.
using Pixels = std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t>;

/// Compares differences with those of the values that the backend itself draws.
class DrawnDifferencesCheck {
 public:
  DrawnDifferencesCheck(const cases::Case& c, const backends::Drawn& drawn, WindowAxis axis,
                        const cases::Picture& picture)
      : case_(&c),
        bounds_(*drawn.contract.picture_bounds),
        axis_(axis),
        fragments_(&drawn.fragments),
        picture_(&picture),
        drawn_(c.triangles.size()),
        tally_(c) {
    for (std::size_t i = 0; i < fragments_->size(); ++i) {
      const cases::SamplePlace place = fragments_->place_of(i);
      if (!is_of_case(c, place)) continue;
      drawn_[place.triangle][{place.x, place.y}] = i;
      std::uint32_t& last = last_[{place.x, place.y}];
      last = std::max(last, place.triangle);
    }
  }

  Check run() {
    tally_.label(axis_ == WindowAxis::x ? "along x" : "along y");
    std::vector<std::size_t> judged;
    for (const auto& [pixel, triangle] : last_) {
      const Pixels& pixels = drawn_[triangle];
      if (pixels.contains(across(pixel, axis_))) judged.push_back(pixels.at(pixel));
    }
    for (const std::size_t i : some_of(judged, kMostSamples)) check_fragment(i);
    return tally_.finish();
  }

 private:
  using Pixel = std::pair<std::uint32_t, std::uint32_t>;

  static Pixel across(Pixel pixel, WindowAxis axis) {
    (axis == WindowAxis::x ? pixel.first : pixel.second) ^= 1U;
    return pixel;
  }

  void check_fragment(std::size_t i) {
    const cases::SamplePlace place = fragments_->place_of(i);
    if (may_be_cut(*case_, place.triangle)) return tally_.label("may be clipped");
    tally_.pass_required(place.triangle);
    for (std::uint32_t a = 0; a < case_->attributes.size(); ++a) {
      check_difference(place, a);
    }
  }

  void check_difference(const cases::SamplePlace& place, std::uint32_t attribute) {
    const float computed =
        picture_->color[index_at(*picture_, place) * picture_->channels + attribute];
    const AttributeKind kind = records::kind_of(case_->attributes[attribute].interpolation);
    const Pixel own{place.x, place.y};
    const double here = value_at(place.triangle, own, attribute);
    const double there = value_at(place.triangle, across(own, axis_), attribute);
    const bool is_odd = ((axis_ == WindowAxis::x ? own.first : own.second) & 1U) != 0;
    const double expected = is_odd ? here - there : there - here;
    const double size = std::abs(here) + std::abs(there);
    // Nothing is promised about differences beyond float32.
    if (!(size <= std::numeric_limits<float>::max())) return;
    // A driver may take numbers below the least normal float for 0.
    const double error =
        double{bounds_.float_error} * 0x1p-24 * size + std::numeric_limits<float>::min();
    if (std::abs(double{computed} - expected) <= error) return tally_.pass(kind);
    tally_.report(violation_at(
        place, class_of_wrong(computed, FragmentClass::beyond_bound),
        value_text(static_cast<float>(expected)),
        fmt::format("the difference along window {} of two values that the backend draws",
                    axis_ == WindowAxis::x ? "x" : "y"),
        {kind, attribute, computed}));
  }

  double value_at(std::uint32_t triangle, const Pixel& pixel, std::uint32_t attribute) {
    return double{fragments_->attributes_of(drawn_[triangle].at(pixel))[attribute]};
  }

  const cases::Case* case_;
  cases::PictureBounds bounds_;
  WindowAxis axis_;
  const cases::Fragments* fragments_;
  const cases::Picture* picture_;
  std::vector<Pixels> drawn_;            ///< [triangle]
  std::map<Pixel, std::uint32_t> last_;  ///< the last triangle drawn at a pixel
  Tally tally_;
};

Result<Check> check_drawn(const cases::ClipCase& clip, WindowAxis axis,
                          backends::Backend& backend) {
  if (clip.framebuffer.samples > 1) return not_applicable("a driver's pixels have one sample");
  cases::Pipeline pipeline = pipeline_of(axis);
  pipeline.clear_depth = 1;
  const Result<backends::Drawn> drawn = draw_promised(clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  if (!keeps_fragments_in_pictures(drawn->contract)) return not_applicable(kOtherFragments);
  const Result<cases::Picture> picture = draw_picture(clip, backend, pipeline);
  if (!picture) return tl::unexpected(picture.error());
  return DrawnDifferencesCheck(clip, *drawn, axis, *picture).run();
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  if (!draws_differences(backend) || clip.attributes.empty())
    return not_applicable(
        "the backend promises no differences across quads, or the case has no attributes");
  clip.depth_test = cases::DepthTest::none;
  Choices choices(choices_of(clip));
  const WindowAxis axis = choices.below(2) == 0 ? WindowAxis::x : WindowAxis::y;
  if (draws_differences_of_values(backend)) return check_drawn(clip, axis, backend);
  const Result<cases::Picture> picture = draw_picture(clip, backend, pipeline_of(axis));
  if (!picture) return tl::unexpected(picture.error());
  return DifferencesCheck(clip, backend.contract(clip), axis, *picture).run();
}

/// Makes any case with at least one attribute. In a quarter of the cases, a scissor leaves only a
/// few pixels, with helper pixels beyond.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  c.depth_test = cases::DepthTest::none;
  ensure_attribute(draw, c);
  if (draw.one_in(4)) {
    const int x = draw.between(0, c.framebuffer.width - 1);
    const int y = draw.between(0, c.framebuffer.height - 1);
    const int width = draw.between(1, 5);
    const int height = draw.between(1, 5);
    c.scissor = cases::Scissor{x, y, width, height};
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "differences-across-quads-stay-within-the-bound",
     .sentence = "differences across quads stay within the bound",
     .reason = "A helper pixel's value is that of the same map N/D, so that the difference is off "
               "by what the two values are.",
     .exceptions = "neighbours at or behind the horizon, centroids of several samples, "
                   "noperspective values with some w <= 0; backends that promise none",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_differences,
     .unpromised =
         "the backend draws no pictures or promises no bound for differences across quads",
     .covers = {cover(25, "along x"), cover(24, "along y"), cover(35, "beyond the triangle"),
                cover(26, "cancellation"), cover(11, "clipped"), cover(14, "several samples"),
                cover(7, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::differences_across_quads_stay_within_the_bound_law
