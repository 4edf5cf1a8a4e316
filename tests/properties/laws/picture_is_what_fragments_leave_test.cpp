// A backend that draws by the model keeps the law; a backend with a wrong pipeline or wrong numbers
// breaks it. The law does not apply to backends without pictures.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/laws/driver_bounds.h"
#include "tests/properties/laws/own_cases.h"
#include "tests/properties/laws/picture_backend.h"

namespace rastercheck::properties::picture_is_what_fragments_leave_test {
namespace {

using cases::Picture;
using cases::Pipeline;
using records::AttributeKind;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "a-picture-is-what-its-fragments-leave";

/// The number of the law's first hundred cases that the backend breaks.
int broken(PictureBackend& backend) { return check_own_cases(kLaw, backend, 100).violated; }

TEST(APicture, IsOfBackendsThatDrawPictures) {
  PictureBackend backend;
  EXPECT_TRUE(is_promised(*find_law(kLaw), backend));
  EXPECT_TRUE(check_of(kLaw, square(), backend).is_applicable);
  DamagedBackend none;
  EXPECT_FALSE(is_promised(*find_law(kLaw), none));
  EXPECT_FALSE(check_of(kLaw, square(), none).is_applicable);
}

TEST(APicture, IsTheModelsAndMeetsWhatTheLawIsAbout) {
  PictureBackend backend;
  const FoundInOwnCases found = check_own_cases(kLaw, backend, 200);
  EXPECT_EQ(found.violated, 0);
  EXPECT_GT(found.required, 12000U);
  EXPECT_THAT(found.labels(),
              testing::IsSupersetOf(
                  {"blend additive", "blend off", "blend over", "depth always", "depth equal",
                   "depth greater", "depth greater or equal", "depth less", "depth less or equal",
                   "depth never", "depth not equal", "depth not written", "overdraw", "resolved",
                   "several samples", "rgba8", "vertex colours", "vertex colours without alpha"}));
}

TEST(APicture, IsCheckedToTheBit) {
  PictureBackend backend;
  backend.picture_damage = [](const Pipeline&, Picture& picture) {
    picture.depth[9] += 0.125F;
    picture.color[10 * picture.channels + 1] = std::numeric_limits<float>::quiet_NaN();
  };
  const Check check = check_of(kLaw, square(), backend);
  ASSERT_EQ(check.violation_count, 2U);
  const records::Violation& depth = check.violations[0];
  EXPECT_EQ(depth.kind, AttributeKind::depth);
  EXPECT_EQ(depth.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(depth.place.triangle, 0U);
  EXPECT_EQ(depth.place.x, 1U);
  EXPECT_EQ(depth.place.y, 1U);
  EXPECT_THAT(depth.note, HasSubstr("1 fragments there; vertex colours, depth "));
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::not_a_number);
  EXPECT_EQ(check.violations[1].attribute, 1U);
  EXPECT_EQ(check.violations[1].place.x, 2U);
}

TEST(APicture, ShowsEveryPartOfThePipeline) {
  const auto broken_by = [](const PipelineDamage& damage) {
    PictureBackend backend;
    backend.pipeline_damage = damage;
    return broken(backend);
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

// Without vertex colours the attributes are the channels, so that four attributes give the same
// picture either way. The damage is applied only to pictures with vertex colours.
TEST(APicture, ShowsVertexColoursThatAreWrong) {
  const auto broken_by = [](const std::function<void(Picture&)>& damage) {
    PictureBackend backend;
    bool are_colors = false;
    backend.pipeline_damage = [&are_colors](Pipeline& pipeline) {
      are_colors = pipeline.shading == cases::Shading::vertex_colors;
    };
    backend.picture_damage = [&](const Pipeline&, Picture& picture) {
      if (are_colors) damage(picture);
    };
    return broken(backend);
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

// Colours rounded down to bytes.
TEST(APicture, ShowsArithmeticThatIsNearlyRight) {
  PictureBackend backend;
  backend.picture_damage = [](const Pipeline&, Picture& picture) {
    for (float& color : picture.color) color = std::trunc(color * 255) / 255;
  };
  EXPECT_GT(broken(backend), 20);
}

TEST(APicture, OfAnotherShapeIsAnError) {
  PictureBackend backend;
  backend.picture_damage = [](const Pipeline&, Picture& picture) { picture.depth.pop_back(); };
  const Result<Check> check = check_law(*find_law(kLaw), square(), backend, 0);
  ASSERT_FALSE(check.has_value());
  EXPECT_THAT(check.error().reason, HasSubstr("picture does not have"));
}

TEST(APicture, OfADriverStaysWithinItsBounds) {
  PictureBackend backend;
  backend.picture_bounds = driver_bounds();
  EXPECT_EQ(broken(backend), 0);
  backend.picture_damage = [](const Pipeline& pipeline, Picture& picture) {
    const bool is_rgba8 = pipeline.format == cases::ColorFormat::rgba8;
    for (float& color : picture.color) {
      color = is_rgba8 ? color : std::nextafter(color, std::numeric_limits<float>::infinity());
    }
  };
  backend.picture_bounds->float_error = 0;
  EXPECT_GT(broken(backend), 30);
  backend.picture_bounds = driver_bounds();
  backend.picture_damage = [](const Pipeline&, Picture& picture) {
    for (float& color : picture.color) color = color == 0 ? 0 : color + 5.0F / 255;
  };
  EXPECT_GT(broken(backend), 40);
  backend.picture_bounds->keeps_fragments = false;
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
}

}  // namespace
}  // namespace rastercheck::properties::picture_is_what_fragments_leave_test
