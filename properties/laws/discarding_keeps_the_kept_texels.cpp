// Discarded fragments leave no trace: with Pipeline::discard_below, the picture is the same as if
// fragments whose texel has an alpha below the limit did not exist. They affect neither colour nor
// depth.
//
// Why. MIT 6.837 2000, lecture 18, draws transparency this way: if a texel's alpha is 0, neither
// the pixel nor its depth is written, and what lies behind shows. A fragment's texel is exact
// ("texels are those of the exact coordinates"), and so is the comparison of k/255 with the limit.
// See properties/laws/internal/picture_model.h for how fragments make a picture. Their depths are
// those that the backend itself draws.
//
// A pseudorandom number of the case (choices.h) chooses the texture, its wrap modes, the limit,
// whether depths are written, blend and format. Filtering is nearest, and the depth test is `less`.
// The coordinates are the first two attributes.
//
// Samples: some of those at which both coordinates of every fragment have a single exact value.
// Depths and colours must agree to the bit. A driver's coordinates are those that it draws itself,
// and those far from 0 are left out: how good coordinates are, and how they are wrapped, is for
// "texels are those of the exact coordinates" to judge. Near the border of a texel, all texels that
// a driver may look up (cases::PictureBounds) must have one colour, with an alpha that no permitted
// error takes across the limit. Its colours must be within its bounds. Only backends that draw
// pictures, of the fragments that they draw, are judged.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "oracle/texture_truth.h"
#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/lookup_coordinates.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/picture_model.h"
#include "properties/laws/internal/seen_triangles.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/textured_cases.h"

namespace rastercheck::properties::discarding_keeps_the_kept_texels_law {
namespace {

using oracle::TextureTruth;
using records::AttributeKind;
using records::FragmentClass;

/// The greatest number of samples of a case that are judged.
constexpr std::size_t kMostSamples = 24;
constexpr std::size_t kChannels = 4;
/// The greatest magnitude of a driver's coordinates that are judged. OpenGL 1.1, 2.1.1, promised no
/// greater ones.
constexpr float kMostCoordinate = 1024;

cases::Pipeline pipeline_of(const cases::Case& c) {
  Choices choices(choices_of(c));
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::less;
  pipeline.writes_depth = choices.below(4) != 0;
  pipeline.blend = choices.pick(
      std::array{cases::Blend::off, cases::Blend::off, cases::Blend::over, cases::Blend::additive});
  pipeline.format = choices.below(2) == 0 ? cases::ColorFormat::rgba8 : cases::ColorFormat::float32;
  // In two picks of five, the limit is the alpha of some byte; else it is 0.5, tiny or 1.
  const auto byte = static_cast<float>(choices.below(256));
  const float limit = choices.pick(std::array{byte / 255, byte / 255, 0.5F, 0x1p-20F, 1.0F});
  pipeline.texturing = texturing_of(choices, &noise_byte);
  pipeline.discard_below = limit;
  return pipeline;
}

/// [sample]: its fragments, in submission order.
using FragmentsAt = std::map<std::size_t, std::vector<std::size_t>>;

class DiscardCheck {
 public:
  DiscardCheck(const cases::Case& c, const cases::Contract& contract,
               const cases::Pipeline& pipeline, const cases::Fragments& fragments,
               const cases::Picture& picture)
      : case_(&c),
        bounds_(contract.picture_bounds),
        seen_(c, contract),
        pipeline_(&pipeline),
        truth_(*pipeline.texturing),
        fragments_(&fragments),
        picture_(&picture),
        tally_(c) {
    kept_.attribute_count = kChannels;
  }

  Check run() {
    std::vector<std::size_t> judged;
    for (const auto& [at, fragments] : some_samples()) {
      if (keep(fragments)) judged.push_back(at);
    }
    compare(judged);
    return tally_.finish();
  }

