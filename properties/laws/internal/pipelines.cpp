#include "properties/laws/internal/pipelines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cases/names.h"
#include "properties/choices.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {
namespace {

using cases::Blend;
using cases::DepthFunction;

constexpr std::array<std::string_view, 8> kFunctionWords{"always",    "never",           "less",
                                                         "equal",     "less or equal",   "greater",
                                                         "not equal", "greater or equal"};

/// The approximate window depth of a vertex. If its triangle has the same depth everywhere, often
/// exactly the depth drawn.
float depth_of(const cases::Case& c, const cases::ClipVertex& p) {
  if (!(p.w > 0)) return 0.5F;
  const double depth = double{p.z} / double{p.w};
  const double share = c.rules == cases::Rules::opengl ? (depth + 1) / 2 : depth;
  const double n = double{c.viewport.min_depth};
  const double f = double{c.viewport.max_depth};
  return static_cast<float>(std::clamp(n + (f - n) * share, 0.0, 1.0));
}

/// Chooses the clear depth: usually one that lets fragments pass.
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

}  // namespace

std::string_view word_of(DepthFunction function) {
  return kFunctionWords[static_cast<std::size_t>(function)];
}

std::string_view word_of(Blend blend) { return cases::name_of(blend); }

cases::Pipeline pipeline_of(const cases::Case& c) {
  Choices choices(choices_of(c));
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

std::string text_of(const cases::Pipeline& pipeline) {
  return fmt::format("{}depth {}{}, cleared to {}, blend {}, {}{}",
                     pipeline.shading == cases::Shading::vertex_colors ? "vertex colours, " : "",
                     word_of(pipeline.depth_function),
                     pipeline.writes_depth ? "" : " and not written", pipeline.clear_depth,
                     word_of(pipeline.blend),
                     pipeline.format == cases::ColorFormat::rgba8 ? "rgba8" : "float32",
                     pipeline.resolves ? ", resolved" : "");
}

}  // namespace rastercheck::properties
