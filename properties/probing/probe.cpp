#include "properties/probing/probe.h"

#include <fmt/format.h>

#include <utility>

#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

/// Withdraws the promises that no measure establishes.
void withdraw_unmeasured(cases::ContractTerms& terms) {
  terms.derivative_bound = std::optional<float>();
  terms.quad_share = std::optional<float>();
}

}  // namespace

Result<records::Probe> probe(const std::string& name, backends::Backend& backend,
                             const ProbeOptions& options, const Progress& progress) {
  Subject subject(name, backend, options);
  if (const Result<void> drawn = subject.choose_rules(); !drawn) {
    return tl::unexpected(drawn.error());
  }
  subject.result.terms.name = fmt::format("measured of {}, seed {}", name, options.seed);
  withdraw_unmeasured(subject.result.terms);
  Sight sight;
  measure_grid(subject, sight);
  measure_ties(subject, sight);
  measure_basis(subject, sight);
  measure_evaluation(subject);
  measure_clipping(subject);
  measure_reach(subject);
  measure_numbers(subject);
  measure_repetition(subject);
  measure_precision(subject, progress);
  if (const std::optional<Error> lost = backend.is_lost()) return tl::unexpected(*lost);
  return std::move(subject.result);
}

}  // namespace rastercheck::properties
