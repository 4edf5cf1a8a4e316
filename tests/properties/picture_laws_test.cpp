// The laws on pictures: held by a backend that draws by the model, broken by one with a wrong
// pipeline or a lost fragment, silent of backends without pictures.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "properties/law.h"
#include "tests/properties/picture_backend.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using cases::Framebuffer;
using cases::Picture;
using cases::Pipeline;
using records::AttributeKind;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kPicture = "a picture is what its fragments leave";
constexpr std::string_view kOverdraw = "additive blending counts overdraw";

Check checked(std::string_view law, const Case& c, PictureBackend& backend) {
  return find_law(law)->check(c, backend, {}).value();
}

Case case_of(std::string_view law, std::uint64_t index) {
  Draw draw(1, law, index);
  return find_law(law)->generate(draw).source;
}

/// How many of a hundred cases of the law a backend breaks.
int broken(std::string_view law, PictureBackend& backend) {
  int count = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    count += checked(law, case_of(law, i), backend).violation_count > 0 ? 1 : 0;
  }
  return count;
}

TEST(PictureLaws, AreOfBackendsThatDrawPictures) {
  for (const std::string_view law : {kPicture, kOverdraw}) {
    PictureBackend backend;
    EXPECT_TRUE(is_promised(*find_law(law), backend));
    EXPECT_TRUE(checked(law, square(), backend).is_applicable);
    DamagedBackend none;
    EXPECT_FALSE(is_promised(*find_law(law), none));
    EXPECT_FALSE(find_law(law)->check(square(), none, {}).value().is_applicable);
  }
}

TEST(PictureLaws, HoldOfTheModelAndMeetWhatTheyAreAbout) {
  for (const std::string_view law : {kPicture, kOverdraw}) {
    PictureBackend backend;
    std::set<std::string> labels;
    std::uint64_t required = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Check check = checked(law, case_of(law, i), backend);
      EXPECT_EQ(check.violation_count, 0U) << law << i;
      required += check.judgement.counts.required;
      labels.insert(check.labels.begin(), check.labels.end());
    }
    EXPECT_GT(required, 12000U) << law;
    if (law == kOverdraw) {
      EXPECT_THAT(labels, testing::IsSupersetOf({"clipped", "much overdraw", "overdraw",
                                                 "permitted", "several samples", "w <= 0"}));
    } else {
      EXPECT_THAT(
          labels,
          testing::IsSupersetOf(
              {"blend additive", "blend off", "blend over", "depth always", "depth equal",
               "depth greater", "depth greater or equal", "depth less", "depth less or equal",
               "depth never", "depth not equal", "depth not written", "overdraw", "resolved",
               "several samples", "rgba8", "vertex colours", "vertex colours without alpha"}));
    }
  }
}

TEST(APicture, IsCheckedToTheBit) {
  PictureBackend backend;
  backend.picture_damage = [](const Case&, Picture& picture) {
    picture.depth[9] += 0.125F;
    picture.color[10 * picture.channels + 1] = std::numeric_limits<float>::quiet_NaN();
  };
  const Check check = checked(kPicture, square(), backend);
  ASSERT_EQ(check.violation_count, 2U);
  const records::Violation& depth = check.violations[0];
  EXPECT_EQ(depth.kind, AttributeKind::depth);
  EXPECT_EQ(depth.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(depth.triangle, 0U);
  EXPECT_EQ(depth.x, 1U);
  EXPECT_EQ(depth.y, 1U);
  EXPECT_THAT(depth.note, HasSubstr("1 fragments there; vertex colours, depth "));
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::not_a_number);
  EXPECT_EQ(check.violations[1].attribute, 1U);
  EXPECT_EQ(check.violations[1].x, 2U);
}

TEST(APicture, ShowsEveryPartOfThePipeline) {
  const auto broken_by = [](const PipelineDamage& damage) {
    PictureBackend backend;
    backend.pipeline_damage = damage;
    return broken(kPicture, backend);
  };
  using cases::DepthFunction;
  EXPECT_EQ(broken_by([](Pipeline&) {}), 0);
  const auto swapped = [](DepthFunction from, DepthFunction to) {
    return [from, to](Pipeline& pipeline) {
      if (pipeline.depth_function == from) pipeline.depth_function = to;
    };
  };
  EXPECT_GT(broken_by(swapped(DepthFunction::less, DepthFunction::less_or_equal)), 0);
  EXPECT_GT(broken_by(swapped(DepthFunction::less_or_equal, DepthFunction::less)), 0);
  EXPECT_GT(broken_by(swapped(DepthFunction::greater, DepthFunction::greater_or_equal)), 0);
  EXPECT_GT(broken_by(swapped(DepthFunction::greater_or_equal, DepthFunction::greater)), 0);
  EXPECT_GT(broken_by(swapped(DepthFunction::equal, DepthFunction::never)), 0);
  EXPECT_GT(broken_by(swapped(DepthFunction::not_equal, DepthFunction::always)), 0);
  EXPECT_GT(broken_by([](Pipeline& pipeline) { pipeline.writes_depth = true; }), 5);
  EXPECT_GT(broken_by([](Pipeline& pipeline) { pipeline.clear_depth = 1; }), 10);
  EXPECT_GT(broken_by([](Pipeline& pipeline) { pipeline.blend = cases::Blend::off; }), 20);
}

