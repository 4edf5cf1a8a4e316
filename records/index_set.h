#pragma once

// A set of case numbers as sorted ranges: small where neighbouring cases have the same outcome, as
// most have.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rastercheck::records {

class IndexSet {
 public:
  /// The numbers from `first` to `last`, both included.
  struct Range {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    bool operator==(const Range&) const = default;
  };

  IndexSet() = default;
  /// The union of ranges, which may overlap and stand in any order. Each has first <= last.
  explicit IndexSet(std::vector<Range> ranges);

  /// In ascending order, with at least one missing number between two ranges.
  const std::vector<Range>& ranges() const { return ranges_; }
  bool empty() const { return ranges_.empty(); }
  /// Number of elements; the set must not hold all 2^64 numbers.
  std::uint64_t count() const;
  bool contains(std::uint64_t number) const;
  /// The smallest elements, at most `most` of them.
  std::vector<std::uint64_t> first(std::size_t most) const;

  void add(std::uint64_t number);
  void merge(const IndexSet& other);
  bool operator==(const IndexSet&) const = default;

 private:
  std::vector<Range> ranges_;
};

/// The elements of both sets.
IndexSet common(const IndexSet& a, const IndexSet& b);
/// The elements of `a` that `b` lacks.
IndexSet without(const IndexSet& a, const IndexSet& b);

}  // namespace rastercheck::records
