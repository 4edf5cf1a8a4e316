// Texels are those of the exact coordinates: nearest filtering takes the texel that contains the
// exact rational s and t, and the colour is k/255 to the bit.
//
// Why. RULES §4 gives a fragment exactly one s and one t; ⌊s W⌋, wrapped, is an integer, with
// nothing to round. A coordinate that is rounded first is sometimes on the wrong side of a texel's
// border, and the colour is off by a whole texel. That makes seams between tiles, as does the cast
// to `int` in MIT 6.837 2000, lecture 18, which rounds coordinates below 0 upwards. Every texel's
// colour identifies the texel, so a violation tells which one was taken.
//
// A pseudorandom number of the case (choices.h) chooses the texture's size, its wrap modes and the
// picture's format; the coordinates are the first two attributes. Without depth test and blending,
// the last triangle drawn is visible.
//
// A driver's contract leaves its coordinates in a range, and lets it look up texels somewhat off
// (cases::PictureBounds). If its pictures have the fragments that it draws, its coordinates are
// those that it draws itself. Its colour must be that of one of the texels within.
//
// Samples: some of the drawn samples at which the last triangle is required and both coordinates
// have a single exact value or, for a driver, permit few texels. That excludes noperspective
// coordinates of triangles with some w <= 0 and centroids whose place is open. Only backends that
// draw pictures are judged.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "oracle/texture_truth.h"
#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/lookup_coordinates.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/seen_triangles.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/textured_cases.h"

namespace rastercheck::properties::texels_of_exact_coordinates_law {
namespace {

using oracle::TextureTruth;
using records::FragmentClass;

/// The greatest number of samples of a case that are judged.
constexpr std::size_t kMostSamples = 64;

/// Red encodes the column, green the row; no byte is 0.
std::uint8_t naming_byte(int i, int j, std::size_t channel) {
  switch (channel) {
    case 0:
      return static_cast<std::uint8_t>(4 * i + 3);
    case 1:
      return static_cast<std::uint8_t>(4 * j + 3);
    case 2:
      return static_cast<std::uint8_t>(255 - (7 * i + 13 * j) % 255);
    default:
      return static_cast<std::uint8_t>(255 - (i ^ j));
  }
}

cases::Pipeline pipeline_of(const cases::Case& c) {
  Choices choices(choices_of(c));
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::always;
  pipeline.format = choices.below(3) == 0 ? cases::ColorFormat::rgba8 : cases::ColorFormat::float32;
  pipeline.texturing = texturing_of(choices, &naming_byte);
  return pipeline;
}

std::string text_of(const TextureTruth::Color& color) {
  return fmt::format("texel ({}, {})", (color[0] - 3) / 4, (color[1] - 3) / 4);
}

class TexelCheck {
 public:
  TexelCheck(const cases::Case& c, backends::Backend& backend, const cases::Pipeline& pipeline,
             const cases::Picture& picture)
      : TexelCheck(c, backend, backend.contract(c), pipeline, picture) {}

  Check run() {
    for (const std::size_t at : some_drawn_samples(*picture_, kMostSamples)) check_sample(at);
    return tally_.finish();
  }

 private:
  TexelCheck(const cases::Case& c, backends::Backend& backend, const cases::Contract& contract,
             const cases::Pipeline& pipeline, const cases::Picture& picture)
      : case_(&c),
        bounds_(contract.picture_bounds),
        color_error_(bounds_ ? color_error(*bounds_, pipeline.format) : 0),
        seen_(c, contract),
        texturing_(&*pipeline.texturing),
        truth_(*pipeline.texturing),
        picture_(&picture),
        lookups_(c, backend, contract),
        tally_(c) {}

  void check_sample(std::size_t at) {
    const auto place = seen_.find(*picture_, at);
    if (!place) return;
    const oracle::TriangleTruth& truth = seen_.truth(place->triangle);
    if (bounds_) return check_within(at, *place, truth);
    const auto exact = exact_coordinates(truth, *place);
    if (!exact) return tally_.label("no one coordinate");
    tally_.pass_required(place->triangle);
    add_labels(exact->s, texturing_->texture.width, texturing_->wrap_s);
    add_labels(exact->t, texturing_->texture.height, texturing_->wrap_t);
    compare(at, *place, *exact);
  }

