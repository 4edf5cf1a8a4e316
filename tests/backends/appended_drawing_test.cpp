// Tests fragments that are appended as records, with a fake driver.

#include "backends/appended_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace rastercheck::backends::appended_drawing_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Triangles side by side. Triangle t has t + 1 fragments: pixels (i, t) with the depth i/8 and the
/// attributes 10 t + i and −i.
cases::Case fan(std::size_t triangles) {
  cases::Case c;
  c.framebuffer = {8, 8, 1};
  c.attributes = {{"a"}, {"b"}};
  c.positions.resize(3);
  c.attribute_values.resize(6);
  c.triangles.assign(triangles, {0, 1, 2});
  return c;
}

/// A driver that returns records in reverse order.
class FakeDriver {
 public:
  explicit FakeDriver(std::vector<RecordLayout> layouts) : layouts_(std::move(layouts)) {}

  std::size_t most = 1000;  ///< words that fit into the buffer
  /// Changes a record, given its layout, its triangle and the index of its fragment.
  std::function<void(std::size_t, std::size_t, std::size_t, std::vector<std::uint32_t>&)> change;
  std::vector<std::size_t> counts;           ///< numbers of triangles in all draws
  std::vector<std::size_t> drawn_in_layers;  ///< numbers of triangles drawn together

  AppendingDriver driver() {
    return {most,
            [this](std::size_t layout, std::size_t first, std::size_t count, std::size_t room) {
              return draw(layout, first, count, room);
            },
            [this] { return std::span<const std::uint32_t>(words_); },
            [this](const cases::Case& c) { return draw_in_layers(c); }};
  }

 private:
  Result<std::size_t> draw(std::size_t layout, std::size_t first, std::size_t count,
                           std::size_t room) {
    counts.push_back(count);
    std::vector<std::vector<std::uint32_t>> all;
    for (std::size_t t = first; t < first + count; ++t) {
      for (std::size_t i = 0; i <= t; ++i) {
        std::vector<std::uint32_t> record{bits(t - first + 1),
                                          static_cast<std::uint32_t>(i | t << 16U),
                                          bits(static_cast<double>(i) / 8)};
        for (const RecordLayout::Value& value : layouts_[layout].values) {
          record.resize(std::max(record.size(), value.word + 1));
          record[value.word] = bits(value.attribute == 0 ? static_cast<double>(10 * t + i)
                                                         : -static_cast<double>(i));
        }
        record.resize(layouts_[layout].words);
        if (change) change(layout, t, i, record);
        if (!record.empty()) all.push_back(std::move(record));
      }
    }
    words_.clear();
    std::reverse(all.begin(), all.end());
    for (const auto& record : all) words_.insert(words_.end(), record.begin(), record.end());
    const std::size_t had = all.size();
    if (had > room) words_.clear();
    return had;
  }
  /// Identifies triangles by the x of their first vertex: see numbered().
  Result<cases::Fragments> draw_in_layers(const cases::Case& c) {
    drawn_in_layers.push_back(c.triangles.size());
    cases::Fragments drawn;
    drawn.attribute_count = 2;
    for (std::size_t k = 0; k < c.triangles.size(); ++k) {
      const auto t = static_cast<std::size_t>(c.positions[c.triangles[k][0]].x);
      for (std::size_t i = 0; i <= t; ++i) {
        drawn.triangle.push_back(static_cast<std::uint32_t>(k));
        drawn.x.push_back(static_cast<std::uint16_t>(i));
        drawn.y.push_back(static_cast<std::uint16_t>(t));
        drawn.sample.push_back(0);
        drawn.depth.push_back(static_cast<float>(i) / 8);
        drawn.attributes.push_back(static_cast<float>(10 * t + i));
        drawn.attributes.push_back(-static_cast<float>(i));
      }
    }
    return drawn;
  }

  template <typename Number>
  static std::uint32_t bits(Number value) {
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  }

  std::vector<RecordLayout> layouts_;
  std::vector<std::uint32_t> words_;
};

/// The fan, with vertices by which triangles can be told apart.
cases::Case numbered(std::size_t triangles) {
  cases::Case c = fan(triangles);
  for (std::size_t t = 0; t < triangles; ++t) c.triangles[t][0] = static_cast<std::uint32_t>(t);
  c.positions.resize(std::max<std::size_t>(triangles, 3));
  for (std::size_t t = 0; t < triangles; ++t) c.positions[t].x = static_cast<float>(t);
  c.attribute_values.resize(2 * c.positions.size());
  return c;
}

