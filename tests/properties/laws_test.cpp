// Every law catches its kind of defect and names the place, lets the others pass, and holds of
// `cpu` as it is.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using cases::Framebuffer;
using records::AttributeKind;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kCoverage = "coverage obeys the contract";
constexpr std::string_view kValues = "values stay within the bound";
constexpr std::string_view kSharedEdge = "a shared edge covers each sample once";
constexpr std::string_view kOrder = "vertex order changes nothing beyond the bound";
constexpr std::string_view kConstants = "constants stay constant";
constexpr std::string_view kVertexValues = "values at vertices come back";
constexpr std::string_view kTraced = "the traced value is the drawn value";
constexpr std::string_view kDerivatives = "screen derivatives stay within the bound";
constexpr std::string_view kStrips = "strips and fans are their triangles";
constexpr std::string_view kVertexStage = "the vertex stage stays within its bound";
constexpr std::string_view kNormals = "normals stay within their bound";
constexpr std::string_view kPicture = "a picture is what its fragments leave";
constexpr std::string_view kOverdraw = "additive blending counts overdraw";

constexpr std::string_view kDifferences = "differences across quads stay within the bound";
constexpr std::string_view kTexels = "texels are those of the exact coordinates";
constexpr std::string_view kFiltered = "filtered colours stay within the bound";
constexpr std::string_view kDiscard = "discarding draws what keeping the kept texels draws";

/// The square with a clip distance that is positive everywhere, so that each law on fragments has
/// something to say.
Case kept_square() {
  Case c = square();
  c.clip_distance_count = 1;
  c.clip_distances = {1, 1, 1, 1};
  return c;
}

float next_float(float value) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) + 1);
}

TEST(Laws, AreKnownByTheirNames) {
  std::vector<std::string_view> names;
  for (const Law& law : laws()) {
    names.push_back(law.name);
    EXPECT_EQ(find_law(law.name)->name, law.name);
    EXPECT_NE(law.reason, "") << law.name;
    EXPECT_NE(law.exceptions, "") << law.name;
  }
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_GE(names.size(), 21U);
  EXPECT_EQ(find_law("a law"), nullptr);
}

TEST(Laws, AskForNoMoreThanChanceAllows) {
  EXPECT_EQ(least_reached(cover(10, "tie"), 0), 0U);
  EXPECT_EQ(least_reached(cover(10, "tie"), 100), 0U);    // 10 − √276
  EXPECT_EQ(least_reached(cover(10, "tie"), 1000), 48U);  // 100 − √2763 = 47.4…
  EXPECT_EQ(least_reached(cover(100, "tie"), 1000000), 994744U);
}

// Kills: a backend that leaves ties or placements open, and has to reach what it leaves open.
TEST(Laws, KnowWhichBackendsDrawWhatIsAskedFor) {
  const auto draws = [](const char* specification) {
    return draws_what_is_asked_for(*backends::make_backend(specification).value());
  };
  EXPECT_TRUE(draws("cpu"));
  EXPECT_TRUE(draws("cpu:precision=float32"));
  EXPECT_FALSE(draws("method:rational-linear"));
  DamagedBackend snapped({}, "cpu");
  snapped.promised = cases::Contract();
  snapped.promised->coverage = cases::Snapping();
  EXPECT_FALSE(draws_what_is_asked_for(snapped));
}

TEST(Laws, MakeCasesThatComeBackFromTheirFilesAndNameTheirStratum) {
  for (const Law& law : laws()) {
    std::set<std::string> strata;
    for (std::uint64_t i = 0; i < 200; ++i) {
      Draw first(7, law.name, i);
      Draw second(7, law.name, i);
      const Generated made = law.generate(first);
      EXPECT_EQ(made.source, law.generate(second).source) << law.name << i;
      const Result<Case> read = cases::parse_case(cases::to_json(made.source), "");
      ASSERT_TRUE(read.has_value()) << law.name << i << ": " << to_string(read.error());
      EXPECT_EQ(*read, made.source) << law.name << i;
      strata.insert(made.stratum);
    }
    EXPECT_GE(strata.size(), 3U) << law.name;
    EXPECT_FALSE(strata.contains("")) << law.name;
  }
}

