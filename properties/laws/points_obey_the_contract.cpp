// Points obey the contract: a point covers the samples of the square around its vertex and no
// other, has its vertex's values, and is dropped if the vertex is clipped (RULES §9).

#include "properties/judged_law.h"
#include "properties/laws/internal/primitive_cases.h"

namespace rastercheck::properties::points_obey_the_contract_law {
namespace {

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  if (c.primitive != cases::Primitive::points) {
    return not_applicable("the property is about points");
  }
  return check_judged(c, backend, {}, index);
}

const LawRegistration kRegistration(
    {.id = "points-obey-the-contract",
     .sentence = "points obey the contract",
     .reason = "A point is the square around its vertex's window position, with the vertex's "
               "values (RULES §9).",
     .exceptions = "samples that the contract permits either way",
     .generate = &random_points,
     .check = &check,
     .is_promised = &draws_points,
     .unpromised = kDrawsNoPoints,
     .takes_lines_and_points = true,
     .covers = {cover(43, "drawn"), cover(15, "several samples"), cover_decided(10, "tie")}});

}  // namespace
}  // namespace rastercheck::properties::points_obey_the_contract_law
