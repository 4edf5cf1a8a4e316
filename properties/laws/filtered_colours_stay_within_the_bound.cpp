// Filtered colours stay within the bound: bilinear and trilinear filtering give numbers no farther
// from the exactly computed colour than the contract says (cases::TextureBounds).
//
// Why. The exact colour is a polynomial of the exact coordinates within a square of texels, and
// continuous from one square to the next (oracle/texture_truth.h). Colours of adjacent texels
// differ by at most 1, so an error of a coordinate changes the colour by at most W or H times as
// much. The level of detail comes from exact screen derivatives, each off by as much as the
// contract allows. That gives an enclosure of the level and so a range of colours, to which the
// bound is added.
//
// A driver's contract leaves its coordinates in a range: the colour may be that of any of them. If
// its pictures have the fragments that it draws, its coordinates are those that it draws itself.
// Drivers are asked for bilinear filtering only, as their levels of detail follow differences
// across quads, which the APIs hardly bound.
//
// The texture's size, wrap modes and filter are random (choices.h); texels are noise, much of it
// black and white. The coordinates are the first two attributes.
//
// Samples: as in "texels-are-those-of-the-exact-coordinates"; for trilinear filtering, derivatives
// must have a single exact value, too. Only backends that draw pictures and promise a bound are
// judged.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "oracle/texture_truth.h"
#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/lookup_coordinates.h"
#include "properties/laws/internal/seen_triangles.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/textured_cases.h"

namespace rastercheck::properties::filtered_colours_stay_within_the_bound_law {
namespace {

using cases::Filter;
using oracle::Rational;
using oracle::TextureTruth;
using records::FragmentClass;

/// The greatest number of samples of a case that are judged.
constexpr std::size_t kMostSamples = 16;

cases::Pipeline pipeline_of(const cases::Case& c, bool has_levels) {
  Choices choices(choices_of(c));
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::always;
  pipeline.texturing = texturing_of(choices, &noise_byte);
  pipeline.texturing->filter = choices.pick(std::array{Filter::bilinear, Filter::trilinear});
  if (!has_levels) pipeline.texturing->filter = Filter::bilinear;
  return pipeline;
}

/// max|r| over the case's vertices.
Rational greatest(const cases::Case& c, std::size_t attribute) {
  float most = 0;
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    most = std::max(most, std::abs(c.attributes_of(v)[attribute]));
  }
  return Rational(double{most});
}

bool is_within(const oracle::ValueRange& allowed, float color) {
  if (!std::isfinite(color)) return false;
  const Rational exact(double{color});
  return allowed.lo <= exact && exact <= allowed.hi;
}

class FilterCheck {
 public:
  FilterCheck(const cases::Case& c, backends::Backend& backend, const cases::Contract& contract,
              const cases::Texturing& texturing, const cases::Picture& picture)
      : case_(&c),
        bounds_(*contract.texture_bounds),
        is_in_range_(contract.picture_bounds.has_value()),
        seen_(c, contract),
        texturing_(&texturing),
        truth_(texturing),
        picture_(&picture),
        greatest_{greatest(c, 0), greatest(c, 1)},
        lookups_(c, backend, contract),
        tally_(c) {}

  Check run() {
    tally_.label(texturing_->filter == Filter::bilinear ? "bilinear" : "trilinear");
    for (const std::size_t at : some_drawn_samples(*picture_, kMostSamples)) check_sample(at);
    return tally_.finish();
  }

 private:
  void check_sample(std::size_t at) {
    const auto place = seen_.find(*picture_, at);
    if (!place) return;
    const oracle::TriangleTruth& truth = seen_.truth(place->triangle);
    if (is_in_range_) return check_within(at, *place, truth);
    const auto exact = exact_coordinates(truth, *place);
    if (!exact) return tally_.label("no one coordinate");
    const auto filtered = filter(*exact, truth, *place);
    if (!filtered) return tally_.label("no one derivative");
    tally_.pass_required(place->triangle);
    for (std::uint32_t channel = 0; channel < filtered->size(); ++channel) {
      const float actual = picture_->color[at * filtered->size() + channel];
      compare(*place, channel, (*filtered)[channel], actual,
              fmt::format("s = {}, t = {}", exact->s.to_string(), exact->t.to_string()),
              channel % 2);
    }
  }