 private:
  /// Selects at most kMostSamples samples, spread evenly.
  FragmentsAt some_samples() const {
    FragmentsAt all;
    for (std::size_t i = 0; i < fragments_->size(); ++i) {
      const cases::SamplePlace place = fragments_->place_of(i);
      if (is_of_case(*case_, place)) all[index_at(*picture_, place)].push_back(i);
    }
    if (all.size() <= kMostSamples) return all;
    FragmentsAt some;
    std::size_t k = 0;
    for (const auto& [at, fragments] : all) {
      const bool is_next = some.size() * all.size() <= k * kMostSamples;
      if (is_next) some.emplace(at, fragments);
      ++k;
    }
    return some;
  }

  /// Keeps the fragments of a sample that are not discarded. Returns false if it is uncertain which
  /// fragments these are.
  bool keep(const std::vector<std::size_t>& fragments) {
    std::vector<TextureTruth::Color> colors;
    for (const std::size_t i : fragments) {
      const cases::SamplePlace place = fragments_->place_of(i);
      const oracle::TriangleTruth& truth = seen_.truth(place.triangle);
      const bool is_required = truth
                                   .judge(static_cast<int>(place.x), static_cast<int>(place.y),
                                          static_cast<int>(place.sample))
                                   .verdict != records::Verdict::forbidden;
      const auto color = is_required ? color_at(truth, i) : std::nullopt;
      if (!color) {
        tally_.label("no one coordinate");
        return false;
      }
      colors.push_back(*color);
    }
    for (std::size_t k = 0; k < fragments.size(); ++k) {
      tally_.see(fragments_->triangle[fragments[k]]);
      const float alpha = static_cast<float>(colors[k].back()) / 255;
      const float limit = *pipeline_->discard_below;
      tally_.label(alpha < limit ? "discarded" : "kept");
      if (alpha == limit) tally_.label("exactly the limit");
      if (alpha >= limit) add_kept(fragments[k], colors[k]);
    }
    if (fragments.size() > 1) tally_.label("overdraw");
    return true;
  }

  /// The only colour that a fragment may have; empty if it may have several, or if its alpha may
  /// be on either side of the limit.
  std::optional<TextureTruth::Color> color_at(const oracle::TriangleTruth& truth,
                                              std::size_t fragment) const {
    if (!bounds_) {
      const auto exact = exact_coordinates(truth, fragments_->place_of(fragment));
      return exact ? std::optional(truth_.nearest(exact->s, exact->t)) : std::nullopt;
    }
    const auto values = fragments_->attributes_of(fragment);
    const bool are_near =
        std::abs(values[0]) <= kMostCoordinate && std::abs(values[1]) <= kMostCoordinate;
    if (!are_near) return std::nullopt;
    const auto at = ranges_of(values[0], values[1]);
    if (!at) return std::nullopt;
    const std::vector<TextureTruth::Color> colors = truth_.nearest_within(*at, *bounds_);
    if (colors.size() != 1) return std::nullopt;
    const double alpha = colors.front().back() / 255.0;
    const double limit{*pipeline_->discard_below};
    if (std::abs(alpha - limit) <= color_error()) return std::nullopt;
    return colors.front();
  }

  /// How far a texel's colour k/255 may be off in a driver's float32.
  double color_error() const { return (double{bounds_->float_error} + 1) * 0x1p-24; }

  void add_kept(std::size_t i, const TextureTruth::Color& color) {
    kept_.triangle.push_back(fragments_->triangle[i]);
    kept_.x.push_back(fragments_->x[i]);
    kept_.y.push_back(fragments_->y[i]);
    kept_.sample.push_back(fragments_->sample[i]);
    kept_.depth.push_back(fragments_->depth[i]);
    for (const std::uint8_t byte : color) {
      kept_.attributes.push_back(static_cast<float>(byte) / 255);
    }
  }

  void compare(const std::vector<std::size_t>& judged) {
    cases::Case colored = *case_;  // the model's channels are attributes
    colored.attributes.assign(kChannels, {});
    cases::Pipeline untextured = *pipeline_;
    untextured.texturing.reset();
    untextured.discard_below.reset();
    PictureRange expected = range_of(colored, kept_, untextured, bounds_);
    if (bounds_ && pipeline_->format == cases::ColorFormat::float32) widen(expected);
    for (const std::size_t at : judged) {
      ++tally_.counts().required;
      tally_.pass(AttributeKind::coverage);
      const float depth = expected.least.depth[at];
      compare_number(at, std::nullopt, is_same(depth, picture_->depth[at]), depth,
                     picture_->depth[at]);
      for (std::uint32_t channel = 0; channel < kChannels; ++channel) {
        const std::size_t index = at * kChannels + channel;
        const float color = picture_->color[index];
        compare_number(at, channel, expected.has_color(index, color), expected.least.color[index],
                       color);
      }
    }
  }

