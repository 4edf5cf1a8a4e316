#include "records/counterexample_json.h"

#include <nlohmann/json.hpp>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "records/enclosure_json.h"
#include "records/internal/shared_members.h"

namespace rastercheck::records {

template <typename Archive, cases::Either<Violation> T>
void members(Archive& archive, T& violation) {
  archive.required("class", violation.fragment_class);
  archive.required("kind", violation.kind);
  members(archive, violation.place);
  archive.required("exact", violation.exact);
  archive.required("actual", violation.actual);
  archive.required("note", violation.note);
  archive.optional("attribute", violation.attribute);
  archive.optional("error", violation.error);
  archive.optional("bound", violation.bound);
  archive.optional("distance", violation.distance);
}

template <typename Archive, cases::Either<Shrinking> T>
void members(Archive& archive, T& shrinking) {
  archive.required("tries", shrinking.tries);
  archive.required("is_least", shrinking.is_least);
}

template <typename Archive, cases::Either<Explanation> T>
void members(Archive& archive, T& explanation) {
  archive.required("parts", explanation.parts);
  archive.required("wrong", explanation.wrong);
  archive.required("also_violates", explanation.also_violates);
  archive.required("needs", explanation.needs);
  archive.required("inherent", explanation.inherent);
  archive.required("indifferent", explanation.indifferent);
  archive.optional("hints", explanation.hints);
  archive.optional("fails_again", explanation.fails_again, true);
}

template <typename Archive, cases::Either<Counterexample> T>
void members(Archive& archive, T& counterexample) {
  archive.required("case", counterexample.source);
  archive.required("violation_count", counterexample.violation_count);
  archive.required("violations", counterexample.violations);
  archive.added("origin", counterexample.origin, Origin::random);
  archive.optional("shrinking", counterexample.shrinking);
  archive.optional("explanation", counterexample.explanation);
  archive.optional("close_up", counterexample.close_up);
}

void write_value(nlohmann::json& to, const Violation& violation) {
  cases::write_members(to, violation);
}
void read_value(const cases::JsonNode& node, Violation& violation) {
  cases::read_members(node, violation);
}
void write_value(nlohmann::json& to, const Counterexample& counterexample) {
  cases::write_members(to, counterexample);
}
void read_value(const cases::JsonNode& node, Counterexample& counterexample) {
  cases::read_members(node, counterexample);
}

}  // namespace rastercheck::records
