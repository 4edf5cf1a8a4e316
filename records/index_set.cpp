#include "records/index_set.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace rastercheck::records {
namespace {

using Range = IndexSet::Range;

bool comes_before(const Range& a, const Range& b) { return a.first < b.first; }

/// True if a range that begins at `first` continues one that ends at `last`, or overlaps it.
bool continues(std::uint64_t last, std::uint64_t first) { return first == 0 || first - 1 <= last; }

}  // namespace

IndexSet::IndexSet(std::vector<Range> ranges) {
  std::sort(ranges.begin(), ranges.end(), &comes_before);
  for (const Range& range : ranges) {
    if (!ranges_.empty() && continues(ranges_.back().last, range.first)) {
      ranges_.back().last = std::max(ranges_.back().last, range.last);
    } else {
      ranges_.push_back(range);
    }
  }
}

std::uint64_t IndexSet::count() const {
  std::uint64_t count = 0;
  for (const Range& range : ranges_) count += range.last - range.first + 1;
  return count;
}

bool IndexSet::contains(std::uint64_t number) const {
  const auto after =
      std::upper_bound(ranges_.begin(), ranges_.end(), Range{number, number}, &comes_before);
  return after != ranges_.begin() && number <= std::prev(after)->last;
}

std::vector<std::uint64_t> IndexSet::first(std::size_t most) const {
  std::vector<std::uint64_t> numbers;
  for (const Range& range : ranges_) {
    for (std::uint64_t number = range.first; numbers.size() < most; ++number) {
      numbers.push_back(number);
      if (number == range.last) break;
    }
  }
  return numbers;
}

void IndexSet::add(std::uint64_t number) {
  // Cases come in ascending order, except after a merge.
  if (ranges_.empty() || number > ranges_.back().last) {
    if (!ranges_.empty() && continues(ranges_.back().last, number)) {
      ranges_.back().last = number;
    } else {
      ranges_.push_back({number, number});
    }
    return;
  }
  if (!contains(number)) merge(IndexSet({{number, number}}));
}

void IndexSet::merge(const IndexSet& other) {
  if (other.empty()) return;
  std::vector<Range> all = std::move(ranges_);
  all.insert(all.end(), other.ranges_.begin(), other.ranges_.end());
  *this = IndexSet(std::move(all));
}

IndexSet common(const IndexSet& a, const IndexSet& b) {
  std::vector<Range> shared;
  auto one = a.ranges().begin();
  auto other = b.ranges().begin();
  while (one != a.ranges().end() && other != b.ranges().end()) {
    const Range both{std::max(one->first, other->first), std::min(one->last, other->last)};
    if (both.first <= both.last) shared.push_back(both);
    // The range that ends first shares nothing with later ranges.
    if (one->last < other->last) {
      ++one;
    } else {
      ++other;
    }
  }
  return IndexSet(std::move(shared));
}

IndexSet without(const IndexSet& a, const IndexSet& b) {
  // The complement of `b`: the gaps between its ranges.
  constexpr std::uint64_t kGreatest = std::numeric_limits<std::uint64_t>::max();
  std::vector<Range> gaps;
  std::uint64_t next = 0;
  for (const Range& range : b.ranges()) {
    if (range.first > next) gaps.push_back({next, range.first - 1});
    if (range.last == kGreatest) return common(a, IndexSet(std::move(gaps)));
    next = range.last + 1;
  }
  gaps.push_back({next, kGreatest});
  return common(a, IndexSet(std::move(gaps)));
}

}  // namespace rastercheck::records
