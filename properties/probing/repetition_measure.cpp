// Measures whether the same case gives the same picture and which values are returned exactly.
// Checks the laws that state these properties (properties/laws/), with the backend held to the
// promise that each law needs.

#include <fmt/format.h>

#include <initializer_list>
#include <optional>
#include <utility>

#include "properties/campaign/check_case.h"
#include "properties/fitting.h"
#include "properties/law.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

/// The number of cases that are checked for a law, as a multiple of ProbeOptions::cases: different
/// bits may show in only a few cases.
constexpr int kCasesEach = 5;

struct RepetitionCounts {
  int checked = 0;
  int violated = 0;
  int not_checked = 0;  ///< cases of which the property says nothing, or that are not drawn
  RepetitionCounts& operator+=(const RepetitionCounts& other) {
    checked += other.checked;
    violated += other.violated;
    not_checked += other.not_checked;
    return *this;
  }
  /// Counts for a promise that is kept, or for one that is not.
  records::Sureness sureness() const {
    const int kept = checked - violated;
    return violated == 0 ? sure_of("cases", kept, 0, not_checked)
                         : sure_of("cases", violated, kept, not_checked);
  }
};

RepetitionCounts count_repetitions(Subject& subject, const char* law_name,
                                   const cases::ContractTerms& terms) {
  RepetitionCounts counts;
  const Law* law = find_law(law_name);
  if (law == nullptr) return counts;
  backends::Backend& backend = subject.backend();
  const std::optional<cases::ContractTerms> before = backend.terms();
  cases::ContractTerms asked = terms;
  if (!asked.numbers && before) asked.numbers = before->numbers;
  backend.hold_to(asked);
  const cases::Capabilities capabilities = capabilities_of(backend);
  const int wanted = kCasesEach * subject.options().cases;
  for (int i = 0; i < wanted && !subject.is_time_up(); ++i) {
    Draw draw(subject.options().seed, "probe: " + std::string(law_name),
              static_cast<std::uint64_t>(i), capabilities);
    Generated generated = law->generate(draw);
    fit_case(draw, generated.source);
    AskedDrawing back = subject.asked();
    subject.ask(subject.options().asked);
    subject.ask_of(generated.source);
    subject.ask(back);
    const Result<Check> check = check_law(*law, generated.source, backend, 0);
    ++subject.result.drawings;
    if (!check || !check->is_applicable || check->fault) {
      ++counts.not_checked;
      continue;
    }
    ++counts.checked;
    counts.violated += check->violation_count > 0 ? 1 : 0;
  }
  backend.hold_to(before);
  return counts;
}

}  // namespace

void measure_repetition(Subject& subject) {
  cases::ContractTerms& terms = subject.result.terms;
  const RepetitionCounts twice =
      count_repetitions(subject, "drawing-twice-draws-the-same-bits", terms);
  subject.add(
      "drawing twice", kNotDeclared,
      twice.checked == 0 ? "not seen" : (twice.violated == 0 ? "the same bits" : "other bits"), "",
      twice.sureness());

  const cases::Contract declared = subject.declared();
  const auto keep = [&](const char* what, std::initializer_list<const char*> laws, bool is_declared,
                        std::optional<bool> cases::ContractTerms::*term) {
    cases::ContractTerms promised = terms;
    promised.*term = true;
    RepetitionCounts counts;
    for (const char* const law : laws) counts += count_repetitions(subject, law, promised);
    const bool keeps = counts.checked > 0 && counts.violated == 0;
    const char* const measured = counts.checked == 0 ? "not seen" : keeps ? "kept" : "not kept";
    subject.add(what, is_declared ? "kept" : "not promised", measured, "", counts.sureness())
        .contradicts = is_declared && counts.violated > 0;
    terms.*term = keeps;
  };
  keep("constants to the bit", {"constants-stay-constant"}, declared.keeps_constants,
       &cases::ContractTerms::keeps_constants);
  keep("equal depths", {"equal-depth-stays-equal"}, declared.keeps_equal_depth,
       &cases::ContractTerms::keeps_equal_depth);
  keep("values at vertices to the bit", {"values-at-vertices-come-back"},
       declared.keeps_vertex_values, &cases::ContractTerms::keeps_vertex_values);
  // It takes more cases to believe such a promise than to see it broken.
  if (!declared.is_invariant) return;
  keep("the same bits if scaled or culled",
       {"a-power-of-two-changes-no-bit", "culled-and-unculled-partition"}, true,
       &cases::ContractTerms::is_invariant);
}

}  // namespace rastercheck::properties
