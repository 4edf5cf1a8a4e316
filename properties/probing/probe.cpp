#include "properties/probing/probe.h"

#include <fmt/format.h>

#include <functional>
#include <utility>
#include <vector>

#include "properties/probing/common_faults.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

/// Withdraws the promises that no measure establishes.
void withdraw_unmeasured(cases::ContractTerms& terms) {
  terms.derivative_bound = std::optional<float>();
  terms.quad_share = std::optional<float>();
}

/// A measure, and what a probe lacks without it.
struct Step {
  records::Unmeasured lacking;
  std::function<void(Subject& subject, Sight& sight)> measure;
};

/// All measures in order; each builds on the ones before it.
std::vector<Step> steps() {
  const auto of = [](void (*measure)(Subject&)) {
    return [measure](Subject& subject, Sight& /*sight*/) { measure(subject); };
  };
  return {
      {{"subpixel grid and position error",
        {"coverage", "is_on_grid", "sample_position", "conservative"}},
       &measure_grid},
      {{"tie rule", {"tie_rule"}}, &measure_ties},
      {{"basis", {"basis"}}, &measure_basis},
      {{"planes and division", {}}, of(&measure_evaluation)},
      {{"clipping", {"clip_tolerance", "culls_instead_of_clipping"}}, of(&measure_clipping)},
      {{"guard band", {"guard_band", "guard_beyond_viewport"}}, of(&measure_reach)},
      {{"depth test", {"depth_function"}}, of(&measure_depth_test)},
      {{"unorm depth", {"depth_store"}}, &measure_depth_store},
      {{"depth bias", {"depth_bias"}}, &measure_depth_bias},
      {{"pictures", {}}, of(&measure_pictures)},
      {{"textures", {}}, of(&measure_textures)},
      {{"lines and points", {}}, of(&measure_primitives)},
      {{"numbers", {"numbers"}}, of(&measure_numbers)},
      {{"promises to the bit",
        {"keeps_constants", "keeps_equal_depth", "keeps_vertex_values", "is_invariant"}},
       of(&measure_repetition)},
      {{"errors of values", {"bounds", "depth_error"}}, of(&measure_precision)},
  };
}

/// Makes all measures until the time is up, and lists the others.
void measure_all(Subject& subject, const ProbeProgress& progress) {
  const std::vector<Step> all = steps();
  Sight sight;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (progress) progress(i, all.size(), all[i].lacking.what);
    const std::vector<records::Measured> rows = subject.result.rows;
    const cases::ContractTerms terms = subject.result.terms;
    if (!subject.is_time_up()) all[i].measure(subject, sight);
    if (!subject.was_cut_short()) {
      ++subject.result.measures;
      continue;
    }
    // Half of a measure may say the opposite of all of it.
    subject.result.rows = rows;
    subject.result.terms = terms;
    subject.result.unmeasured.push_back(all[i].lacking);
  }
}

}  // namespace

Result<records::Probe> probe(const std::string& name, backends::Backend& backend,
                             const ProbeOptions& options, const ProbeProgress& progress) {
  Subject subject(name, backend, options);
  if (const Result<void> drawn = subject.choose_rules(); !drawn) {
    return tl::unexpected(drawn.error());
  }
  find_common_faults(subject);
  if (const std::optional<Error> lost = backend.is_lost()) return tl::unexpected(*lost);
  if (!subject.result.faults.empty()) return std::move(subject.result);
  subject.result.terms.name = fmt::format("measured of {}, seed {}", name, options.seed);
  withdraw_unmeasured(subject.result.terms);
  measure_all(subject, progress);
  if (const std::optional<Error> lost = backend.is_lost()) return tl::unexpected(*lost);
  return std::move(subject.result);
}

}  // namespace rastercheck::properties
