// Coverage obeys the contract: every required sample is drawn, no forbidden sample is drawn, and no
// sample is drawn twice.

#include "properties/judged_law.h"

namespace rastercheck::properties::coverage_obeys_the_contract_law {
namespace {

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  return check_judged(c, backend, {.judges_values = false, .counts_coverage = true}, index);
}

const LawRegistration kRegistration(
    {.id = "coverage-obeys-the-contract",
     .sentence = "coverage obeys the contract",
     .reason = "A sample is inside iff all edge functions and clip functionals say so, and zeros "
               "go by the fill rule (RULES §2).",
     .exceptions = "samples that the contract permits either way",
     .generate = &generate_any,
     .check = &check,
     .takes_lines_and_points = true,
     .covers = {cover(14, "clipped"), cover(43, "drawn"), cover(6, "extrapolated centre"),
                cover(18, "several samples"), cover_decided(10, "tie"), cover(8, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::coverage_obeys_the_contract_law
