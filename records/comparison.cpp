#include "records/comparison.h"

#include <algorithm>
#include <limits>

namespace rastercheck::records {

double growth_of(const StageChange& change) {
  const double was = change.mean_before ? change.mean_before->hi : 0;
  const double is = change.mean_after ? change.mean_after->hi : 0;
  if (was > 0) return is / was;
  return is > 0 ? std::numeric_limits<double>::infinity() : 1;
}

std::uint64_t count_of(const Comparison& comparison, Change change) {
  return static_cast<std::uint64_t>(
      std::count_if(comparison.entries.begin(), comparison.entries.end(),
                    [change](const EntryChange& entry) { return entry.change == change; }));
}

std::uint64_t refused(const Comparison& comparison) {
  return static_cast<std::uint64_t>(std::count_if(
      comparison.entries.begin(), comparison.entries.end(), [](const EntryChange& entry) {
        return entry.change == Change::worse && !entry.allowed_because;
      }));
}

std::uint64_t refused(const std::vector<Comparison>& comparisons) {
  std::uint64_t all = 0;
  for (const Comparison& comparison : comparisons) all += refused(comparison);
  return all;
}

std::string_view figure_name(const FigureChange& change) {
  return change.figure == Figure::mismatches ? to_string(change.fragment_class)
                                             : to_string(change.figure);
}

}  // namespace rastercheck::records
