#include "properties/campaign/findings.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "cases/case_writer.h"
#include "properties/campaign/internal/case_size.h"
#include "records/enclosure.h"

namespace rastercheck::properties {
namespace {

using records::Counterexample;

/// Identifies the way in which a case failed: one counterexample is kept for each way.
auto bucket_of(const cases::Found& found) {
  return std::tie(found.law, found.backend, found.verdict, found.kind, found.condition);
}

bool is_in_earlier_bucket(const Counterexample& one, const cases::Found& found) {
  return bucket_of(*one.source.found) < bucket_of(found);
}

/// Orders counterexamples by where in a run they were found.
auto place_of(const cases::Found& found, const records::Origin& origin, const std::string& name) {
  return std::tie(origin, found.index, name, found.seed);
}

auto place_of(const Counterexample& one) {
  return place_of(*one.source.found, one.origin, one.source.name);
}

bool is_hang(const cases::Found& found) {
  return found.verdict == to_string(records::FragmentClass::hang);
}

/// Finds the counterexample on which a backend hung, for any law.
template <typename All>
auto hang_of(All& all, const std::string& backend) {
  return std::find_if(all.begin(), all.end(), [&backend](const Counterexample& one) {
    return one.source.found->backend == backend && is_hang(*one.source.found);
  });
}

/// Compares by place, then by content: two saved counterexamples with the same name have the same
/// place.
bool comes_before(const Counterexample& a, const Counterexample& b) {
  if (place_of(a) != place_of(b)) return place_of(a) < place_of(b);
  return cases::to_json(a.source) < cases::to_json(b.source);
}

/// True if all violations are missing or extra samples close to the boundary, but not on it. In
/// most rasterizers, rounding moves samples so close to the wrong side; an error of logic shows at
/// any distance. Most rasterizers snap to a grid of 1/256 pixel, and 1/1024 pixel is less than half
/// a step of that grid.
bool is_of_rounding(const Counterexample& one) {
  constexpr double kPixels = 0x1p-10;
  return !one.violations.empty() &&
         std::all_of(one.violations.begin(), one.violations.end(), [](const auto& violation) {
           const bool is_of_coverage =
               violation.fragment_class == records::FragmentClass::missing ||
               violation.fragment_class == records::FragmentClass::extra;
           if (!is_of_coverage || !violation.distance) return false;
           const double farthest = records::magnitude(*violation.distance).hi;
           return farthest > 0 && farthest < kPixels;
         });
}

}  // namespace

bool is_kept(const Findings& findings, const cases::Found& found, records::Origin origin,
             const std::string& name) {
  const auto& all = findings.counterexamples;
  if (is_hang(found)) {
    const auto hang = hang_of(all, found.backend);
    return hang == all.end() || !(place_of(*hang) < place_of(found, origin, name));
  }
  const auto place = std::lower_bound(all.begin(), all.end(), found, &is_in_earlier_bucket);
  if (place == all.end() || bucket_of(*place->source.found) != bucket_of(found)) return true;
  return !(place_of(*place) < place_of(found, origin, name));
}

void keep(Findings& findings, Counterexample counterexample) {
  auto& all = findings.counterexamples;
  const cases::Found& found = *counterexample.source.found;
  if (is_hang(found)) {
    const auto hang = hang_of(all, found.backend);
    if (hang != all.end() && comes_before(*hang, counterexample)) return;
    if (hang != all.end()) all.erase(hang);
  }
  const auto place = std::lower_bound(all.begin(), all.end(), found, &is_in_earlier_bucket);
  if (place == all.end() || bucket_of(*place->source.found) != bucket_of(found)) {
    all.insert(place, std::move(counterexample));
  } else if (comes_before(counterexample, *place)) {
    *place = std::move(counterexample);
  }
}

void keep(Findings& findings, records::UnexpectedPass pass) {
  auto& all = findings.unexpected;
  const auto place = std::lower_bound(all.begin(), all.end(), pass);
  if (place == all.end() || *place != pass) all.insert(place, std::move(pass));
}

std::size_t first_to_read(const std::vector<Counterexample>& all) {
  const auto rank = [](const Counterexample& one) {
    const std::string& law = one.source.found->law;
    return std::tuple(law != kCoverageLaw && law != kValuesLaw, is_of_rounding(one),
                      size_of(one.source));
  };
  const auto first = std::min_element(
      all.begin(), all.end(), [&rank](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return static_cast<std::size_t>(first - all.begin());
}

void merge(Findings& into, Findings from) {
  records::merge(into.records, from.records);
  if (from.cases && !into.cases) into.cases.emplace();
  if (from.cases) into.cases->merge(*from.cases);
  if (from.outcomes && !into.outcomes) into.outcomes.emplace();
  if (from.outcomes) records::merge(*into.outcomes, *from.outcomes);
  for (Counterexample& one : from.counterexamples) keep(into, std::move(one));
  for (records::UnexpectedPass& pass : from.unexpected) keep(into, std::move(pass));
  if (!into.fault) into.fault = std::move(from.fault);
}

}  // namespace rastercheck::properties