/// Of a backend that gives derivatives, and goes wrong so.
Check check_derivatives(const Case& c, const Damage& damage) {
  DamagedBackend backend(damage, "cpu");
  return find_law(kDerivatives)->check(c, backend, {}).value();
}

// Of what the textbook method promises, and of what only `cpu` does.
TEST(Laws, HoldOfTheSquare) {
  int checked = 0;
  for (const Law& law : laws()) {
    DamagedBackend method;
    DamagedBackend cpu({}, "cpu");
    DamagedBackend& backend = is_promised(law, method) ? method : cpu;
    const Check check = law.check(kept_square(), backend, {}).value();
    EXPECT_EQ(check.violation_count, 0U) << law.name;
    EXPECT_TRUE(std::is_sorted(check.labels.begin(), check.labels.end())) << law.name;
    if (!check.is_applicable) continue;
    ++checked;
    EXPECT_GT(check.judgement.counts.required, 0U) << law.name;
  }
  EXPECT_GE(checked, 12);
}

TEST(Laws, SayNothingOfWhatIsNotPromised) {
  const auto method = backends::make_backend("method:rational-linear").value();
  std::vector<std::string_view> not_promised;
  for (const Law& law : laws()) {
    if (is_promised(law, *method)) continue;
    not_promised.push_back(law.name);
    for (std::uint64_t i = 0; i < 20; ++i) {
      Draw draw(1, law.name, i);
      const Case c = law.generate(draw).source;
      EXPECT_FALSE(law.check(c, *method, {i}).value().is_applicable) << law.name << i;
    }
  }
  EXPECT_THAT(not_promised, testing::IsSupersetOf({kPicture, kOverdraw, kDifferences, kDiscard,
                                                   kFiltered, kNormals, kDerivatives, kStrips,
                                                   kTexels, kTraced, kVertexStage, kVertexValues}));
}

TEST(Laws, PassOnWhatABackendCannotDraw) {
  class Refuses : public DamagedBackend {
   public:
    Refuses() : DamagedBackend({}, "cpu") {}
    Result<Framebuffer> draw(const Case& /*c*/) override {
      return tl::unexpected(Error{"", "", "no triangles today"});
    }
    Result<Framebuffer> draw_assembled(const Case& c, cases::Topology /*topology*/,
                                       std::span<const std::uint32_t> /*indices*/) override {
      return draw(c);
    }
    Result<cases::Picture> draw_picture(const Case& c,
                                        const cases::Pipeline& /*pipeline*/) override {
      return tl::unexpected(draw(c).error());
    }
    Result<std::vector<cases::ClipVertex>> transform(const Case& c) override {
      return tl::unexpected(draw(c).error());
    }
    Result<std::vector<cases::Normal>> transform_normals(
        const cases::Matrix4& /*model*/, std::span<const cases::Normal> /*normals*/) override {
      return tl::unexpected(draw({}).error());
    }
  };
  Case c = kept_square();
  c.camera.emplace();
  int asked = 0;
  for (const Law& law : laws()) {
    Refuses backend;
    if (!is_promised(law, backend)) continue;
    const Result<Check> check = law.check(c, backend, {});
    if (check && !check->is_applicable) continue;
    ASSERT_FALSE(check.has_value()) << law.name;
    EXPECT_EQ(check.error().reason, "no triangles today");
    ++asked;
  }
  EXPECT_GE(asked, 12);
}

/// The only violation that a law found.
records::Violation only(const Check& check) {
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 1U);
  return check.violations.empty() ? records::Violation{} : check.violations.front();
}

