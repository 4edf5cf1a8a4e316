// The law catches faces and ties that do not follow the mirror, names places in the original case,
// and does not apply to cases without a mirror image.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::mirror_mirrors_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::Contains;
using testing::HasSubstr;

constexpr std::string_view kLaw = "a-mirror-mirrors-the-picture";
constexpr int kNumbers = 32;

Check checked(const Case& c, backends::Backend& backend) { return check_of(kLaw, c, backend); }

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

/// The square's triangles in 12×8 pixels; another number makes the law choose another mirror.
Case wide(int number) {
  Case c = square();
  c.framebuffer = {12, 8, 1};
  c.viewport = {0.25F, -0.125F, 11.5F, 8.25F, 0, 1};
  c.attribute_values[2] = static_cast<float>(number);
  return c;
}

/// The first of the wide cases that the law mirrors in the labelled way, and not by a negative
/// height.
Case mirrored_so(const std::string& label) {
  for (int number = 0; number < kNumbers; ++number) {
    bool is_negative = false;
    const Check check = checked(wide(number), [&](const Case& c, Fragments&) {
      is_negative = is_negative || c.viewport.height < 0;
    });
    const bool is_so =
        std::find(check.labels.begin(), check.labels.end(), label) != check.labels.end();
    if (is_so && !is_negative) return wide(number);
  }
  ADD_FAILURE() << label;
  return square();
}

