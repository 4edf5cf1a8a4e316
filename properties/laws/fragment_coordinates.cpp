// Fragment coordinates are those of the sample: a picture of window coordinates
// (cases::Shading::window_coordinates) shows the pixel's centre, the fragment's depth, and 1/w.
//
// x and y. A pixel's centre is (i + 1/2, j + 1/2), a float of few digits, so it is exact. With
// several samples it may be "any location within the pixel, or one of the fragment samples" (GLSL);
// Vulkan has the centre, or a sample where shaders run for every sample. So only pixels with one
// sample are judged, and only contracts that leave the sample at the centre.
//
// z is "the depth value that would be used for the fragment's depth" (GLSL), "the interpolated
// depth value of the primitive" (Vulkan), hence a depth as the contract permits it (RULES §4, §5),
// before it is biased, clamped and stored. So it is judged where nothing of this changes it: of
// float32 depths without bias, where the case does not clamp. A backend without bounds of its own
// for pictures (cases::PictureBounds) promises the bits that it stores.
//
// w is "1/w_c": D = Σ e_i, affine on the screen (RULES §1), with the value 1/w_i at vertex i. So it
// is the noperspective attribute Σ r_i w_i e_i with r_i = 1/w_i, and an implementation interpolates
// it in the same way, by a plane through the vertices' values, before it divides smooth values by
// it: the contract's bound of noperspective values holds. The case that is drawn has this
// attribute, for the oracle. Its r_i are rounded to float32, each by half an ulp of itself. Inside
// the triangle the w_i e_i are shares, so D is off by no more than half an ulp of the greatest r_i,
// half a scale ULP, which the bound is widened by.
//
// Left out for w: triangles with some w_i <= 0, where shares may be negative, and samples outside
// of the triangle of the exact positions, which snapped coverage may have. Of drivers, triangles
// that may be clipped: their corners have values of w that the driver rounds.
//
// Without depth test, the triangle drawn last is visible. Samples: of x and y all that are drawn,
// of z and w some at which the last triangle is required. Only backends that draw pictures are
// judged.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/seen_triangles.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/value_findings.h"

namespace rastercheck::properties::fragment_coordinates_law {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// The greatest number of samples of a case that are judged.
constexpr std::size_t kMostSamples = 64;
constexpr std::size_t kChannels = 4;

/// The case with 1/w as its only attribute.
cases::ClipCase with_reciprocals(const cases::ClipCase& c) {
  cases::ClipCase made = c;
  made.attributes = {{"1/w", cases::Interpolation::noperspective, cases::Location::sample}};
  made.attribute_values.clear();
  for (const cases::ClipVertex& p : made.positions) {
    const float reciprocal = 1 / p.w;
    made.attribute_values.push_back(p.w > 0 && std::isfinite(reciprocal) ? reciprocal : 0);
  }
  made.depth_test = cases::DepthTest::none;
  return made;
}

bool is_drawn(const cases::Picture& picture, std::size_t at) {
  return picture.color[kChannels * at] != 0;  // no pixel's centre is at x = 0
}

/// True if depths are shown as they are interpolated.
bool shows_depths(const cases::Case& c) {
  const bool is_clamped = c.depth_clamp || c.rules == cases::Rules::d3d;
  return cases::unorm_bits(c.depth_format) == 0 && c.depth_bias.is_none() && !is_clamped;
}

class CoordinatesCheck {
 public:
  CoordinatesCheck(const cases::Case& c, const cases::Contract& contract,
                   const cases::Picture& picture)
      : case_(&c),
        is_driver_(contract.picture_bounds.has_value()),
        seen_(c, contract),
        promises_(c, contract),
        picture_(&picture),
        tally_(c) {}

  Check run() {
    std::vector<std::size_t> drawn;
    for (std::size_t at = 0; at < picture_->depth.size(); ++at) {
      if (!is_drawn(*picture_, at)) continue;
      drawn.push_back(at);
      check_place(at);
    }
    for (const std::size_t at : some_of(drawn, kMostSamples)) check_sample(at);
    return tally_.finish();
  }

 private:
  float shown(std::size_t at, std::size_t channel) const {
    return picture_->color[kChannels * at + channel];
  }

  void check_place(std::size_t at) {
    const cases::SamplePlace place = place_at(*picture_, at);
    const std::array<double, 2> centre{place.x + 0.5, place.y + 0.5};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (double{shown(at, axis)} == centre[axis]) continue;
      return report(
          place, AttributeKind::flat, shown(at, axis), fmt::format("{}", centre[axis]),
          axis == 0 ? "window x of the pixel's centre" : "window y of the pixel's centre");
    }
    tally_.pass(AttributeKind::flat);
  }

