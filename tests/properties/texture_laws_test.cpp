// The laws on textures: held by `cpu`, broken by one that is wrong about coordinates, texels,
// filters or discarding, silent of what they are not about.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using cases::Filter;
using cases::Picture;
using cases::Pipeline;
using cases::Wrap;
using records::AttributeKind;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kTexels = "texels are those of the exact coordinates";
constexpr std::string_view kFiltered = "filtered colours stay within the bound";
constexpr std::string_view kDiscard = "discarding draws what keeping the kept texels draws";

/// `cpu`, going wrong in one way with its pictures.
class TexturingBackend : public DamagedBackend {
 public:
  TexturingBackend() : DamagedBackend({}, "cpu"), cpu_(backends::make_backend("cpu").value()) {}

  bool draws_pictures() const override { return true; }
  Result<Picture> draw_picture(const Case& c, const Pipeline& pipeline) override {
    Case damaged = c;
    if (case_damage) case_damage(damaged);
    Pipeline changed = pipeline;
    if (pipeline_damage) pipeline_damage(changed);
    Result<Picture> picture = cpu_->draw_picture(damaged, changed);
    if (picture && picture_damage) picture_damage(*picture);
    return picture;
  }

  std::function<void(Case&)> case_damage;
  std::function<void(Pipeline&)> pipeline_damage;
  std::function<void(Picture&)> picture_damage;

 private:
  std::unique_ptr<backends::Backend> cpu_;
};

Check checked(std::string_view law, const Case& c, TexturingBackend& backend) {
  return find_law(law)->check(c, backend, {}).value();
}

Case case_of(std::string_view law, std::uint64_t index) {
  Draw draw(1, law, index);
  return find_law(law)->generate(draw).source;
}

/// How many of a hundred cases of the law a backend breaks.
int broken(std::string_view law, TexturingBackend& backend) {
  int count = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    count += checked(law, case_of(law, i), backend).violation_count > 0 ? 1 : 0;
  }
  return count;
}

int broken_by(std::string_view law, const std::function<void(Pipeline&)>& damage) {
  TexturingBackend backend;
  backend.pipeline_damage = damage;
  return broken(law, backend);
}

TEST(TextureLaws, MeetWhatTheyAreAbout) {
  const auto labels_of = [](std::string_view law) {
    TexturingBackend backend;
    std::set<std::string> labels;
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Check check = checked(law, case_of(law, i), backend);
      EXPECT_EQ(check.violation_count, 0U) << law << i;
      labels.insert(check.labels.begin(), check.labels.end());
    }
    return labels;
  };
  EXPECT_THAT(labels_of(kTexels),
              testing::IsSupersetOf({"texel border", "beyond 0 to 1", "repeat", "clamp", "mirror",
                                     "no one coordinate", "several samples", "w <= 0"}));
  EXPECT_THAT(labels_of(kFiltered),
              testing::IsSupersetOf({"bilinear", "trilinear", "level 0", "between levels",
                                     "last level", "no one coordinate", "several samples"}));
  EXPECT_THAT(labels_of(kDiscard), testing::IsSupersetOf({"discarded", "kept", "exactly the limit",
                                                          "overdraw", "several samples"}));
}

TEST(TextureLaws, AreSilentOfCasesWithoutCoordinates) {
  Case c = square();
  c.attributes.resize(1);
  c.attribute_values = {0, 8, 0, 8};
  for (const std::string_view law : {kTexels, kFiltered, kDiscard}) {
    TexturingBackend backend;
    EXPECT_TRUE(checked(law, square(), backend).is_applicable) << law;
    EXPECT_FALSE(checked(law, c, backend).is_applicable) << law;
  }
}

TEST(TextureLaws, AreSilentOfFiltersWithoutABound) {
  TexturingBackend backend;
  backend.promised = backend.contract(square());
  backend.promised->texture_bounds.reset();
  EXPECT_FALSE(is_promised(*find_law(kFiltered), backend));
  EXPECT_FALSE(checked(kFiltered, square(), backend).is_applicable);
  EXPECT_TRUE(is_promised(*find_law(kTexels), backend));
}

