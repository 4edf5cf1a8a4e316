#pragma once

// Collects fragments in any order, and sorts them into the order of cases::Fragments.

#include <cstddef>
#include <span>
#include <string>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "cases/sample_place.h"

namespace rastercheck::cases {

class FragmentCollector {
 public:
  /// The case must outlive the collector.
  explicit FragmentCollector(const Case& c);

  /// Makes room for that many further fragments.
  void reserve(std::size_t fragments);

  /// Adds a fragment with one value for each attribute. Returns an empty text, or the reason why
  /// the fragment does not fit the case.
  std::string add(const SamplePlace& at, float depth, std::span<const float> attributes);

  /// Returns the sorted fragments; the collector is then of no more use. Fails with a reason if a
  /// triangle has two fragments at a sample.
  tl::expected<Fragments, std::string> take();

 private:
  std::string fault_of(const SamplePlace& at, std::size_t attributes) const;
  tl::expected<Fragments, std::string> take_sorted();

  const Case& case_;
  Fragments added_;
  /// True if each fragment comes after the one before it. Most backends draw in this order, and
  /// sorting takes longer than everything else here.
  bool is_in_order_ = true;
};

}  // namespace rastercheck::cases