  void check_sample(std::size_t at) {
    const auto place = seen_.find(*picture_, at);
    if (!place) return;
    tally_.pass_required(place->triangle);
    check_depth(*place, at);
    check_reciprocal(*place, at);
  }

  void check_depth(const cases::SamplePlace& place, std::size_t at) {
    if (!shows_depths(*case_)) return;
    const float z = shown(at, 2);
    if (!is_driver_) {
      if (is_same(z, picture_->depth[at])) return pass_depth();
      return report(place, AttributeKind::depth, z, value_text(picture_->depth[at]),
                    "window z; the fragment's depth is stored as another float");
    }
    const auto permitted =
        seen_.truth(place.triangle)
            .permitted_numbers(std::nullopt, static_cast<int>(place.x), static_cast<int>(place.y),
                               static_cast<int>(place.sample));
    if (!permitted) return tally_.label("depth left open");
    if (permitted->least <= z && z <= permitted->greatest) return pass_depth();
    report(place, AttributeKind::depth, z,
           fmt::format("[{}, {}]", value_text(permitted->least), value_text(permitted->greatest)),
           "window z; beyond the depths that are permitted");
  }

  void pass_depth() {
    tally_.label("depth");
    tally_.pass(AttributeKind::depth);
  }

  void check_reciprocal(const cases::SamplePlace& place, std::size_t at) {
    for (const std::uint32_t vertex : case_->triangles[place.triangle]) {
      if (case_->attributes_of(vertex)[0] == 0) return tally_.label("1/w left open");
    }
    if (is_driver_ && may_be_cut(*case_, place.triangle)) return tally_.label("may be clipped");
    if (!is_inside(place)) return tally_.label("outside the exact triangle");
    const auto promise = promises_.promise_of(place, 0);
    if (!promise) return tally_.label("1/w left open");
    tally_.label("1/w");
    // Half an ULP for the vertices' values; the sums in double are off by less than a float.
    const double bound = promise->bound + 0.5;
    const float least = least_float(promise->lo, bound, promise->unit);
    const float greatest = greatest_float(promise->hi, bound, promise->unit);
    const float w = shown(at, 3);
    if (least <= w && w <= greatest) return tally_.pass(AttributeKind::noperspective);
    report(place, AttributeKind::noperspective, w,
           fmt::format("[{}, {}]", value_text(least), value_text(greatest)), "1/w at the sample");
  }

  bool is_inside(const cases::SamplePlace& place) {
    const auto e = seen_.truth(place.triangle)
                       .edges(static_cast<int>(place.x), static_cast<int>(place.y),
                              static_cast<int>(place.sample));
    return e && std::all_of(e->begin(), e->end(), [](const oracle::Rational& edge) {
             return edge >= oracle::Rational();
           });
  }

  void report(const cases::SamplePlace& place, AttributeKind kind, float actual,
              const std::string& exact, const std::string& note) {
    const auto attribute =
        kind == AttributeKind::noperspective ? std::optional<std::uint32_t>(0) : std::nullopt;
    tally_.report(violation_at(place, class_of_wrong(actual, FragmentClass::beyond_bound), exact,
                               note, {kind, attribute, actual}));
  }

  const cases::Case* case_;
  bool is_driver_;
  SeenTriangles seen_;
  ValueFindings promises_;
  const cases::Picture* picture_;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!draws_pictures(backend)) return not_applicable("the backend draws no pictures");
  if (c.framebuffer.samples > 1) return not_applicable("pixels have several samples");
  const cases::ClipCase drawn = with_reciprocals(c);
  const cases::Contract contract = backend.contract(drawn);
  if (contract.sample_position) return not_applicable("the sample is not at the pixel's centre");
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::always;
  pipeline.shading = cases::Shading::window_coordinates;
  const Result<cases::Picture> picture = draw_picture(drawn, backend, pipeline);
  if (!picture) return tl::unexpected(picture.error());
  return CoordinatesCheck(drawn, contract, *picture).run();
}

/// Makes any case with one sample per pixel.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  made.source.framebuffer.samples = 1;
  return made;
}

const LawRegistration kRegistration(
    {.id = "fragment-coordinates-are-those-of-the-sample",
     .sentence = "fragment coordinates are those of the sample",
     .reason = "A pixel's centre is a float, z is the fragment's depth, and 1/w is affine on the "
               "screen: a noperspective value with 1/w_i at the vertices.",
     .exceptions =
         "several samples; depths that are biased, clamped or stored in unorm formats; 1/w "
         "where some w_i <= 0, and of drivers where triangles may be clipped",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_pictures,
     .unpromised = "the backend draws no pictures",
     .covers = {cover(37, "1/w"), cover(11, "clipped"), cover(23, "depth"), cover(7, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::fragment_coordinates_law