  /// Checks a colour of a driver.
  void check_within(std::size_t at, const cases::SamplePlace& place,
                    const oracle::TriangleTruth& truth) {
    const auto permitted = lookups_.find(truth, place);
    const auto filtered =
        permitted ? truth_.bilinear_within(*permitted, greatest_, bounds_) : std::nullopt;
    if (!filtered) return tally_.label("no one coordinate");
    tally_.pass_required(place.triangle);
    for (std::uint32_t channel = 0; channel < filtered->size(); ++channel) {
      const float actual = picture_->color[at * filtered->size() + channel];
      compare(place, channel, (*filtered)[channel], actual,
              fmt::format("s from {} to {}, t from {} to {}", permitted->s.lo.nearest_double(),
                          permitted->s.hi.nearest_double(), permitted->t.lo.nearest_double(),
                          permitted->t.hi.nearest_double()),
              farther_coordinate(*permitted));
    }
  }

  std::optional<TextureTruth::Filtered> filter(const Coordinates& at,
                                               const oracle::TriangleTruth& truth,
                                               const cases::SamplePlace& place) {
    if (texturing_->filter == Filter::bilinear) {
      return truth_.bilinear(at.s, at.t, greatest_, bounds_);
    }
    const auto slopes = [&](std::size_t attribute) {
      return truth.scaled_derivatives(attribute, static_cast<int>(place.x),
                                      static_cast<int>(place.y), static_cast<int>(place.sample));
    };
    const auto s = slopes(0);
    const auto t = slopes(1);
    if (!s || !t) return std::nullopt;
    const records::Enclosure level = truth_.level_of_detail(*s, *t, bounds_);
    add_level_labels(level);
    return truth_.trilinear(at.s, at.t, level, greatest_, bounds_);
  }

  void add_level_labels(const records::Enclosure& level) {
    const auto last = static_cast<double>(truth_.level_count() - 1);
    if (level.hi <= 0 || last == 0) {
      tally_.label("level 0");
    } else if (level.lo >= last) {
      tally_.label("last level");
    } else {
      tally_.label("between levels");
    }
  }

  /// `attribute` is the coordinate that a violation is reported of.
  void compare(const cases::SamplePlace& place, std::uint32_t channel,
               const oracle::FilteredChannel& filtered, float actual, const std::string& where,
               std::uint32_t attribute) {
    if (is_within(filtered.allowed, actual)) return tally_.pass(kind_of(*case_, channel % 2));
    tally_.report(violation_at(
        place, class_of_wrong(actual, FragmentClass::beyond_bound),
        oracle::to_string(filtered.exact),
        fmt::format("channel {} of a {}×{} texture, {}, {}, at {}; allowed is {} to {}", channel,
                    texturing_->texture.width, texturing_->texture.height, wrap_words(*texturing_),
                    texturing_->filter == Filter::bilinear ? "bilinear" : "trilinear", where,
                    filtered.allowed.lo.enclosure().lo, filtered.allowed.hi.enclosure().hi),
        {kind_of(*case_, attribute), attribute, actual}));
  }

  const cases::Case* case_;
  cases::TextureBounds bounds_;
  bool is_in_range_;  ///< the contract leaves coordinates in a range
  SeenTriangles seen_;
  const cases::Texturing* texturing_;
  TextureTruth truth_;
  const cases::Picture* picture_;
  oracle::CoordinateSizes greatest_;
  LookupCoordinates lookups_;
  Tally tally_;
};

bool is_promised(backends::Backend& backend) {
  return backend.picture_drawer() != nullptr && backend.contract({}).texture_bounds.has_value();
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  if (!is_promised(backend) || clip.attributes.size() < 2)
    return not_applicable(
        "the backend promises no filtering, or the case has no texture coordinates");
  const cases::Contract contract = backend.contract(clip);
  const cases::Pipeline pipeline = pipeline_of(clip, !contract.picture_bounds.has_value());
  const Result<cases::Picture> picture = draw_picture(clip, backend, pipeline);
  if (!picture) return tl::unexpected(picture.error());
  return FilterCheck(clip, backend, contract, *pipeline.texturing, *picture).run();
}

const LawRegistration kRegistration(
    {.id = "filtered-colours-stay-within-the-bound",
     .sentence = "filtered colours stay within the bound",
     .reason =
         "The exact colour is a continuous polynomial of exact coordinates, whose steps are known.",
     .exceptions = "samples whose coordinates or level of detail have no single exact value; "
                   "backends that promise no bound of textures",
     .generate = &textured_case,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend draws no pictures or promises no bound for filtered colours",
     .covers = {cover(9, "between levels"), cover(25, "bilinear"), cover(8, "clipped"),
                cover(7, "last level"), cover(6, "level 0"), cover(14, "several samples"),
                cover(24, "trilinear")}});

}  // namespace
}  // namespace rastercheck::properties::filtered_colours_stay_within_the_bound_law
