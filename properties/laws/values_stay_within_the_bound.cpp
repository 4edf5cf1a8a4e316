// Values stay within the bound: depth and attributes of correctly drawn fragments are numbers no
// farther from the exact values than the contract says. Missing and extra samples are left to
// another law.

#include "properties/judged_law.h"

namespace rastercheck::properties::values_stay_within_the_bound_law {
namespace {

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  return check_judged(c, backend, {.judges_values = true, .counts_coverage = false}, index);
}

const LawRegistration kRegistration(
    {.id = "values-stay-within-the-bound",
     .sentence = "values stay within the bound",
     .reason = "r = N/D and z/w are exact rationals, and the contract says how far a float may be "
               "off (RULES §3, §5).",
     .exceptions = "samples drawn wrongly, which are coverage's business; values that the rules "
                   "leave free or undefined",
     .generate = &generate_any,
     .check = &check,
     .takes_lines_and_points = true,
     .covers = {cover(12, "clipped"), cover(42, "drawn"), cover(5, "extrapolated centre"),
                cover(15, "several samples"), cover_decided(9, "tie"), cover(8, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::values_stay_within_the_bound_law
