#include "properties/campaign/power.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "cases/some_fragments.h"
#include "oracle/transform.h"
#include "properties/campaign/sabotage.h"
#include "properties/draw.h"
#include "properties/drawing.h"

namespace rastercheck::properties {
namespace {

bool has_law(const records::Plan& plan, std::string_view law) {
  return std::find(plan.laws.begin(), plan.laws.end(), law) != plan.laws.end();
}

/// Number of fragments that are judged first for each defect.
constexpr std::size_t kSome = 16;

}  // namespace

bool is_sabotaged(const records::Plan& plan, const Law& law, std::uint64_t index) {
  if (plan.power == 0 || (law.id != kCoverageLaw && law.id != kValuesLaw)) return false;
  // Independent of the choices that made the case.
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
  // Most value defects affect all fragments, and judging a wrong value takes exact numbers. So a
  // few fragments are judged first.
  const auto has_wrong_values = [&is_wrong](const cases::Fragments& fragments) {
    return is_wrong(cases::thinned(fragments, kSome), kValuesAlone) ||
           is_wrong(fragments, kValuesAlone);
  };
  const bool is_of_coverage = law.id == kCoverageLaw;
  for (const Sabotage& sabotage : sabotages()) {
    if (sabotage.changes.counts_coverage != is_of_coverage) continue;
    const std::optional<cases::Fragments> wrong = sabotage.apply(right);
    if (!wrong) continue;
    bool is_noticed = is_of_coverage ? is_wrong(*wrong, kCoverageAlone) : has_wrong_values(*wrong);
    // The coverage law does not tell whether values were right before.
    if (!is_noticed && is_of_coverage && sabotage.changes.judges_values &&
        has_law(plan, kValuesLaw)) {
      is_noticed = has_wrong_values(*wrong) && !is_wrong(drawn->fragments, kValuesAlone);
    }
    records::merge(power[sabotage.defect], {1, is_noticed ? std::uint64_t{1} : 0});
  }
}

}  // namespace rastercheck::properties