TEST(Mirror, MirrorsUnderAllRules) {
  std::set<std::string> labels;
  for (const cases::Rules rules : {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
    for (const cases::Cull cull : {cases::Cull::none, cases::Cull::front, cases::Cull::back}) {
      for (int number = 0; number < kNumbers; ++number) {
        Case c = wide(number);
        c.rules = rules;
        c.cull = cull;
        c.scissor = cases::Scissor{1, 2, 7, 5};
        c.attributes[0].interpolation = cases::Interpolation::flat;
        const Check check = checked(c, {});
        EXPECT_TRUE(check.is_applicable);
        EXPECT_EQ(check.violation_count, 0U);
        labels.insert(check.labels.begin(), check.labels.end());
        // Under Vulkan, clip y points down like window y, so the triangles are clockwise on the
        // screen.
        const bool is_kept = (rules == cases::Rules::vulkan) == (cull == cases::Cull::front);
        if (cull == cases::Cull::none || is_kept) {
          EXPECT_GE(check.judgement.counts.required + check.judgement.counts.permitted, 35U);
        }
      }
    }
  }
  EXPECT_THAT(labels, testing::IsSupersetOf({"both mirrored", "faces turned round",
                                             "left and right mirrored", "up and down mirrored"}));
}

TEST(Mirror, MirrorsPatternsOfSamplesBothWays) {
  for (const int samples : {2, 4, 8, 16}) {
    Case c = wide(0);
    c.framebuffer.samples = samples;
    c.viewport.x = 0.1875F;  // between columns of samples
    const Check check = checked(c, {});
    EXPECT_EQ(check.is_applicable, samples <= 4);
    EXPECT_EQ(check.violation_count, 0U);
    if (samples <= 4) {
      EXPECT_THAT(check.labels, Contains("both mirrored"));
    }
  }
}

TEST(Mirror, MirrorsNegativeHeights) {
  for (int number = 0; number < kNumbers; ++number) {
    Case c = wide(number);
    c.viewport.y += c.viewport.height;
    c.viewport.height = -c.viewport.height;
    const Check check = checked(c, {});
    EXPECT_EQ(check.violation_count, 0U);
    EXPECT_GT(check.judgement.counts.required, 60U);
  }
}

// Pixel (1, 3) becomes (10, 3) when left and right are mirrored, and (1, 4) when up and down are.
TEST(Mirror, FindsWhatIsMissingInThePlaceOfTheCaseAsItWas) {
  struct Way {
    std::string label;
    int x;
    int y;
  };
  for (const Way& way : {Way{"left and right mirrored", 10, 3}, Way{"up and down mirrored", 1, 4},
                         Way{"both mirrored", 10, 4}}) {
    const Case c = mirrored_so(way.label);
    const Check check = checked(c, [&](const Case& drawn_of, Fragments& drawn) {
      if (drawn_of.positions != c.positions) drop(drawn, 0, way.x, way.y);
    });
    ASSERT_EQ(check.violation_count, 1U) << way.label;
    EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
    EXPECT_EQ(check.violations.front().place.x, 1U);
    EXPECT_EQ(check.violations.front().place.y, 3U);
    EXPECT_THAT(check.violations.front().note, HasSubstr("drawn with " + way.label));
  }
}

// This backend takes counter-clockwise faces for front faces, whatever the case says. If the mirror
// changes the front face, the wrong triangles remain; if the mirror reverses the order of vertices
// instead, the law holds.
TEST(Mirror, FindsFacesThatDoNotTurn) {
  class Ccw : public DamagedBackend {
   public:
    Ccw() : DamagedBackend({}, "cpu") {}
    Result<Fragments> draw_fragments(const Case& c) override {
      Case other = c;
      other.front_face = cases::FrontFace::ccw;
      return DamagedBackend::draw_fragments(other);
    }
  };
  Ccw backend;
  std::set<bool> found;
  for (int number = 0; number < kNumbers; ++number) {
    Case c = wide(number);
    c.cull = cases::Cull::front;
    const Check check = checked(c, backend);
    found.insert(check.violation_count > 0);
    if (check.violation_count > 0) {
      EXPECT_THAT(check.labels, Contains("faces turned round"));
    }
  }
  EXPECT_EQ(found, (std::set{false, true}));
}

// When up and down are mirrored, samples on an upper or lower edge must follow the other tie rule.
TEST(Mirror, FindsTiesThatDoNotTurn) {
  class TopLeft : public DamagedBackend {
   public:
    TopLeft() : DamagedBackend({}, "cpu") {}
    Result<Fragments> draw_fragments(const Case& c) override {
      Case other = c;
      other.fill_rule = cases::TieRule::top_left;
      return DamagedBackend::draw_fragments(other);
    }
  };
  // The lower edge of the triangle lies on the samples of row 3.
  const auto tied = [](int number) {
    Case c = wide(number);
    c.viewport = {0.25F, -0.125F, 8, 7.25F, 0, 1};
    c.positions = {{-1, -1, 0.25F, 1}, {1, -1, 0.25F, 1}, {-1, 0, 0.25F, 1}, {1, 0, 0.25F, 1}};
    return c;
  };
  TopLeft backend;
  int found = 0;
  for (int number = 0; number < kNumbers; ++number) {
    EXPECT_EQ(checked(tied(number), {}).violation_count, 0U);
    const Check check = checked(tied(number), backend);
    if (check.violation_count == 0) continue;
    ++found;
    EXPECT_THAT(check.labels, Contains("up and down mirrored"));
  }
  EXPECT_GT(found, 0);
}

TEST(Mirror, LeavesTiesOfOtherMirrorsAlone) {
  Case c = mirrored_so("left and right mirrored");
  c.viewport = {0.25F, 0.75F, 8, 8, 0, 1};  // samples on the diagonal
  const Check check = checked(c, {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, Contains("tie"));
}

TEST(Mirror, SaysNothingOfWhatHasNoImage) {
  Case no_float = wide(0);
  no_float.viewport.x = 0x1p-30F;
  no_float.viewport.y = 0x1p-30F;
  EXPECT_FALSE(checked(no_float, {}).is_applicable);
  Case border = wide(0);  // its sides run through sample centres
  border.viewport = {0.5F, 0.5F, 10.25F, 7.25F, 0, 1};
  EXPECT_FALSE(checked(border, {}).is_applicable);
  DamagedBackend backend({}, "cpu");
  cases::Contract contract = backend.contract(wide(0));
  contract.coverage = cases::Snapping{8, cases::Rounding::half_up};
  backend.promised = contract;
  EXPECT_FALSE(checked(wide(0), backend).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::mirror_mirrors_test