void expect_at(const records::Violation& violation, FragmentClass fragment_class,
               AttributeKind kind, std::uint32_t triangle, std::uint32_t x, std::uint32_t y) {
  EXPECT_EQ(violation.fragment_class, fragment_class);
  EXPECT_EQ(violation.kind, kind);
  EXPECT_EQ(violation.triangle, triangle);
  EXPECT_EQ(violation.x, x);
  EXPECT_EQ(violation.y, y);
  EXPECT_EQ(violation.sample, 0U);
}

TEST(CoverageObeysTheContract, FindsAMissingFragment) {
  const Check check =
      check_of(kCoverage, square(), [](const Case&, Framebuffer& drawn) { drop(drawn, 0, 1, 1); });
  expect_at(only(check), FragmentClass::missing, AttributeKind::coverage, 0, 1, 1);
  EXPECT_EQ(only(check).exact, "required: inside");
  EXPECT_EQ(only(check).actual, "not drawn");
}

TEST(CoverageObeysTheContract, FindsAnExtraFragment) {
  const Check check =
      check_of(kCoverage, square(), [](const Case&, Framebuffer& drawn) { add(drawn, 0, 6, 6); });
  expect_at(only(check), FragmentClass::extra, AttributeKind::coverage, 0, 6, 6);
  EXPECT_EQ(only(check).exact, "forbidden: outside");
  EXPECT_EQ(only(check).actual, "drawn");
}

TEST(CoverageObeysTheContract, FindsAFragmentDrawnTwice) {
  const Check check =
      check_of(kCoverage, square(), [](const Case&, Framebuffer& drawn) { add(drawn, 0, 1, 1); });
  expect_at(only(check), FragmentClass::extra, AttributeKind::coverage, 0, 1, 1);
  EXPECT_EQ(only(check).note, "drawn more than once");
}

TEST(CoverageObeysTheContract, FindsFragmentsOfNothing) {
  const Check check = check_of(kCoverage, square(), [](const Case&, Framebuffer& drawn) {
    add(drawn, 1, 8, 0);
    add(drawn, 2, 0, 0);
  });
  EXPECT_EQ(check.violation_count, 2U);
  for (const records::Violation& violation : check.violations) {
    EXPECT_EQ(violation.fragment_class, FragmentClass::extra);
    EXPECT_EQ(violation.exact, "forbidden: no such triangle, pixel or sample");
  }
}

// B, made nearer, hides A at pixel (1, 1) only if it is drawn there; here A is the nearer one and B
// takes its place.
TEST(CoverageObeysTheContract, FindsTheWrongTriangleUnderADepthTest) {
  Case c = square();
  c.depth_test = cases::DepthTest::less;
  c.positions.insert(c.positions.end(), {{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}});
  c.attribute_values.resize(c.positions.size() * 3);
  c.triangles = {{0, 1, 2}, {4, 5, 6}};
  EXPECT_EQ(check_of(kCoverage, c, {}).violation_count, 0U);
  const Check check = check_of(kCoverage, c, [](const Case&, Framebuffer& drawn) {
    drawn.triangle[find(drawn, 0, 1, 1)] = 1;
  });
  expect_at(only(check), FragmentClass::wrong_triangle, AttributeKind::coverage, 1, 1, 1);
}

