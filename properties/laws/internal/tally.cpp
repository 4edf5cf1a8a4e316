#include "properties/laws/internal/tally.h"

#include <utility>

#include "properties/judged_law.h"

namespace rastercheck::properties {

using records::AttributeKind;
using records::FragmentClass;

void add_to_notes(Check& check, const std::string& text) {
  add_to_notes(check, [&text](const records::Violation& /*violation*/) { return text; });
}

void add_to_notes(Check& check,
                  const std::function<std::string(const records::Violation&)>& text_of) {
  for (records::Violation& violation : check.violations) {
    const std::string text = text_of(violation);
    violation.note += violation.note.empty() ? "" : "; ";
    violation.note += text;
  }
}

Tally::Tally(const cases::Case& c) : case_(&c) { check_.judgement.errors[AttributeKind::coverage]; }

void Tally::label_drawn() {
  if (!triangles_.empty()) label("drawn");
}

void Tally::pass(AttributeKind kind, std::uint64_t count) {
  check_.judgement.errors[kind].classes[FragmentClass::correct] += count;
}

void Tally::pass_required(std::uint32_t triangle) {
  ++check_.judgement.counts.required;
  pass(AttributeKind::coverage);
  see(triangle);
}

void Tally::report(const records::Violation& violation) { add_violation(check_, violation); }

void Tally::report_passed(const records::Violation& violation) {
  --check_.judgement.errors[violation.kind].classes[FragmentClass::correct];
  report(violation);
}

void Tally::add_part(AttributeKind kind, records::Stratum stratum, const records::StagePart& part) {
  check_.judgement.errors[kind].stages[stratum][part.stage].add(records::magnitude(part.error));
}

void Tally::add_levels(const records::LevelCounts& samples) {
  records::LevelCounts& all = check_.judgement.levels.samples;
  all.filter += samples.filter;
  all.interval += samples.interval;
  all.exact += samples.exact;
}

Check Tally::finish() {
  add_state_labels(*case_, triangles_, labels_);
  check_.labels.assign(labels_.begin(), labels_.end());
  return std::move(check_);
}

}  // namespace rastercheck::properties
