#pragma once

// Fragments in any order, as files list them, brought into the order of cases::Fragments.

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

  /// Adds a fragment with one value for each attribute. Returns the reason why the case has no such
  /// triangle or sample, or an empty text.
  std::string add(const SamplePlace& at, float depth, std::span<const float> attributes);

  /// Takes the fragments in their order. Fails with a reason if a place occurs twice.
  tl::expected<Fragments, std::string> take();

 private:
  const Case& case_;
  std::vector<SamplePlace> places_;
  std::vector<float> depths_;
  std::vector<float> attributes_;  ///< [fragment][attribute]
};

}  // namespace rastercheck::cases
