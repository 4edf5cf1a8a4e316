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
// Samples: all, including those without a fragment. Any two NaNs are the same. Only backends that
// draw pictures are judged.

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
  PictureCheck(const cases::Case& c, const cases::Pipeline& pipeline,
               const cases::Fragments& fragments, const cases::Picture& picture)
      : case_(&c),
        pipeline_(&pipeline),
        expected_(picture_of(c, fragments, pipeline)),
        picture_(&picture),
        triangles_(expected_.depth.size()),
        tally_(c) {
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const cases::SamplePlace place = fragments.place_of(i);
      if (!is_of_case(c, place)) continue;
      triangles_[index_at(expected_, place)].push_back(place.triangle);
    }
  }

  Check run() {
    add_labels(*case_, *pipeline_, tally_);
    for (std::size_t at = 0; at < expected_.depth.size(); ++at) {
      if (triangles_[at].size() > 1) tally_.label("overdraw");
      if (!triangles_[at].empty()) tally_.pass_required(triangles_[at].front());
      for (const std::uint32_t triangle : triangles_[at]) tally_.see(triangle);
      compare(at, std::nullopt, expected_.depth[at], picture_->depth[at]);
      for (std::uint32_t channel = 0; channel < expected_.channels; ++channel) {
        const std::size_t index = at * expected_.channels + channel;
        compare(at, channel, expected_.color[index], picture_->color[index]);
      }
    }
    return tally_.finish();
  }

 private:
  void compare(std::size_t at, std::optional<std::uint32_t> channel, float expected, float actual) {
    if (is_same(actual, expected)) return tally_.pass(kind_of_channel(*case_, channel));
    const std::vector<std::uint32_t>& triangles = triangles_[at];
    records::Violation violation = picture_violation(
        *case_, *picture_, at, channel, expected,
        fmt::format("{} fragments there; {}", triangles.size(), text_of(*pipeline_)));
    violation.place.triangle = triangles.empty() ? 0 : triangles.back();
    tally_.report(violation);
  }

  const cases::Case* case_;
  const cases::Pipeline* pipeline_;
  cases::Picture expected_;
  const cases::Picture* picture_;
  std::vector<std::vector<std::uint32_t>>
      triangles_;  ///< [sample of the picture]: the triangles drawn there
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  if (backend.picture_drawer() == nullptr) return not_applicable("the backend draws no pictures");
  clip.depth_test = cases::DepthTest::none;
  const cases::Pipeline pipeline = pipeline_of(clip);
  const Result<backends::Drawn> fragments = draw_promised(clip, backend);
  if (!fragments) return tl::unexpected(fragments.error());
  const Result<cases::Picture> picture = draw_picture(clip, backend, pipeline);
  if (!picture) return tl::unexpected(picture.error());
  return PictureCheck(clip, pipeline, fragments->fragments, *picture).run();
}

const LawRegistration kRegistration(
    {.id = "a-picture-is-what-its-fragments-leave",
     .sentence = "a picture is what its fragments leave",
     .reason = "Depth tests compare floats, and blending and formats are IEEE arithmetic with "
               "every rounding named.",
     .exceptions = "backends that draw no pictures",
     .generate = &overlapping_case,
     .check = &check,
     .is_promised = &draws_pictures,
     .unpromised = "the backend draws no pictures",
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