TEST(CoverageObeysTheContract, LeavesValuesAlone) {
  const Check check = check_of(kCoverage, square(), [](const Case&, Framebuffer& drawn) {
    value(drawn, 0, 1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
  });
  EXPECT_EQ(check.violation_count, 0U);
}

// One ulp of a value of one is one scale ULP of an attribute that is one everywhere.
TEST(ValuesStayWithinTheBound, FindsOneUlp) {
  const Check check = check_of(kValues, square(), [](const Case&, Framebuffer& drawn) {
    value(drawn, 1, 6, 5, 1) = next_float(1);
  });
  expect_at(only(check), FragmentClass::beyond_bound, AttributeKind::smooth, 1, 6, 5);
  EXPECT_EQ(only(check).attribute, 1U);
  EXPECT_EQ(only(check).exact, "1");
  ASSERT_TRUE(only(check).error.has_value());
  EXPECT_TRUE(records::contains(*only(check).error, 1));
}

TEST(ValuesStayWithinTheBound, FindsWhatIsNoNumber) {
  const Check check = check_of(kValues, square(), [](const Case&, Framebuffer& drawn) {
    drawn.depth[find(drawn, 0, 1, 1)] = std::numeric_limits<float>::quiet_NaN();
    value(drawn, 0, 2, 1, 0) = -std::numeric_limits<float>::infinity();
  });
  ASSERT_EQ(check.violation_count, 2U);
  expect_at(check.violations[0], FragmentClass::not_a_number, AttributeKind::depth, 0, 1, 1);
  EXPECT_EQ(check.violations[0].attribute, std::nullopt);
  EXPECT_EQ(check.violations[0].actual, "nan");
  EXPECT_EQ(check.violations[0].exact, "1/4");
  expect_at(check.violations[1], FragmentClass::infinite, AttributeKind::smooth, 0, 2, 1);
  EXPECT_EQ(check.violations[1].actual, "-inf");
}

TEST(ValuesStayWithinTheBound, FindsTheOtherZero) {
  const Check check = check_of(
      kValues, square(), [](const Case&, Framebuffer& drawn) { value(drawn, 0, 1, 1, 2) = -0.0F; });
  expect_at(only(check), FragmentClass::wrong_sign_of_zero, AttributeKind::smooth, 0, 1, 1);
  EXPECT_EQ(only(check).attribute, 2U);
}

TEST(ValuesStayWithinTheBound, LeavesCoverageAlone) {
  const Check check = check_of(kValues, square(), [](const Case&, Framebuffer& drawn) {
    drop(drawn, 0, 1, 1);
    add(drawn, 0, 6, 6);
  });
  EXPECT_EQ(check.violation_count, 0U);
}

TEST(VertexOrder, FindsAValueThatDependsOnIt) {
  const Check check = check_of(kOrder, square(), [](const Case& c, Framebuffer& drawn) {
    if (c.triangles[0][0] == 1) value(drawn, 0, 2, 3, 1) = next_float(1);
  });
  expect_at(only(check), FragmentClass::beyond_bound, AttributeKind::smooth, 0, 2, 3);
  EXPECT_EQ(only(check).note, "drawn in the order second, third, first vertex");
}

TEST(VertexOrder, FindsCoverageThatDependsOnIt) {
  const Check check = check_of(kOrder, square(), [](const Case& c, Framebuffer& drawn) {
    if (c.triangles[0][0] == 2) drop(drawn, 0, 1, 1);
  });
  expect_at(only(check), FragmentClass::missing, AttributeKind::coverage, 0, 1, 1);
  EXPECT_EQ(only(check).note, "drawn in the order third, first, second vertex");
}

TEST(VertexOrder, LetsFlatAttributesFollowTheProvokingVertex) {
  Case c = square();
  c.attributes[0].interpolation = cases::Interpolation::flat;
  EXPECT_EQ(check_of(kOrder, c, {}).violation_count, 0U);
}

TEST(ConstantsStayConstant, FindsOneUlpAndTheOtherZero) {
  const Check check = check_of(kConstants, square(), [](const Case&, Framebuffer& drawn) {
    value(drawn, 0, 2, 3, 1) = next_float(1);
    value(drawn, 1, 6, 6, 2) = -0.0F;
  });
  ASSERT_EQ(check.violation_count, 2U);
  expect_at(check.violations[0], FragmentClass::beyond_bound, AttributeKind::smooth, 0, 2, 3);
  EXPECT_EQ(check.violations[0].attribute, 1U);
  EXPECT_EQ(check.violations[0].exact, "1");
  EXPECT_EQ(check.violations[0].error, (records::Enclosure{1, 1}));
  EXPECT_EQ(check.violations[0].note, "all three vertices have 1 (0x1p+0)");
  expect_at(check.violations[1], FragmentClass::wrong_sign_of_zero, AttributeKind::smooth, 1, 6, 6);
}

TEST(ConstantsStayConstant, JudgesNoOtherAttribute) {
  const Check check = check_of(
      kConstants, square(), [](const Case&, Framebuffer& drawn) { value(drawn, 0, 2, 3, 0) = 77; });
  EXPECT_EQ(check.violation_count, 0U);
}

// With a bound of 3/4 the neighbour below a power of two may be what rounding gives.
TEST(ConstantsStayConstant, JudgesWhatTheContractPromisesOnly) {
  DamagedBackend backend(
      [](const Case&, Framebuffer& drawn) { value(drawn, 0, 2, 3, 1) = next_float(1); });
  cases::Contract contract = backend.contract(square());
  const auto violations = [&](cases::ValueBound smooth) {
    contract.bounds.smooth = smooth;
    backend.promised = contract;
    return find_law(kConstants)->check(square(), backend, {}).value().violation_count;
  };
  EXPECT_EQ(violations({0.5F, 0}), 1U);
  EXPECT_EQ(violations({0x1.7ffffep-1F, 0}), 1U);
  EXPECT_EQ(violations({0.75F, 0}), 0U);
  EXPECT_EQ(violations({0.5F, 0.125F}), 1U);  // g = 1 where all w are the same
  EXPECT_EQ(violations({0.5F, 0.25F}), 0U);
}

// As of attributes in float32, whose bound is several ULP.
TEST(ConstantsStayConstant, JudgesWhatIsPromisedToBeKeptWhateverTheBound) {
  DamagedBackend backend([](const Case&, Framebuffer& drawn) {
    value(drawn, 0, 2, 3, 1) = next_float(1);
    value(drawn, 1, 6, 6, 2) = -0.0F;
  });
  cases::Contract contract = backend.contract(square());
  contract.bounds.smooth = {6.84F, 0};
  const auto violations = [&](bool keeps_constants) {
    contract.keeps_constants = keeps_constants;
    backend.promised = contract;
    return find_law(kConstants)->check(square(), backend, {}).value().violation_count;
  };
  EXPECT_EQ(violations(false), 0U);
  EXPECT_EQ(violations(true), 2U);
}

TEST(ConstantsStayConstant, SaysNothingOfACaseWithoutConstants) {
  Case c = square();
  c.attributes.resize(1);
  c.attribute_values = {0, 8, 0, 8};
  EXPECT_FALSE(check_of(kConstants, c, {}).is_applicable);
}

/// ∂/∂u or ∂/∂v of an attribute.
float& derivative(Framebuffer& drawn, std::uint32_t triangle, int x, int y, std::size_t attribute,
                  std::size_t axis) {
  const std::size_t first = find(drawn, triangle, x, y) * drawn.attribute_count;
  return drawn.derivatives[(first + attribute) * 2 + axis];
}

// Attribute 0 is u: its derivatives are 1 and 0, and the unit of both is ulp(8/8 + 8/8) = 2^-22.
TEST(ScreenDerivatives, FindsOneUnitAlongEitherAxis) {
  const Check check = check_derivatives(square(), [](const Case&, Framebuffer& drawn) {
    derivative(drawn, 0, 2, 3, 0, 0) = 1 + 0x1p-22F;
    derivative(drawn, 0, 3, 3, 0, 0) = 1 + 0x1p-23F;  // half a unit
    derivative(drawn, 1, 6, 6, 0, 1) = -0x1p-22F;
  });
  ASSERT_EQ(check.violation_count, 2U);
  expect_at(check.violations[0], FragmentClass::beyond_bound, AttributeKind::smooth, 0, 2, 3);
  EXPECT_EQ(check.violations[0].attribute, 0U);
  EXPECT_EQ(check.violations[0].exact, "1");
  EXPECT_TRUE(records::contains(check.violations[0].error.value(), 1));
  EXPECT_EQ(check.violations[0].note, "the derivative along window x");
  expect_at(check.violations[1], FragmentClass::beyond_bound, AttributeKind::smooth, 1, 6, 6);
  EXPECT_EQ(check.violations[1].exact, "0");
  EXPECT_TRUE(records::contains(check.violations[1].error.value(), -1));
  EXPECT_EQ(check.violations[1].note, "the derivative along window y");
}

TEST(ScreenDerivatives, FindsWhatIsNoNumber) {
  const Check check = check_derivatives(square(), [](const Case&, Framebuffer& drawn) {
    derivative(drawn, 0, 1, 1, 0, 0) = std::numeric_limits<float>::quiet_NaN();
    derivative(drawn, 0, 1, 1, 2, 1) = std::numeric_limits<float>::infinity();
  });
  ASSERT_EQ(check.violation_count, 2U);
  expect_at(check.violations[0], FragmentClass::not_a_number, AttributeKind::smooth, 0, 1, 1);
  EXPECT_EQ(check.violations[0].actual, "nan");
  expect_at(check.violations[1], FragmentClass::infinite, AttributeKind::smooth, 0, 1, 1);
}

TEST(ScreenDerivatives, FindsSlopesOfFlatAttributes) {
  Case c = square();
  c.attributes[0].interpolation = cases::Interpolation::flat;
  EXPECT_EQ(check_derivatives(c, {}).violation_count, 0U);
  const Check check = check_derivatives(
      c, [](const Case&, Framebuffer& drawn) { derivative(drawn, 0, 1, 1, 0, 0) = 0x1p-149F; });
  expect_at(only(check), FragmentClass::beyond_bound, AttributeKind::flat, 0, 1, 1);
}

// Under OpenGL and Vulkan a centroid may be anywhere in the triangle's part of a pixel.
TEST(ScreenDerivatives, JudgesNoCentroidWhosePlaceIsOpen) {
  const auto violations = [](cases::Rules rules, int samples) {
    Case c = square();
    c.rules = rules;
    c.framebuffer.samples = samples;
    c.attributes[0].location = cases::Location::centroid;
    const auto damage = [](const Case&, Framebuffer& drawn) { drawn.derivatives[0] = 7; };
    return check_derivatives(c, damage).violation_count;
  };
  EXPECT_EQ(violations(cases::Rules::vulkan, 1), 1U);
  EXPECT_EQ(violations(cases::Rules::vulkan, 4), 0U);
  EXPECT_EQ(violations(cases::Rules::d3d, 4), 1U);
}

TEST(ScreenDerivatives, SaysNothingWhereNoneArePromisedOrGiven) {
  EXPECT_FALSE(check_of(kDerivatives, square(), {}).is_applicable);
  EXPECT_FALSE(check_derivatives(square(), [](const Case&, Framebuffer& drawn) {
                 drawn.derivatives.clear();
               }).is_applicable);
  DamagedBackend backend({}, "cpu");
  cases::Contract contract = backend.contract(square());
  contract.derivative_bound.reset();
  backend.promised = contract;
  EXPECT_FALSE(find_law(kDerivatives)->check(square(), backend, {}).value().is_applicable);
  Case c = square();
  c.attributes.clear();
  c.attribute_values.clear();
  EXPECT_FALSE(check_derivatives(c, {}).is_applicable);
}

// (3, 4) lies on the diagonal and is drawn by triangle 1.
TEST(SharedEdge, FindsASampleDrawnByNeither) {
  const Check check = check_of(kSharedEdge, square(),
                               [](const Case&, Framebuffer& drawn) { drop(drawn, 1, 3, 4); });
  expect_at(only(check), FragmentClass::missing, AttributeKind::coverage, 0, 3, 4);
  EXPECT_THAT(only(check).note, HasSubstr("neither triangle 0 nor 1 draws it"));
  EXPECT_THAT(only(check).note, HasSubstr("vertices 2 and 1"));
}

TEST(SharedEdge, FindsASampleDrawnByBoth) {
  const Check check =
      check_of(kSharedEdge, square(), [](const Case&, Framebuffer& drawn) { add(drawn, 0, 3, 4); });
  expect_at(only(check), FragmentClass::extra, AttributeKind::coverage, 1, 3, 4);
  EXPECT_THAT(only(check).note, HasSubstr("triangle 0 draws it as well"));
}

// Which of the two has it is the backend's business, under a contract without a tie rule.
TEST(SharedEdge, LetsTheOtherTriangleHaveIt) {
  const Check check = check_of(kSharedEdge, square(), [](const Case&, Framebuffer& drawn) {
    drop(drawn, 1, 3, 4);
    add(drawn, 0, 3, 4);
  });
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 56U);  // all but those on the other diagonal
}