const std::vector<RecordLayout> kBoth{{5, {{3, 0}, {4, 1}}}};
const std::vector<RecordLayout> kOneEach{{4, {{3, 0}}}, {4, {{3, 1}}}};

Result<cases::Fragments> drawn(const cases::Case& c, FakeDriver& driver,
                               const std::vector<RecordLayout>& layouts, bool is_checked = true) {
  return draw_appended(c, layouts, driver.driver(), is_checked, [] {});
}

TEST(AppendedDrawing, SortsRecordsByTriangleAndPixel) {
  FakeDriver driver(kBoth);
  const cases::Fragments all = drawn(numbered(3), driver, kBoth).value();
  EXPECT_THAT(all.triangle, ElementsAre(0, 1, 1, 2, 2, 2));
  EXPECT_THAT(all.x, ElementsAre(0, 0, 1, 0, 1, 2));
  EXPECT_THAT(all.y, ElementsAre(0, 1, 1, 2, 2, 2));
  EXPECT_THAT(all.depth, ElementsAre(0, 0, 0.125F, 0, 0.125F, 0.25F));
  EXPECT_THAT(all.attributes, ElementsAre(0, 0, 10, 0, 11, -1, 20, 0, 21, -1, 22, -2));
  EXPECT_THAT(driver.counts, ElementsAre(3));
}

// Kills: matching the second draw's values with the wrong fragments of the first draw.
TEST(AppendedDrawing, TakesAttributesOfSeveralDraws) {
  FakeDriver driver(kOneEach);
  const cases::Fragments all = drawn(numbered(3), driver, kOneEach).value();
  EXPECT_THAT(all.attributes, ElementsAre(0, 0, 10, 0, 11, -1, 20, 0, 21, -1, 22, -2));
}

// Kills: reading records beyond the room; drawing a triangle twice, or leaving it out, where the
// range of triangles is split.
TEST(AppendedDrawing, SplitsDrawsThatExceedTheRecordBuffer) {
  FakeDriver driver(kBoth);
  driver.most = 5 * 9;  // room for nine records
  const cases::Fragments all = drawn(numbered(6), driver, kBoth).value();
  FakeDriver roomy(kBoth);
  const cases::Fragments expected = drawn(numbered(6), roomy, kBoth).value();
  EXPECT_EQ(all.triangle, expected.triangle);
  EXPECT_EQ(all.x, expected.x);
  EXPECT_EQ(all.attributes, expected.attributes);
  EXPECT_GT(driver.counts.size(), 3U);
}

TEST(AppendedDrawing, DrawsATriangleIntoALayerThatIsTooLargeAlone) {
  FakeDriver driver(kBoth);
  driver.most = 5 * 4;  // triangles 4 and 5 have five and six fragments
  const cases::Fragments all = drawn(numbered(6), driver, kBoth, false).value();
  EXPECT_EQ(all.size(), 21U);
  EXPECT_TRUE(std::is_sorted(all.triangle.begin(), all.triangle.end()));
  EXPECT_THAT(driver.drawn_in_layers, ElementsAre(1, 1));
}

// Kills: not noticing that records are lost or that values differ.
TEST(AppendedDrawing, HoldsSomeTrianglesAgainstLayers) {
  for (const int what : {0, 1, 2}) {
    FakeDriver driver(kBoth);
    driver.change = [what](std::size_t, std::size_t t, std::size_t i,
                           std::vector<std::uint32_t>& record) {
      if (t != 2 || i != 1) return;
      if (what == 0) record.clear();
      if (what == 1) record[3] ^= 1U;
      if (what == 2) record[1] += 1U << 16U;
    };
    const cases::Fragments all = drawn(numbered(4), driver, kBoth).value();
    FakeDriver right(kBoth);
    const cases::Fragments expected = drawn(numbered(4), right, kBoth).value();
    EXPECT_EQ(all.x, expected.x) << what;
    EXPECT_EQ(all.y, expected.y) << what;
    EXPECT_EQ(all.attributes, expected.attributes) << what;
    EXPECT_THAT(driver.drawn_in_layers, ElementsAre(4, 4)) << what;
    // If appending is requested, the result is what was appended.
    const cases::Fragments appended = drawn(numbered(4), driver, kBoth, false).value();
    EXPECT_TRUE(appended.attributes != all.attributes || appended.y != all.y) << what;
  }
}