  /// Adds the errors of texels' colours. Each of a sample's fragments changes a colour by at most
  /// twice its own error and once that of its alpha, as colours lie in [0, 1]; additive blending
  /// changes it by less.
  void widen(PictureRange& range) const {
    std::vector<float> errors(range.least.depth.size());
    const auto one = static_cast<float>(3 * color_error());
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      errors[index_at(range.least, kept_.place_of(i))] += one;
    }
    for (std::size_t i = 0; i < range.least.color.size(); ++i) {
      range.least.color[i] -= errors[i / kChannels];
      range.greatest.color[i] += errors[i / kChannels];
    }
  }

  void compare_number(std::size_t at, std::optional<std::uint32_t> channel, bool is_permitted,
                      float expected, float actual) {
    const AttributeKind kind = channel
                                   ? records::kind_of(case_->attributes[*channel % 2].interpolation)
                                   : AttributeKind::depth;
    if (is_permitted) return tally_.pass(kind);
    const cases::Texturing& texturing = *pipeline_->texturing;
    const std::string what = channel ? fmt::format("channel {}", *channel) : "the depth";
    const auto attribute = channel ? std::optional(*channel % 2) : std::nullopt;
    tally_.report(violation_at(
        place_at(*picture_, at), class_of_wrong(actual, FragmentClass::beyond_bound),
        value_text(expected),
        fmt::format("{} with a {}×{} texture, alpha below {} discarded", what,
                    texturing.texture.width, texturing.texture.height, *pipeline_->discard_below),
        {kind, attribute, actual}));
  }

  const cases::Case* case_;
  std::optional<cases::PictureBounds> bounds_;
  SeenTriangles seen_;
  const cases::Pipeline* pipeline_;
  TextureTruth truth_;
  const cases::Fragments* fragments_;
  const cases::Picture* picture_;
  cases::Fragments kept_;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  if (!keeps_fragments_in_pictures(backend) || clip.attributes.size() < 2)
    return not_applicable(
        "the backend promises no pictures of its fragments, or the case has no texture "
        "coordinates");
  clip.depth_test = cases::DepthTest::none;
  const cases::Pipeline pipeline = pipeline_of(clip);
  const Result<backends::Drawn> fragments = draw_promised(clip, backend);
  if (!fragments) return tl::unexpected(fragments.error());
  if (!keeps_fragments_in_pictures(fragments->contract)) return not_applicable(kOtherFragments);
  const Result<cases::Picture> picture = draw_picture(clip, backend, pipeline);
  if (!picture) return tl::unexpected(picture.error());
  return DiscardCheck(clip, fragments->contract, pipeline, fragments->fragments, *picture).run();
}

/// Makes overlapping triangles, some of which show others through their texels.
Generated generate(Draw& draw) {
  Generated made = overlapping_case(draw);
  set_coordinates(draw, made.source);
  return made;
}

const LawRegistration kRegistration(
    {.id = "discarding-draws-what-keeping-the-kept-texels-draws",
     .sentence = "discarding draws what keeping the kept texels draws",
     .reason = "A discarded fragment leaves neither colour nor depth, and which texel a fragment "
               "has is exact.",
     .exceptions = "fragments that may have several texels; backends that draw no pictures, or "
                   "pictures of other fragments than they draw",
     .generate = &generate,
     .check = &check,
     .is_promised = &keeps_fragments_in_pictures,
     .unpromised = "the backend draws no pictures, or pictures of other fragments than it draws",
     .covers = {cover(5, "clipped"), cover(38, "discarded"), cover(7, "exactly the limit"),
                cover(38, "kept"), cover(30, "overdraw"), cover(15, "several samples")}});

}  // namespace
}  // namespace rastercheck::properties::discarding_keeps_the_kept_texels_law
