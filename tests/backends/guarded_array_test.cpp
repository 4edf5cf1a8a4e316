#include "backends/plugin/guarded_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>

namespace rastercheck::backends::guarded_array_test {
namespace {

TEST(GuardedArray, HoldsWhatItIsGiven) {
  GuardedArray array("array");
  EXPECT_EQ(array.data(), nullptr);
  ASSERT_TRUE(array.resize(10000));
  std::fill_n(array.data(), 10000, std::byte{7});
  EXPECT_TRUE(array.is_front_whole());
  const std::array<std::byte, 3> bytes{std::byte{1}, std::byte{2}, std::byte{3}};
  ASSERT_TRUE(array.assign(bytes));
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), array.data()));
  ASSERT_TRUE(array.assign({}));
  EXPECT_EQ(array.data(), nullptr);
}

TEST(GuardedArray, KnowsWhatWasWrittenBeforeIt) {
  GuardedArray array("array");
  ASSERT_TRUE(array.resize(5));
  EXPECT_TRUE(array.is_front_whole());
  array.data()[-1] = std::byte{0};
  EXPECT_FALSE(array.is_front_whole());
}

// Kills: blaming a fault of one drawing on all later ones.
TEST(GuardedArray, IsWholeAgainWhenItIsSetAnew) {
  GuardedArray array("array");
  ASSERT_TRUE(array.resize(5));
  array.data()[-1] = std::byte{0};
  ASSERT_TRUE(array.resize(5));
  EXPECT_TRUE(array.is_front_whole());
}

/// Restores the default handler, as sanitizers have handlers that end with another status.
void set_up() {
  ::signal(SIGSEGV, SIG_DFL);
  report_wrong_accesses();
}

using GuardedArrayDeathTest = testing::Test;

TEST(GuardedArrayDeathTest, BeginsWhereItSays) {
  GuardedArray array("output->depth");
  ASSERT_TRUE(array.resize(4096));
  volatile std::byte* const data = array.data();
  EXPECT_EXIT(
      {
        set_up();
        data[-3] = std::byte{1};
      },
      testing::KilledBySignal(SIGSEGV),
      "the plugin touched output->depth before its beginning, by 3 bytes\n");
}

// Kills: reporting an address for a signal that was sent; a process that goes on.
TEST(GuardedArrayDeathTest, EndsWithSignalsThatAreSent) {
  EXPECT_EXIT(
      {
        set_up();
        ::raise(SIGSEGV);
      },
      testing::KilledBySignal(SIGSEGV), "^$");
}

TEST(GuardedArrayDeathTest, EndsWhereItSays) {
  for (const std::size_t size : {1UL, 4096UL, 10000UL}) {
    GuardedArray array("output->depth");
    ASSERT_TRUE(array.resize(size));
    volatile std::byte* const data = array.data();
    data[size - 1] = std::byte{1};
    EXPECT_EXIT(
        {
          set_up();
          data[size] = std::byte{1};
        },
        testing::KilledBySignal(SIGSEGV),
        "the plugin touched output->depth beyond its end, by 1 byte\n");
  }
}

TEST(GuardedArrayDeathTest, IsNotWrittenWhereItMayOnlyBeRead) {
  GuardedArray array("draw->positions");
  const std::array<std::byte, 3> bytes{};
  ASSERT_TRUE(array.assign(bytes));
  volatile std::byte* const data = array.data();
  EXPECT_EXIT(
      {
        set_up();
        data[2] = std::byte{1};
      },
      testing::KilledBySignal(SIGSEGV), "the plugin wrote to draw->positions, which it may only");
  EXPECT_EXIT(
      {
        set_up();
        volatile std::byte* nothing = nullptr;
        *nothing = std::byte{1};
      },
      testing::KilledBySignal(SIGSEGV), "the plugin touched address 0x0, which is in none");
}

}  // namespace
}  // namespace rastercheck::backends::guarded_array_test