// Attributes are the channels where these are not vertex colours, so that of four both are alike.
TEST(APicture, ShowsVertexColoursThatAreWrong) {
  const auto broken_by = [](const std::function<void(Picture&)>& damage) {
    PictureBackend backend;
    bool are_colors = false;
    backend.pipeline_damage = [&are_colors](Pipeline& pipeline) {
      are_colors = pipeline.shading == cases::Shading::vertex_colors;
    };
    backend.picture_damage = [&](const Case&, Picture& picture) {
      if (are_colors) damage(picture);
    };
    return broken(kPicture, backend);
  };
  EXPECT_EQ(broken_by([](Picture&) {}), 0);
  EXPECT_GT(broken_by([](Picture& picture) {
              for (std::size_t i = 0; i < picture.color.size(); i += 4) {
                std::swap(picture.color[i], picture.color[i + 2]);
              }
            }),
            20);
  EXPECT_GT(broken_by([](Picture& picture) {
              for (std::size_t i = 3; i < picture.color.size(); i += 4) {
                if (picture.color[i] == 1) picture.color[i] = 0;
              }
            }),
            5);
}

// Alpha that is not clamped, and bytes that are rounded down.
TEST(APicture, ShowsArithmeticThatIsNearlyRight) {
  PictureBackend backend;
  backend.picture_damage = [](const Case&, Picture& picture) {
    for (float& color : picture.color) color = std::trunc(color * 255) / 255;
  };
  EXPECT_GT(broken(kPicture, backend), 20);
}

TEST(APicture, OfAnotherShapeIsAnError) {
  PictureBackend backend;
  backend.picture_damage = [](const Case&, Picture& picture) { picture.depth.pop_back(); };
  const Result<Check> check = find_law(kPicture)->check(square(), backend, {});
  ASSERT_FALSE(check.has_value());
  EXPECT_THAT(check.error().reason, HasSubstr("picture does not have"));
}

TEST(Overdraw, CountsTheSquareOnce) {
  PictureBackend backend;
  const Check check = checked(kOverdraw, square(), backend);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 64U);
}

TEST(Overdraw, FindsWhatIsLostAndWhatIsDrawnTwice) {
  PictureBackend backend;
  backend.fragment_damage = [](const Case&, Framebuffer& drawn) {
    drop(drawn, 0, 1, 1);
    const std::size_t at = find(drawn, 1, 6, 6);
    drawn.x[at] = 5;  // where triangle 1 is drawn too
  };
  const Check check = checked(kOverdraw, square(), backend);
  ASSERT_EQ(check.violation_count, 3U);
  const records::Violation& lost = check.violations[0];
  EXPECT_EQ(lost.fragment_class, FragmentClass::missing);
  EXPECT_EQ(lost.x, 1U);
  EXPECT_EQ(lost.y, 1U);
  EXPECT_EQ(lost.exact, "1 required, 0 permitted");
  EXPECT_EQ(lost.actual, "0 (0x0p+0)");
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::extra);
  EXPECT_EQ(check.violations[1].x, 5U);
  EXPECT_EQ(check.violations[1].triangle, 1U);
  EXPECT_EQ(check.violations[2].fragment_class, FragmentClass::missing);
}

TEST(Overdraw, FindsWhatIsNoCount) {
  PictureBackend backend;
  backend.picture_damage = [](const Case&, Picture& picture) {
    picture.color[0] = 0.5F;
    picture.color[1] = std::numeric_limits<float>::infinity();
  };
  const Check check = checked(kOverdraw, square(), backend);
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::infinite);
}

// The diagonal's samples are permitted of both: one, two or none of the triangles may draw them.
TEST(Overdraw, LetsPermittedSamplesBe) {
  PictureBackend backend("method:rational-linear");
  backend.fragment_damage = [](const Case&, Framebuffer& drawn) {
    drop(drawn, 1, 3, 4);
    add(drawn, 0, 4, 3);
    value(drawn, 0, 4, 3, 0) = 1;
  };
  const Check check = checked(kOverdraw, square(), backend);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.permitted, 16U);
}

}  // namespace
}  // namespace rastercheck::properties
