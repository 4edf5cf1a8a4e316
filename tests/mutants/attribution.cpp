#include "tests/mutants/attribution.h"

#include "oracle/stage_split.h"
#include "oracle/transform.h"
#include "properties/law.h"

namespace rastercheck::mutants {
namespace {

using records::FragmentClass;
using records::Stage;

std::optional<Stage> stage_of(const cases::Case& given, const cases::Case& clip,
                              backends::Backend& mutant, const records::Violation& found) {
  const auto told = mutant.tracer()->trace(clip, found.place);
  if (!told) return std::nullopt;
  const std::optional<records::SampleTrace>& trace = *told;
  const oracle::StageSplit split(given, clip, mutant.contract(clip), found.place.triangle);
  const bool is_missing = found.fragment_class == FragmentClass::missing;
  if (is_missing || found.fragment_class == FragmentClass::extra) {
    return split.coverage_stage(found.place.x, found.place.y, found.place.sample, !is_missing,
                                trace ? &*trace : nullptr);
  }
  if (!trace || !trace->is_drawn) return std::nullopt;
  const float actual = (found.attribute ? trace->attributes[*found.attribute] : trace->depth).value;
  const auto parts = split.traced(found.attribute, found.place.x, found.place.y, found.place.sample,
                                  actual, *trace);
  return parts ? largest_part(enclose(*parts)) : std::nullopt;
}

}  // namespace

std::optional<Stage> blamed_stage(std::string_view law, const cases::Case& source,
                                  backends::Backend& mutant) {
  Result<cases::ClipCase> clip = oracle::to_clip_case(source, "");
  const auto check = properties::check_law(*properties::find_law(law), source, mutant, 0);
  if (!clip || !check) return std::nullopt;
  clip->depth_test = cases::DepthTest::none;
  for (const records::Violation& found : check->violations) {
    if (!found.has_place() || found.place.triangle >= clip->triangles.size()) continue;
    if (const auto stage = stage_of(source, *clip, mutant, found)) return stage;
  }
  return std::nullopt;
}

}  // namespace rastercheck::mutants