  /// Checks a colour of a driver.
  void check_within(std::size_t at, const cases::SamplePlace& place,
                    const oracle::TriangleTruth& truth) {
    const auto permitted = lookups_.find(truth, place);
    if (!permitted) return tally_.label("no one coordinate");
    const std::vector<TextureTruth::Color> colors = truth_.nearest_within(*permitted, *bounds_);
    if (colors.empty()) return tally_.label("no one coordinate");
    tally_.pass_required(place.triangle);
    tally_.label(colors.size() == 1 ? "one texel" : "one of several texels");
    const float* const drawn = &picture_->color[at * colors.front().size()];
    const bool is_permitted =
        std::any_of(colors.begin(), colors.end(), [&](const TextureTruth::Color& color) {
          return std::equal(color.begin(), color.end(), drawn, [&](std::uint8_t byte, float value) {
            return std::abs(double{value} - byte / 255.0) <= color_error_;
          });
        });
    if (is_permitted) return tally_.pass(kind_of(*case_, 0));
    const std::uint32_t attribute = farther_coordinate(*permitted);
    records::Violation violation = violation_at(
        place, class_of_wrong(drawn[0], FragmentClass::beyond_bound), text_of(colors.front()),
        fmt::format("or {} others; a {}×{} texture, {}, s from {} to {}, t from {} to {}",
                    colors.size() - 1, texturing_->texture.width, texturing_->texture.height,
                    wrap_words(*texturing_), permitted->s.lo.nearest_double(),
                    permitted->s.hi.nearest_double(), permitted->t.lo.nearest_double(),
                    permitted->t.hi.nearest_double()),
        {kind_of(*case_, attribute), attribute, drawn[0]});
    violation.actual = fmt::format("{}, {} of 255", value_text(drawn[0]), drawn[0] * 255);
    tally_.report(violation);
  }

  /// How far a colour k/255 may be off, once it is stored.
  static double color_error(const cases::PictureBounds& bounds, cases::ColorFormat format) {
    // The picture's own float is off by at most half a unit of a number up to 1.
    const double in_float = (double{bounds.float_error} + 1) * 0x1p-24;
    if (format == cases::ColorFormat::float32) return in_float;
    return (double{bounds.byte_store} - 0.5) / 255 + in_float;
  }

  void add_labels(const oracle::Rational& coordinate, int size, cases::Wrap wrap) {
    const oracle::TexelIndex index = oracle::texel_index(coordinate, size, wrap);
    if (index.is_on_border) tally_.label("texel border");
    if (index.is_beyond) tally_.label("beyond 0 to 1");
    tally_.label(to_word(wrap));
  }

  void compare(std::size_t at, const cases::SamplePlace& place, const Coordinates& exact) {
    const TextureTruth::Color color = truth_.nearest(exact.s, exact.t);
    for (std::uint32_t channel = 0; channel < color.size(); ++channel) {
      const float actual = picture_->color[at * color.size() + channel];
      const float expected = static_cast<float>(color[channel]) / 255;
      // Reports a wrong texel once, not once per channel.
      if (!is_same(actual, expected)) return report(place, channel, color, exact, actual);
      tally_.pass(kind_of(*case_, channel % 2));
    }
  }

  void report(const cases::SamplePlace& place, std::uint32_t channel,
              const TextureTruth::Color& color, const Coordinates& exact, float actual) {
    records::Violation violation =
        violation_at(place, class_of_wrong(actual, FragmentClass::beyond_bound), text_of(color),
                     fmt::format("channel {} of a {}×{} texture, {}, at s = {}, t = {}", channel,
                                 texturing_->texture.width, texturing_->texture.height,
                                 wrap_words(*texturing_), exact.s.to_string(), exact.t.to_string()),
                     {kind_of(*case_, channel % 2), channel % 2, actual});
    violation.actual = fmt::format("{}, {} of 255", value_text(actual), actual * 255);
    tally_.report(violation);
  }

  const cases::Case* case_;
  std::optional<cases::PictureBounds> bounds_;
  double color_error_;  ///< 0 without bounds
  SeenTriangles seen_;
  const cases::Texturing* texturing_;
  TextureTruth truth_;
  const cases::Picture* picture_;
  LookupCoordinates lookups_;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  if (backend.picture_drawer() == nullptr || clip.attributes.size() < 2)
    return not_applicable("the backend draws no pictures, or the case has no texture coordinates");
  const cases::Pipeline pipeline = pipeline_of(clip);
  const Result<cases::Picture> picture = draw_picture(clip, backend, pipeline);
  if (!picture) return tl::unexpected(picture.error());
  return TexelCheck(clip, backend, pipeline, *picture).run();
}

const LawRegistration kRegistration(
    {.id = "texels-are-those-of-the-exact-coordinates",
     .sentence = "texels are those of the exact coordinates",
     .reason = "A fragment has one s and one t, and ⌊s W⌋ is a whole number with nothing to round.",
     .exceptions =
         "samples whose coordinates have no single exact value and permit many texels; backends "
         "that draw no pictures",
     .generate = &textured_case,
     .check = &check,
     .is_promised = &draws_pictures,
     .unpromised = "the backend draws no pictures",
     .covers = {cover(37, "beyond 0 to 1"), cover(15, "clamp"), cover(10, "clipped"),
                cover(17, "mirror"), cover(29, "repeat"), cover(14, "several samples"),
                cover(16, "texel border")}});

}  // namespace
}  // namespace rastercheck::properties::texels_of_exact_coordinates_law