TEST(Texels, AreNamedWhereTheyAreWrong) {
  TexturingBackend backend;
  backend.picture_damage = [](Picture& picture) {
    picture.color[4 * 9 + 1] += 0x1p-20F;
    picture.color[4 * 10] = std::numeric_limits<float>::quiet_NaN();
  };
  const Check check = checked(kTexels, square(), backend);
  EXPECT_EQ(check.judgement.counts.required, 64U);
  ASSERT_EQ(check.violation_count, 2U);
  const records::Violation& green = check.violations[0];
  EXPECT_EQ(green.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(green.kind, AttributeKind::smooth);
  EXPECT_EQ(green.attribute, 1U);
  EXPECT_EQ(green.triangle, 0U);
  EXPECT_EQ(green.x, 1U);
  EXPECT_EQ(green.y, 1U);
  EXPECT_THAT(green.exact, HasSubstr("texel ("));
  EXPECT_THAT(green.note, HasSubstr("at s = 3/2, t = 1"));
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::not_a_number);
}

TEST(Texels, ShowCoordinatesOffByAFloat) {
  TexturingBackend backend;
  backend.case_damage = [](Case& c) {
    for (float& value : c.attribute_values) value = std::nextafter(value, -1e38F);
  };
  EXPECT_GT(broken(kTexels, backend), 20);
}

TEST(Texels, ShowEveryWrap) {
  const auto swapped = [](Wrap from, Wrap to) {
    return broken_by(kTexels, [from, to](Pipeline& pipeline) {
      if (pipeline.texturing->wrap_s == from) pipeline.texturing->wrap_s = to;
      if (pipeline.texturing->wrap_t == from) pipeline.texturing->wrap_t = to;
    });
  };
  EXPECT_GT(swapped(Wrap::repeat, Wrap::mirror), 20);
  EXPECT_GT(swapped(Wrap::mirror, Wrap::repeat), 10);
  EXPECT_GT(swapped(Wrap::clamp, Wrap::repeat), 10);
}

TEST(FilteredColours, ShowAnotherFilter) {
  const auto swapped = [](Filter from, Filter to) {
    return broken_by(kFiltered, [from, to](Pipeline& pipeline) {
      if (pipeline.texturing->filter == from) pipeline.texturing->filter = to;
    });
  };
  EXPECT_GT(swapped(Filter::bilinear, Filter::nearest), 20);
  EXPECT_GT(swapped(Filter::bilinear, Filter::trilinear), 10);
  EXPECT_GT(swapped(Filter::trilinear, Filter::bilinear), 10);
}

// Bytes of framebuffers are far off what a filter may be.
TEST(FilteredColours, ShowRoundingToBytes) {
  EXPECT_GT(
      broken_by(kFiltered, [](Pipeline& pipeline) { pipeline.format = cases::ColorFormat::rgba8; }),
      25);
}

// More than a few units of 2^-24 is too much where coordinates are small.
TEST(FilteredColours, AreJudgedByTheBound) {
  // So few pixels that the law judges them all.
  Case c = square();
  c.framebuffer = {4, 4, 1};
  c.viewport.width = c.viewport.height = 4;
  const auto found_of = [&c](float damage) {
    TexturingBackend backend;
    backend.picture_damage = [damage](Picture& picture) { picture.color[4 * 5] += damage; };
    return checked(kFiltered, c, backend);
  };
  EXPECT_EQ(found_of(0).violation_count, 0U);
  const Check check = found_of(0x1p-12F);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].x, 1U);
  EXPECT_EQ(check.violations[0].y, 1U);
  EXPECT_THAT(check.violations[0].note, HasSubstr("at s = 3, t = 1; allowed is "));
}

TEST(Discarding, ShowsWhatIsKeptOrLost) {
  EXPECT_EQ(broken_by(kDiscard, [](Pipeline&) {}), 0);
  EXPECT_GT(
      broken_by(kDiscard, [](Pipeline& pipeline) { pipeline.texturing->discard_below.reset(); }),
      30);
  // Not less, but less or equal.
  EXPECT_GT(broken_by(kDiscard,
                      [](Pipeline& pipeline) {
                        float& limit = *pipeline.texturing->discard_below;
                        limit = std::nextafter(limit, 2.0F);
                      }),
            5);
}

// A discarded fragment that leaves its depth, as if it had been drawn with no colour.
TEST(Discarding, ShowsDepthThatWasLeft) {
  TexturingBackend backend;
  backend.picture_damage = [](Picture& picture) {
    for (float& depth : picture.depth) {
      if (depth == 1) depth = 0.5F;
    }
  };
  EXPECT_GT(broken(kDiscard, backend), 30);
}

}  // namespace
}  // namespace rastercheck::properties
