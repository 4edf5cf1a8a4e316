// Coverage obeys the contract: every required sample is drawn, no forbidden one is, none twice.

#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

Result<Check> check(const cases::Case& c, backends::Backend& backend, const CheckOptions& options) {
  return check_judged(c, backend, {.judges_values = false, .counts_coverage = true}, options);
}

const LawRegistration kRegistration({"coverage obeys the contract", &generate_any, &check});

}  // namespace
}  // namespace rastercheck::properties
