// A picture is what its fragments leave: depth test, write mask, blending, colour format and
// resolve do, sample by sample and in submission order, what properties/picture_model.h says, to
// the bit.
//
// Why. Nothing of a pipeline's last stage is left to the implementation here: depths are compared
// as the floats they are, blending is IEEE arithmetic in double with each rounding named, and so is
// what a float or a byte holds of the result. Which fragments there are, with which values, is for
// other laws to judge: the model takes what the backend itself draws of the case without a depth
// test.
//
// The pipeline is chosen by the case's numbers: one of the eight depth functions, whether depths
// are written, what they are cleared to, a blend (`over` only of four channels), a format, and
// whether the samples are resolved. Attributes are the channels, or, as vertex colours, the first
// three or four of them are: Gouraud's shading.
//
// Samples: all, those without a fragment too. NaNs are alike, whatever their bits. Judged of
// backends that draw pictures.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "oracle/transform.h"
#include "properties/internal/drawn_fragments.h"
#include "properties/internal/picture_cases.h"
#include "properties/internal/pipelines.h"
#include "properties/internal/same_picture.h"
#include "properties/judged_law.h"
#include "properties/picture_model.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::FragmentClass;

std::vector<std::string> labels_of(const cases::Case& c, const cases::Pipeline& pipeline,
                                   const std::set<std::uint32_t>& drawn, std::size_t most) {
  std::set<std::string> labels;
  labels.insert("depth " + std::string(word_of(pipeline.depth_function)));
  labels.insert("blend " + std::string(word_of(pipeline.blend)));
  if (!pipeline.writes_depth) labels.emplace("depth not written");
  if (pipeline.shading == cases::Shading::vertex_colors) {
    labels.emplace(c.attributes.size() == 3 ? "vertex colours without alpha" : "vertex colours");
  }
  if (pipeline.format == cases::ColorFormat::rgba8) labels.emplace("rgba8");
  if (pipeline.resolves && c.framebuffer.samples > 1) labels.emplace("resolved");
  if (most > 1) labels.emplace("overdraw");
  add_state_labels(c, drawn, labels);
  return {labels.begin(), labels.end()};
}

class PictureCheck {
 public:
  PictureCheck(const cases::Case& c, const cases::Pipeline& pipeline,
               const cases::Framebuffer& fragments, const cases::Picture& picture)
      : case_(&c),
        pipeline_(&pipeline),
        expected_(picture_of(c, fragments, pipeline)),
        picture_(&picture),
        triangles_(expected_.depth.size()) {
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const FragmentPlace place = place_of(fragments, i);
      if (!is_of_case(c, place)) continue;
      triangles_[index_of(place)].push_back(place.triangle);
    }
  }

  Check run() {
    check_.judgement.errors[AttributeKind::coverage];
    std::size_t most = 0;
    std::set<std::uint32_t> drawn;
    for (std::size_t at = 0; at < expected_.depth.size(); ++at) {
      most = std::max(most, triangles_[at].size());
      drawn.insert(triangles_[at].begin(), triangles_[at].end());
      if (!triangles_[at].empty()) {
        ++check_.judgement.counts.required;
        ++check_.judgement.errors[AttributeKind::coverage].classes[FragmentClass::correct];
      }
      compare(at, std::nullopt, expected_.depth[at], picture_->depth[at]);
      for (std::uint32_t channel = 0; channel < expected_.channels; ++channel) {
        const std::size_t index = at * expected_.channels + channel;
        compare(at, channel, expected_.color[index], picture_->color[index]);
      }
    }
    check_.labels = labels_of(*case_, *pipeline_, drawn, most);
    return std::move(check_);
  }

 private:
  /// Of the picture's samples, as it counts them.
  std::size_t index_of(const FragmentPlace& place) const {
    const auto samples = static_cast<std::size_t>(expected_.size.samples);
    const std::size_t pixel =
        std::size_t{place.y} * static_cast<std::size_t>(expected_.size.width) + place.x;
    return pixel * samples + (samples > 1 ? place.sample : 0);
  }

  void compare(std::size_t at, std::optional<std::uint32_t> channel, float expected, float actual) {
    const FragmentClass found = class_of(actual, expected);
    ++check_.judgement.errors[kind_of_channel(*case_, channel)].classes[found];
    if (found == FragmentClass::correct) return;
    const std::vector<std::uint32_t>& triangles = triangles_[at];
    records::Violation violation = picture_violation(
        *case_, *picture_, at, channel, expected,
        fmt::format("{} fragments there; {}", triangles.size(), text_of(*pipeline_)));
    violation.triangle = triangles.empty() ? 0 : triangles.back();
    note(check_, violation);
  }

  const cases::Case* case_;
  const cases::Pipeline* pipeline_;
  cases::Picture expected_;
  const cases::Picture* picture_;
  std::vector<std::vector<std::uint32_t>>
      triangles_;  ///< [sample of the picture]: those drawn there
  Check check_;
};

bool draws_pictures(const backends::Backend& backend) { return backend.draws_pictures(); }

Result<Check> check(const cases::Case& c, backends::Backend& backend,
                    const CheckOptions& /*options*/) {
  Result<cases::Case> clip = oracle::to_clip_case(c, "");
  if (!clip) return tl::unexpected(clip.error());
  Check none;
  none.is_applicable = backend.draws_pictures();
  if (!none.is_applicable) return none;
  clip->depth_test = cases::DepthTest::none;
  const cases::Pipeline pipeline = pipeline_of(*clip);
  const Result<cases::Framebuffer> fragments = draw(*clip, backend);
  if (!fragments) return tl::unexpected(fragments.error());
  const Result<cases::Picture> picture = draw_picture(*clip, backend, pipeline);
  if (!picture) return tl::unexpected(picture.error());
  return PictureCheck(*clip, pipeline, *fragments, *picture).run();
}

const LawRegistration kRegistration(
    {.name = "a picture is what its fragments leave",
     .reason = "Depth tests compare floats, and blending and formats are IEEE arithmetic with "
               "every rounding named.",
     .exceptions = "backends that draw no pictures",
     .generate = &overlapping_case,
     .check = &check,
     .is_promised = &draws_pictures,
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
}  // namespace rastercheck::properties
