// The choice of a SIMD target is made, undone, and left alone if there is no such target.

#include "rasterizer/simd.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace rastercheck::rasterizer::simd_test {
namespace {

std::vector<std::string> supported() {
  std::vector<std::string> names;
  for (const SimdTarget& target : simd_targets()) {
    if (target.is_supported) names.push_back(target.name);
  }
  return names;
}

/// The index of the target in use in the kernels' tables.
std::size_t index_in_use() { return hwy::GetChosenTarget().GetIndex(); }

TEST(Simd, TargetsThatAreSupportedAreThoseOfTheKernels) {
  EXPECT_EQ(supported().size(), hwy::SupportedAndGeneratedTargets().size());
  for (const SimdTarget& target : simd_targets()) {
    EXPECT_TRUE(target.is_compiled || !target.is_supported) << target.name;
    EXPECT_EQ(std::count_if(target.name.begin(), target.name.end(),
                            [](char c) { return 'A' <= c && c <= 'Z'; }),
              0)
        << target.name;
  }
}

TEST(Simd, EachTargetIsUsedAsLongAsItIsAskedFor) {
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  const std::size_t best = index_in_use();
  std::set<std::size_t> used;
  for (const std::string& name : supported()) {
    {
      const OnSimdTarget on(name);
      used.insert(index_in_use());
    }
    EXPECT_EQ(index_in_use(), best) << name;
  }
  EXPECT_EQ(used.size(), supported().size());
  EXPECT_TRUE(used.contains(best));
}

TEST(Simd, UnknownTargetsChangeNothing) {
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  const std::size_t best = index_in_use();
  for (const char* name : {"", "mmx", "SSE4", "unknown"}) {
    const OnSimdTarget on(name);
    const OnSimdTarget again(name);  // must not wait for the first
    EXPECT_EQ(index_in_use(), best) << name;
  }
}

TEST(Simd, OneThreadWaitsForTheOther) {
  const std::string least = supported().back();
  std::size_t index = 0;
  {
    const OnSimdTarget on(least);
    index = index_in_use();
  }
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    threads.emplace_back([&, i] {
      for (int turn = 0; turn < 100; ++turn) {
        const OnSimdTarget on(least);
        wrong[i] += index_in_use() == index ? 0 : 1;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace rastercheck::rasterizer::simd_test
