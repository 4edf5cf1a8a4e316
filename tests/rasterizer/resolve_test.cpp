// Resolving: the mean of each pixel's samples, rounded once.

#include <gtest/gtest.h>

#include <cstdint>

#include "rasterizer/rasterizer.h"
#include "tests/rasterizer/failing_allocator.h"

namespace rastercheck::rasterizer::resolve_test {
namespace {

Picture two_pixels(int samples, std::size_t attributes, ColorFormat format) {
  Picture framebuffer;
  framebuffer.format = format;
  EXPECT_EQ(clear(framebuffer, {2, 1, samples}, attributes, 1), std::nullopt);
  return framebuffer;
}

TEST(Resolve, TakesTheMeanOfFloatsAndTheFirstDepth) {
  Picture from = two_pixels(2, 2, ColorFormat::float32);
  from.attributes = {1, 10, 2, 30, 0x1p24F, -1, 1, -1};
  from.depth = {0.25F, 0.5F, 0.75F, 0};
  Picture into;
  ASSERT_EQ(resolve(from, into), std::nullopt);
  EXPECT_EQ(into.size.samples, 1);
  EXPECT_EQ(into.size.width, 2);
  EXPECT_EQ(into.depth, (Picture::Values{0.25F, 0.75F}));
  // The sum 2^24 + 1 is not a float, and must not be rounded; half of it is a float.
  EXPECT_EQ(into.attributes, (Picture::Values{1.5F, 20, 0x1p23F + 0.5F, -1}));
}

TEST(Resolve, RoundsMeansOfBytesToTheNearestAndToEven) {
  Picture from = two_pixels(2, 4, ColorFormat::rgba8);
  from.bytes = {1, 2, 255, 0, 2, 5, 255, 1, 0, 0, 0, 0, 1, 3, 255, 254};
  Picture into;
  ASSERT_EQ(resolve(from, into), std::nullopt);
  EXPECT_EQ(into.format, ColorFormat::rgba8);
  EXPECT_EQ(into.bytes, (Picture::Bytes{2, 4, 255, 0, 0, 2, 128, 127}));
  EXPECT_TRUE(into.attributes.empty());
}

TEST(Resolve, RefusesWhatIsNotWellFormed) {
  Picture from = two_pixels(4, 1, ColorFormat::float32);
  from.depth.pop_back();
  Picture into;
  EXPECT_EQ(resolve(from, into), Error::target_size);
}

TEST(Resolve, RunningOutOfMemoryLeavesTheOld) {
  if (!kCanRunOutOfMemory) GTEST_SKIP() << "the allocator is that of ThreadSanitizer";
  const Picture from = two_pixels(4, 4, ColorFormat::rgba8);
  for (const int allocations : {0, 1}) {
    Picture into;
    ASSERT_EQ(clear(into, {1, 1, 1}, 1, 0.5F), std::nullopt);
    EXPECT_EQ(with_allocations(allocations, [&] { return resolve(from, into); }),
              Error::out_of_memory);
    EXPECT_EQ(into.format, ColorFormat::float32);
    EXPECT_EQ(into.depth, Picture::Values(1, 0.5F));
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::resolve_test