TEST(SharedEdge, JudgesTrianglesAloneUnderADepthTest) {
  Case c = square();
  c.depth_test = cases::DepthTest::less;
  c.positions.insert(c.positions.end(), {{-3, -3, 0, 1}, {3, -3, 0, 1}, {-3, 3, 0, 1}});
  c.attribute_values.resize(c.positions.size() * 3);
  c.triangles.push_back({4, 5, 6});
  EXPECT_EQ(check_of(kSharedEdge, c, {}).violation_count, 0U);
}

TEST(SharedEdge, SaysNothingOfPairsThatItsPromiseLeavesOut) {
  const auto is_applicable = [](const Case& c) {
    return check_of(kSharedEdge, c, {}).is_applicable;
  };
  EXPECT_TRUE(is_applicable(square()));
  Case alone = square();
  alone.triangles.pop_back();
  EXPECT_FALSE(is_applicable(alone));
  Case same_direction = square();
  same_direction.triangles[1] = {1, 2, 3};
  EXPECT_FALSE(is_applicable(same_direction));
  Case folded = square();
  folded.positions[3] = {-0.75F, -0.5F, 0.25F, 1};
  EXPECT_FALSE(is_applicable(folded));
  Case concave = square();  // vertex 1 drawn in beyond the other diagonal
  concave.positions[1] = {-0.9F, 0.8F, 0.25F, 1};
  EXPECT_FALSE(is_applicable(concave));
  Case clipped = square();
  clipped.positions[0].z = -0.25F;
  EXPECT_FALSE(is_applicable(clipped));
  Case behind = square();
  behind.positions[0].w = -1;
  EXPECT_FALSE(is_applicable(behind));
  Case cut = square();
  cut.clip_distance_count = 1;
  cut.clip_distances = {1, 1, 0, 1};
  EXPECT_FALSE(is_applicable(cut));
  cut.clip_distances = {1, 1, 0.5F, 1};
  EXPECT_TRUE(is_applicable(cut));
}

TEST(SharedEdge, MeetsTiesWithDifferentWeightsAndSamples) {
  std::set<std::string> labels;
  std::set<std::string> strata;
  const auto backend = backends::make_backend("method:rational-linear").value();
  for (std::uint64_t i = 0; i < 100; ++i) {
    Draw draw(1, kSharedEdge, i);
    const Generated made = find_law(kSharedEdge)->generate(draw);
    const Check check = find_law(kSharedEdge)->check(made.source, *backend, {i}).value();
    labels.insert(check.labels.begin(), check.labels.end());
    if (check.judgement.counts.required > 0) strata.insert(made.stratum);
  }
  EXPECT_THAT(labels, testing::IsSupersetOf({"different w", "permitted", "several samples"}));
  EXPECT_THAT(strata, testing::ElementsAre("fans off grid", "fans on grid", "meshes off grid",
                                           "meshes on grid", "quads through samples"));
}

}  // namespace
}  // namespace rastercheck::properties
