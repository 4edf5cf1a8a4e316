#include "properties/campaign/power.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "oracle/transform.h"
#include "properties/campaign/sabotage.h"
#include "properties/draw.h"
#include "properties/drawing.h"

namespace rastercheck::properties {
namespace {

bool has_law(const records::Plan& plan, std::string_view law) {
  return std::find(plan.laws.begin(), plan.laws.end(), law) != plan.laws.end();
}

/// Every so-many-th fragment, about 16 of them.
cases::Fragments some_of(const cases::Fragments& drawn) {
  constexpr std::size_t kSome = 16;
  const std::size_t count = drawn.attribute_count;
  cases::Fragments some;
  some.attribute_count = count;
  const std::size_t step = std::max<std::size_t>(drawn.size() / kSome, 1);
  for (std::size_t i = 0; i < drawn.size(); i += step) {
    some.triangle.push_back(drawn.triangle[i]);
    some.x.push_back(drawn.x[i]);
    some.y.push_back(drawn.y[i]);
    some.sample.push_back(drawn.sample[i]);
    some.depth.push_back(drawn.depth[i]);
    const auto values = drawn.attributes_of(i);
    some.attributes.insert(some.attributes.end(), values.begin(), values.end());
  }
  return some;
}

}  // namespace

bool is_sabotaged(const records::Plan& plan, const Law& law, std::uint64_t index) {
  if (plan.power == 0 || (law.id != kCoverageLaw && law.id != kValuesLaw)) return false;
  // None of the choices that the case is made by.
  Draw choices(plan.seed, "power of " + std::string(law.id), index);
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>((Wide{choices.bits(64)} * plan.power) >> 64U) == 0;
}

void measure_power(const records::Plan& plan, const Law& law, backends::Backend& backend,
                   const cases::Case& source, records::Power& power) {
  const Result<cases::ClipCase> c = oracle::to_clip_case(source, "");
  if (!c) return;
  const Result<backends::Drawn> drawn = draw(*c, backend);
  if (!drawn) return;
  const Drawing right{&*c, &drawn->fragments,
                      [&backend](const cases::Case& other) -> std::optional<cases::Fragments> {
                        Result<backends::Drawn> of_other = draw(other, backend);
                        if (!of_other) return std::nullopt;
                        return std::move(of_other->fragments);
                      }};
  const auto is_wrong = [&](const cases::Fragments& fragments, const JudgeRequest& request) {
    return has_wrong(*c, drawn->contract, fragments, request);
  };
  // Most defects of values are in all of them, and each wrong one takes exact numbers.
  const auto has_wrong_values = [&is_wrong](const cases::Fragments& fragments) {
    return is_wrong(some_of(fragments), kValuesAlone) || is_wrong(fragments, kValuesAlone);
  };
  const bool is_of_coverage = law.id == kCoverageLaw;
  for (const Sabotage& sabotage : sabotages()) {
    if (sabotage.changes.counts_coverage != is_of_coverage) continue;
    const std::optional<cases::Fragments> wrong = sabotage.apply(right);
    if (!wrong) continue;
    bool is_noticed = is_of_coverage ? is_wrong(*wrong, kCoverageAlone) : has_wrong_values(*wrong);
    // The case's law says nothing of how right values were.
    if (!is_noticed && is_of_coverage && sabotage.changes.judges_values &&
        has_law(plan, kValuesLaw)) {
      is_noticed = has_wrong_values(*wrong) && !is_wrong(drawn->fragments, kValuesAlone);
    }
    records::merge(power[sabotage.defect], {1, is_noticed ? std::uint64_t{1} : 0});
  }
}

}  // namespace rastercheck::properties
