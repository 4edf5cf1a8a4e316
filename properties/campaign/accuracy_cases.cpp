#include "properties/campaign/accuracy_cases.h"

#include <fmt/format.h>

#include "properties/law.h"
#include "records/accuracy.h"

namespace rastercheck::properties {

std::vector<cases::Case> accuracy_cases(std::uint64_t seed, std::uint64_t count) {
  cases::Capabilities capabilities;
  capabilities.rules = {cases::Rules::opengl};
  capabilities.sample_counts = {1, 4};
  const Law& law = *find_law(records::kValuesLaw);
  std::vector<cases::Case> all;
  for (std::uint64_t i = 0; i < count; ++i) {
    all.push_back(random_case(law, seed, i, capabilities).source);
    all.back().name = fmt::format("accuracy-{:04}", i + 1);
    all.back().essential.emplace();
  }
  return all;
}

}  // namespace rastercheck::properties
