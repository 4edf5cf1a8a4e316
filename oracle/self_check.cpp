#include "oracle/self_check.h"

#include <fmt/format.h>

#include "oracle/referee.h"

namespace rastercheck::oracle {

namespace {

std::string difference(std::size_t triangle, int x, int y, int sample, const std::string& what) {
  return fmt::format("oracle and referee differ at triangle {}, pixel ({}, {}), sample {}: {}",
                     triangle, x, y, sample, what);
}

}  // namespace

std::optional<std::string> self_check(const SceneTruth& scene, const Fragment& fragment) {
  const cases::Contract& contract = scene.contract();
  const bool referee_applies =
      scene.source().primitive == cases::Primitive::triangles && !contract.coverage &&
      contract.tie_rule == scene.source().fill_rule && contract.draws_every_triangle() &&
      !contract.sample_position && fragment.decision.verdict == records::Verdict::required;
  if (!referee_applies) return std::nullopt;

  const std::size_t triangle = fragment.place.triangle;
  const auto x = static_cast<int>(fragment.place.x);
  const auto y = static_cast<int>(fragment.place.y);
  const auto sample = static_cast<int>(fragment.place.sample);
  const auto differs = [=](const std::string& what) {
    return difference(triangle, x, y, sample, what);
  };
  const std::optional<RefereeFragment> second =
      referee(scene.source(), triangle, x, y, sample, contract.claims);
  if (!second) return differs("covered or not");
  if (!fragment.depth) return differs("depth");
  // The referee has one bias for a case, which a contract may leave open or have otherwise.
  const bool has_own_bias = !scene.source().depth_bias.is_none() &&
                            contract.depth_bias != cases::contract_of(scene.source()).depth_bias;
  if (!has_own_bias && fragment.depth->lo != second->depth) return differs("depth");
  for (std::size_t a = 0; a < fragment.attributes.size(); ++a) {
    const std::optional<ValueRange>& value = fragment.attributes[a];
    if (value && value->is_open) continue;  // a centroid: the referee names no point
    if (scene.source().attributes[a].location == cases::Location::centroid &&
        scene.source().attributes[a].interpolation != cases::Interpolation::flat) {
      continue;
    }
    const std::optional<Rational>& other = second->attributes[a];
    if (value.has_value() != other.has_value() || (value && value->lo != *other)) {
      return differs(fmt::format("attribute {}", a));
    }
  }
  return std::nullopt;
}

std::optional<std::string> self_check(const SceneTruth& scene, std::size_t triangle, int x, int y,
                                      int sample) {
  const cases::FramebufferSize& size = scene.source().framebuffer;
  if (x >= size.width || y >= size.height) return std::nullopt;
  const TriangleTruth truth(scene, triangle);
  const records::SampleVerdict decision = truth.judge(x, y, sample);
  if (decision.verdict == records::Verdict::required) {
    return self_check(scene, fragment_at(scene, truth, triangle, x, y, sample, decision));
  }
  const bool differs = scene.source().primitive == cases::Primitive::triangles &&
                       decision.verdict == records::Verdict::forbidden &&
                       referee(scene.source(), triangle, x, y, sample).has_value();
  if (!differs) return std::nullopt;
  return difference(triangle, x, y, sample, "covered or not");
}

}  // namespace rastercheck::oracle
