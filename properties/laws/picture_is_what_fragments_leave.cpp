// A picture is what its fragments leave: depth test, write mask, blending, colour format and
// resolve follow properties/laws/internal/picture_model.h, sample by sample and in submission
// order, to the bit.
//
// Why. The last stages of a pipeline leave the implementation no freedom here: depths are compared
// as floats, blending is IEEE arithmetic in double with each rounding specified, and so is the
// rounding to the stored float or byte. Other laws judge which fragments are drawn with which
// values; the model takes the fragments that the backend itself draws of the case without a depth
// test.
//
// A pseudorandom number of the case (choices.h) chooses the pipeline: one of the eight depth
// functions, whether depths are written, the clear depth, a blend (`over` only with four channels),
// a format, and whether the samples are resolved. Channels are the attributes or, as vertex colours
// (Gouraud shading), the first three or four of them.
//
// A driver may round otherwise where its API leaves that open (cases::PictureBounds): then colours
// must lie within what the model permits.
//
// Samples: all, including those without a fragment. Any two NaNs are the same. Only backends that
// draw pictures are judged, and only if they promise that a picture has the fragments that they
// draw.

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/picture_model.h"
#include "properties/laws/internal/pipelines.h"
#include "properties/laws/internal/same_picture.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties::picture_is_what_fragments_leave_law {
namespace {

void add_labels(const cases::Case& c, const cases::Pipeline& pipeline, Tally& tally) {
  tally.label("depth " + std::string(word_of(pipeline.depth_function)));
  tally.label("blend " + std::string(word_of(pipeline.blend)));
  if (!pipeline.writes_depth) tally.label("depth not written");
  if (pipeline.shading == cases::Shading::vertex_colors) {
    tally.label(c.attributes.size() == 3 ? "vertex colours without alpha" : "vertex colours");
  }
  if (pipeline.format == cases::ColorFormat::rgba8) tally.label("rgba8");
  if (pipeline.resolves && c.framebuffer.samples > 1) tally.label("resolved");
}

class PictureCheck {
 public:
  PictureCheck(const cases::Case& c, const cases::Pipeline& pipeline, const backends::Drawn& drawn,
               const cases::Picture& picture)
      : case_(&c),
        pipeline_(&pipeline),
        expected_(range_of(c, drawn.fragments, pipeline, drawn.contract.picture_bounds)),
        picture_(&picture),
        triangles_(picture.depth.size()),
        tally_(c) {
    for (std::size_t i = 0; i < drawn.fragments.size(); ++i) {
      const cases::SamplePlace place = drawn.fragments.place_of(i);
      if (!is_of_case(c, place)) continue;
      triangles_[index_at(picture, place)].push_back(place.triangle);
    }
  }

  Check run() {
    add_labels(*case_, *pipeline_, tally_);
    const cases::Picture& least = expected_.least;
    for (std::size_t at = 0; at < least.depth.size(); ++at) {
      if (triangles_[at].size() > 1) tally_.label("overdraw");
      if (!triangles_[at].empty()) tally_.pass_required(triangles_[at].front());
      for (const std::uint32_t triangle : triangles_[at]) tally_.see(triangle);
      if (is_same(picture_->depth[at], least.depth[at])) {
        tally_.pass(records::AttributeKind::depth);
      } else {
        report(at, std::nullopt, least.depth[at], "");
      }
      for (std::uint32_t channel = 0; channel < least.channels; ++channel) compare(at, channel);
    }
    return tally_.finish();
  }

 private:
  void compare(std::size_t at, std::uint32_t channel) {
    const std::size_t index = at * expected_.least.channels + channel;
    if (expected_.has_color(index, picture_->color[index])) {
      return tally_.pass(kind_of_channel(*case_, channel));
    }
    const float least = expected_.least.color[index];
    const float greatest = expected_.greatest.color[index];
    report(at, channel, least,
           least == greatest ? "" : fmt::format("; {} to {} is permitted", least, greatest));
  }

  void report(std::size_t at, std::optional<std::uint32_t> channel, float expected,
              const std::string& permitted) {
    const std::vector<std::uint32_t>& triangles = triangles_[at];
    records::Violation violation = picture_violation(
        *case_, *picture_, at, channel, expected,
        fmt::format("{} fragments there; {}{}", triangles.size(), text_of(*pipeline_), permitted));
    violation.place.triangle = triangles.empty() ? 0 : triangles.back();
    tally_.report(violation);
  }

  const cases::Case* case_;
  const cases::Pipeline* pipeline_;
  PictureRange expected_;
  const cases::Picture* picture_;
  std::vector<std::vector<std::uint32_t>>
      triangles_;  ///< [sample of the picture]: the triangles drawn there
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  if (!keeps_fragments_in_pictures(backend)) {
    return not_applicable(kOtherFragments);
  }
  clip.depth_test = cases::DepthTest::none;
  const cases::Pipeline pipeline = pipeline_of(clip);
  const Result<backends::Drawn> fragments = draw_promised(clip, backend);
  if (!fragments) return tl::unexpected(fragments.error());
  if (!keeps_fragments_in_pictures(fragments->contract)) return not_applicable(kOtherFragments);
  const Result<cases::Picture> picture = draw_picture(clip, backend, pipeline);
  if (!picture) return tl::unexpected(picture.error());
  return PictureCheck(clip, pipeline, *fragments, *picture).run();
}

const LawRegistration kRegistration(
    {.id = "a-picture-is-what-its-fragments-leave",
     .sentence = "a picture is what its fragments leave",
     .reason = "Depth tests compare floats, and blending and formats are IEEE arithmetic with "
               "every rounding named.",
     .exceptions = "backends that draw no pictures, or pictures of other fragments than they draw",
     .generate = &overlapping_case,
     .check = &check,
     .is_promised = &keeps_fragments_in_pictures,
     .unpromised = "the backend draws no pictures, or pictures of other fragments than it draws",
     .covers = {cover(21, "blend additive"),
                cover(12, "blend off"),
                cover(16, "blend over"),
                cover(8, "clipped"),
                cover(5, "depth always"),
                cover(7, "depth equal"),
                cover(5, "depth greater"),
                cover(6, "depth greater or equal"),
                cover(6, "depth less"),
                cover(5, "depth less or equal"),
                cover(6, "depth never"),
                cover(6, "depth not equal"),
                cover(12, "depth not written"),
                cover(37, "overdraw"),
                cover(5, "resolved"),
                cover(15, "rgba8"),
                cover(17, "several samples"),
                cover(12, "vertex colours"),
                cover(5, "vertex colours without alpha"),
                cover(6, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::picture_is_what_fragments_leave_law
