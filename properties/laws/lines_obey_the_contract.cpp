// Lines obey the contract: every sample that a line must cover is drawn and no other, and its
// values stay within the bounds. A line is a rectangle, a parallelogram, or the pixels whose
// diamonds it leaves, and its values are those of the share of its second end (RULES §10).

#include "properties/judged_law.h"
#include "properties/laws/internal/primitive_cases.h"

namespace rastercheck::properties::lines_obey_the_contract_law {
namespace {

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  if (c.primitive != cases::Primitive::lines) return not_applicable("the property is about lines");
  return check_judged(c, backend, {}, index);
}

const LawRegistration kRegistration(
    {.id = "lines-obey-the-contract",
     .sentence = "lines obey the contract",
     .reason = "A line is a rectangle, a parallelogram or the pixels whose diamonds it leaves, and "
               "its values are those of the share of its second end (RULES §10).",
     .exceptions = "samples that the contract permits either way",
     .generate = &random_lines,
     .check = &check,
     .is_promised = &draws_lines,
     .unpromised = kDrawsNoLines,
     .takes_lines_and_points = true,
     .covers = {cover(10, "clipped"), cover(43, "drawn"), cover(15, "several samples"),
                cover_decided(10, "tie")}});

}  // namespace
}  // namespace rastercheck::properties::lines_obey_the_contract_law
