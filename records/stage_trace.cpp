#include "records/stage_trace.h"

#include <algorithm>

namespace rastercheck::records {

const StageTrace* find_stage(const SampleTrace& trace, std::string_view stage) {
  const auto found = std::find_if(trace.stages.begin(), trace.stages.end(),
                                  [stage](const StageTrace& s) { return s.stage == stage; });
  return found == trace.stages.end() ? nullptr : &*found;
}

std::optional<double> find_number(const NamedNumbers& numbers, std::string_view name) {
  const auto found = std::find_if(numbers.begin(), numbers.end(),
                                  [name](const NamedNumber& n) { return n.name == name; });
  return found == numbers.end() ? std::nullopt : std::optional(found->value);
}

}  // namespace rastercheck::records