// Kills: a fragment that appears twice, in an order that may differ each time.
TEST(AppendedDrawing, SortsRecordsOfOnePixelByTheirBits) {
  for (const bool is_turned : {false, true}) {
    FakeDriver driver(kBoth);
    driver.change = [is_turned](std::size_t, std::size_t t, std::size_t i,
                                std::vector<std::uint32_t>& record) {
      if (t != 2) return;
      record[1] = 0;
      record[2] = std::bit_cast<std::uint32_t>((i == 0) == is_turned ? 0.25F : 0.75F);
    };
    const cases::Fragments all = drawn(numbered(3), driver, kBoth, false).value();
    EXPECT_EQ(all.depth[3], 0.25F);
    EXPECT_EQ(all.depth[5], 0.75F);
  }
}

// Kills: using the depth that a shader sees as the depth that a buffer holds.
TEST(AppendedDrawing, TakesDepthsBeyondTheRangeFromLayers) {
  for (const float beyond : {std::numeric_limits<float>::quiet_NaN(), -0.5F, 1.5F, -0.0F}) {
    FakeDriver driver(kBoth);
    driver.change = [beyond](std::size_t, std::size_t t, std::size_t i,
                             std::vector<std::uint32_t>& record) {
      if (t == 2 && i == 1) record[2] = std::bit_cast<std::uint32_t>(beyond);
    };
    const cases::Fragments all = drawn(numbered(3), driver, kBoth, false).value();
    EXPECT_THAT(all.depth, ElementsAre(0, 0, 0.125F, 0, 0.125F, 0.25F)) << beyond;
    EXPECT_THAT(driver.drawn_in_layers, ElementsAre(1));
  }
}

TEST(AppendedDrawing, RefusesRecordsOfNoTriangle) {
  for (const float number : {0.0F, 4.0F, 1.5F, std::numeric_limits<float>::quiet_NaN()}) {
    FakeDriver driver(kBoth);
    driver.change = [number](std::size_t, std::size_t t, std::size_t,
                             std::vector<std::uint32_t>& record) {
      if (t == 1) record[0] = std::bit_cast<std::uint32_t>(number);
    };
    const auto all = drawn(numbered(3), driver, kBoth, false);
    ASSERT_FALSE(all) << number;
    EXPECT_THAT(all.error().reason, HasSubstr("a flat triangle number was drawn as"));
  }
}

TEST(AppendedDrawing, RefusesOtherSamplesInASecondDraw) {
  FakeDriver driver(kOneEach);
  driver.change = [](std::size_t layout, std::size_t t, std::size_t i,
                     std::vector<std::uint32_t>& record) {
    if (layout == 1 && t == 1 && i == 1) record.clear();
  };
  const auto all = drawn(numbered(3), driver, kOneEach, false);
  ASSERT_FALSE(all);
  EXPECT_THAT(all.error().reason, HasSubstr("covered other samples"));
}

// Only the judge decides about a fragment outside the target.
TEST(AppendedDrawing, KeepsFragmentsOutsideTheTarget) {
  FakeDriver driver(kBoth);
  driver.change = [](std::size_t, std::size_t t, std::size_t i,
                     std::vector<std::uint32_t>& record) {
    if (t == 1 && i == 1) record[1] = 300 | 9U << 16U;
  };
  const cases::Fragments all = drawn(numbered(2), driver, kBoth, false).value();
  EXPECT_THAT(all.x, ElementsAre(0, 0, 300));
  EXPECT_THAT(all.y, ElementsAre(0, 1, 9));
}

TEST(AppendedDrawing, TellsProgressAfterEachDraw) {
  FakeDriver driver(kBoth);
  driver.most = 5 * 9;
  int told = 0;
  ASSERT_TRUE(draw_appended(numbered(6), kBoth, driver.driver(), false, [&told] { ++told; }));
  EXPECT_GT(told, 1);
}

TEST(AppendedDrawing, IsNotForAllCases) {
  EXPECT_EQ(lacks_of_appending(fan(1)), "");
  cases::Case c = fan(1);
  c.framebuffer.samples = 4;
  EXPECT_NE(lacks_of_appending(c), "");
  c = fan(1);
  c.depth_test = cases::DepthTest::less;
  EXPECT_NE(lacks_of_appending(c), "");
  c = fan(1);
  c.depth_clamp = true;
  EXPECT_NE(lacks_of_appending(c), "");
  c = fan(1);
  c.depth_bias.clamp = 1;  // limits nothing
  EXPECT_EQ(lacks_of_appending(c), "");
  c.depth_bias.slope = 1;
  EXPECT_NE(lacks_of_appending(c), "");
  c = fan(1);
  c.depth_format = cases::DepthFormat::unorm16;
  EXPECT_NE(lacks_of_appending(c), "");
}

}  // namespace
}  // namespace rastercheck::backends::appended_drawing_test
