#pragma once

// Collects fragments in any order, and sorts them into the order of cases::Fragments.

#include <span>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "cases/sample_place.h"

namespace rastercheck::cases {

class FragmentCollector {
 public:
  /// The case must outlive the collector.
  explicit FragmentCollector(const Case& c);

  /// Adds a fragment with one value for each attribute. Returns an empty text, or the reason why
  /// the fragment does not fit the case.
  std::string add(const SamplePlace& at, float depth, std::span<const float> attributes);

  /// Returns the sorted fragments. Fails with a reason if a triangle has two fragments at a sample.
  tl::expected<Fragments, std::string> take();

 private:
  const Case& case_;
  std::vector<SamplePlace> places_;
  std::vector<float> depths_;
  std::vector<float> attributes_;  ///< [fragment][attribute]
};

}  // namespace rastercheck::cases
