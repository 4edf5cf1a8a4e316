// The first 1,000 cases of every law are the same whatever compiler is used: their digests are in
// approved/digests.txt, which this program rewrites with UPDATE_APPROVED=1. Rewrite the digests,
// and start new baselines, after changing a generator or a law's own cases.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>

#include "cases/case_writer.h"
#include "properties/law.h"

namespace rastercheck::properties::digests_test {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::uint64_t kCases = 1000;

/// A digest of all numbers of the cases, in their order, and of their strata.
std::uint64_t digest_of(const Law& law) {
  std::uint64_t digest = 0;
  for (std::uint64_t index = 0; index < kCases; ++index) {
    Draw draw = draw_of(law, kSeed, index);
    const Generated made = law.generate(draw);
    digest = fnv1a(std::to_string(digest) + made.stratum + cases::to_json(made.source));
  }
  return digest;
}

TEST(Digests, OfTheFirstCasesAreTheApprovedOnes) {
  const std::string file =
      RASTERCHECK_SOURCE_DIR "/tests/properties/generators/approved/digests.txt";
  std::ostringstream digests;
  for (const Law& law : laws()) {
    digests << std::hex << std::setw(16) << std::setfill('0') << digest_of(law) << "  " << law.id
            << "\n";
  }
  if (std::getenv("UPDATE_APPROVED") != nullptr) {
    std::ofstream(file, std::ios::binary) << digests.str();
  }
  std::ifstream approved(file, std::ios::binary);
  std::istringstream now(digests.str());
  std::string approved_line;
  for (std::string line; std::getline(now, line);) {
    std::getline(approved, approved_line);
    ASSERT_EQ(line, approved_line) << "docs/adding-a-property.md says how a new one is approved";
  }
  EXPECT_FALSE(std::getline(approved, approved_line)) << approved_line;
}

}  // namespace
}  // namespace rastercheck::properties::digests_test
