#include "properties/inspect/largest_errors.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>

#include "properties/campaign/check_case.h"
#include "properties/campaign/frozen_case.h"
#include "records/enclosure.h"

namespace rastercheck::properties {
namespace {

/// Orders errors by size, the largest first; of equal errors, those of the law on values come
/// first.
bool goes_first(const RunError& a, const RunError& b) {
  const auto is_of_values = [](const RunError& one) { return one.key->law == kValuesLaw; };
  if (a.size() != b.size()) return a.size() > b.size();
  return is_of_values(a) && !is_of_values(b);
}

/// Returns the first saved case of this law and index; nullptr if there is none.
const cases::Case* find_saved(std::span<const cases::Case> saved, const std::string& law,
                              std::uint64_t index) {
  const auto found = std::find_if(saved.begin(), saved.end(), [&](const cases::Case& c) {
    return c.found && c.found->law == law && c.found->index == index;
  });
  return found == saved.end() ? nullptr : &*found;
}

}  // namespace

double RunError::size() const { return records::magnitude_bound(worst->error); }

LargestErrors largest_errors(const records::Run& run) {
  LargestErrors all;
  for (const auto& [key, record] : run.records) {
    if (key.attribute_kind == records::AttributeKind::flat) continue;  // flat values are copies
    for (const auto& [stratum, sizes] : record.errors.strata) {
      for (const auto& worst :
           {std::cref(sizes.extremes.most_negative), std::cref(sizes.extremes.most_positive)}) {
        if (!worst.get()) continue;
        all[{key.backend, key.attribute_kind, stratum}].push_back({&key, &*worst.get()});
      }
    }
  }
  for (auto& [key, errors] : all) {
    std::stable_sort(errors.begin(), errors.end(), &goes_first);
  }
  return all;
}

std::optional<cases::Case> case_of(const RunError& error, const records::Plan& plan,
                                   const CaseSources& sources) {
  const auto& [law_name, backend, kind, stratum] = *error.key;
  const std::uint64_t index = error.worst->case_index;
  const auto copy_of = [](const cases::Case* c) {
    return c == nullptr ? std::nullopt : std::optional(*c);
  };
  if (stratum.starts_with(records::kSceneStratum)) return copy_of(sources.scene);
  if (stratum == records::kSavedStratum) return copy_of(find_saved(sources.saved, law_name, index));
  if (stratum == records::kKnownStratum) {
    const auto known = sources.known.find(backend);
    if (known == sources.known.end()) return std::nullopt;
    return copy_of(find_saved(known->second.cases(), law_name, index));
  }
  const records::Origin origin =
      stratum == records::kCorpusStratum ? records::Origin::corpus : records::Origin::random;
  return frozen_case({law_name, backend, origin, index}, plan, sources.corpus);
}

}  // namespace rastercheck::properties
