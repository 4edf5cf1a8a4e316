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
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "oracle/transform.h"
#include "properties/internal/choices.h"
#include "properties/internal/drawn_fragments.h"
#include "properties/internal/picture_cases.h"
#include "properties/judged_law.h"
#include "properties/picture_model.h"

namespace rastercheck::properties {
namespace {

using cases::Blend;
using cases::DepthFunction;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::array<std::string_view, 8> kFunctionWords{"always",    "never",           "less",
                                                         "equal",     "less or equal",   "greater",
                                                         "not equal", "greater or equal"};
constexpr std::array<std::string_view, 3> kBlendWords{"off", "over", "additive"};

/// The window depth of a vertex, about: of a plane of equal depth often just the one that is drawn.
float depth_of(const cases::Case& c, const cases::ClipVertex& p) {
  if (!(p.w > 0)) return 0.5F;
  const double depth = double{p.z} / double{p.w};
  const double share = c.rules == cases::Rules::opengl ? (depth + 1) / 2 : depth;
  const double n = double{c.viewport.min_depth};
  const double f = double{c.viewport.max_depth};
  return static_cast<float>(std::clamp(n + (f - n) * share, 0.0, 1.0));
}

/// What depths are cleared to: most often something that lets what is drawn pass.
float clear_depth(const cases::Case& c, DepthFunction function, Choices& choices) {
  switch (function) {
    case DepthFunction::less:
    case DepthFunction::less_or_equal:
      return choices.pick(std::array{1.0F, 1.0F, 1.0F, 0.5F});
    case DepthFunction::greater:
    case DepthFunction::greater_or_equal:
      return choices.pick(std::array{0.0F, 0.0F, 0.0F, 0.5F});
    case DepthFunction::equal:
    case DepthFunction::not_equal:
      if (c.triangles.empty()) return 0.5F;
      return depth_of(c, c.positions[c.triangles[choices.below(c.triangles.size())][0]]);
    default:
      return choices.pick(std::array{0.25F, 0.5F, 0.75F, 1.0F});
  }
}

cases::Pipeline pipeline_of(const cases::Case& c) {
  Choices choices(fingerprint(c));
  cases::Pipeline pipeline;
  pipeline.depth_function = static_cast<DepthFunction>(choices.below(kFunctionWords.size()));
  pipeline.writes_depth = choices.below(4) != 0;
  pipeline.clear_depth = clear_depth(c, pipeline.depth_function, choices);
  pipeline.blend = choices.pick(std::array{Blend::off, Blend::over, Blend::over, Blend::additive});
  if (c.attributes.size() >= 3 && choices.below(2) != 0) {
    pipeline.shading = cases::Shading::vertex_colors;
  }
  const bool has_four =
      pipeline.shading == cases::Shading::vertex_colors || c.attributes.size() == 4;
  if (pipeline.blend == Blend::over && !has_four) pipeline.blend = Blend::additive;
  const bool wants_bytes = choices.below(2) != 0;
  const bool is_rgba8 = wants_bytes && has_four;
  pipeline.format = is_rgba8 ? cases::ColorFormat::rgba8 : cases::ColorFormat::float32;
  pipeline.resolves = choices.below(3) == 0;
  return pipeline;
}

std::string_view word_of(const cases::Pipeline& pipeline) {
  return kFunctionWords[static_cast<std::size_t>(pipeline.depth_function)];
}

std::string text_of(const cases::Pipeline& pipeline) {
  return fmt::format("{}depth {}{}, cleared to {}, blend {}, {}{}",
                     pipeline.shading == cases::Shading::vertex_colors ? "vertex colours, " : "",
                     word_of(pipeline), pipeline.writes_depth ? "" : " and not written",
                     pipeline.clear_depth, kBlendWords[static_cast<std::size_t>(pipeline.blend)],
                     pipeline.format == cases::ColorFormat::rgba8 ? "rgba8" : "float32",
                     pipeline.resolves ? ", resolved" : "");
}

std::vector<std::string> labels_of(const cases::Case& c, const cases::Pipeline& pipeline,
                                   const std::set<std::uint32_t>& drawn, std::size_t most) {
  std::set<std::string> labels;
  labels.insert("depth " + std::string(word_of(pipeline)));
  labels.insert("blend " + std::string(kBlendWords[static_cast<std::size_t>(pipeline.blend)]));
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
    // The alpha of three colours is no attribute.
    const bool is_attribute = channel && *channel < case_->attributes.size();
    AttributeKind kind = channel ? AttributeKind::flat : AttributeKind::depth;
    if (is_attribute) kind = records::kind_of(case_->attributes[*channel].interpolation);
    const FragmentClass found = class_of(actual, expected);
    ++check_.judgement.errors[kind].classes[found];
    if (found == FragmentClass::correct) return;
    const auto samples = static_cast<std::size_t>(expected_.size.samples);
    const auto width = static_cast<std::size_t>(expected_.size.width);
    const std::vector<std::uint32_t>& triangles = triangles_[at];
    records::Violation violation;
    violation.fragment_class = found;
    violation.kind = kind;
    violation.triangle = triangles.empty() ? 0 : triangles.back();
    violation.x = static_cast<std::uint32_t>(at / samples % width);
    violation.y = static_cast<std::uint32_t>(at / samples / width);
    violation.sample = static_cast<std::uint32_t>(at % samples);
    if (is_attribute) violation.attribute = channel;
    violation.exact = value_text(expected);
    violation.actual = value_text(actual);
    violation.note = fmt::format("{} fragments there; {}", triangles.size(), text_of(*pipeline_));
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
     .is_promised = &draws_pictures});

}  // namespace
}  // namespace rastercheck::properties
