#include "backends/plugin/library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "cases/case.h"

namespace rastercheck::backends::library_test {
namespace {

cases::Case plain_case() {
  cases::Case c;
  c.framebuffer = {8, 4, 1};
  c.viewport.width = 8;
  c.viewport.height = 4;
  c.positions = {{0, 0, 0, 1}, {1, 0, 1, 1}, {0, 1, 0.5F, 1}, {0, 0, 9, -1}};
  c.triangles = {{0, 1, 2}};
  return c;
}

TEST(PluginContract, OfZerosIsWhatACaseAsksForCorrectlyRounded) {
  const rastercheck_contract zeros{};
  cases::Case c = plain_case();
  cases::Contract asked_for = cases::contract_of(c);
  asked_for.clip_tolerance = 0;
  asked_for.keeps_sign_of_zero = false;
  EXPECT_EQ(contract_of(zeros, c), asked_for);
  c.coverage = cases::Snapping{4, cases::Rounding::half_up, 0};
  c.basis = cases::Basis::snapped;
  c.fill_rule = cases::TieRule::bottom_left;
  asked_for = cases::contract_of(c);
  asked_for.clip_tolerance = 0;
  asked_for.keeps_sign_of_zero = false;
  EXPECT_EQ(contract_of(zeros, c), asked_for);
}

TEST(PluginContract, SaysWhatOtherRasterizersDo) {
  rastercheck_contract contract{};
  contract.coverage = RASTERCHECK_COVERAGE_SNAPPED;
  contract.steps_per_pixel = 12;
  contract.rounding = RASTERCHECK_ROUNDING_FLOOR;
  contract.rounding_of_y = RASTERCHECK_ROUNDING_TOWARD_ZERO + 1;
  contract.clips = RASTERCHECK_CLIPS_BEYOND_VIEWPORT;
  contract.beyond = RASTERCHECK_BEYOND_LEFT_OUT;
  contract.clip_error = 0.25F;
  contract.least_number = 0x1p-60F;
  contract.greatest_number = 0x1p60F;
  contract.culls = RASTERCHECK_CULLS_COUNTER_CLOCKWISE;
  contract.least_area = 2;
  contract.sample_x = 7;
  contract.sample_y = 5;
  contract.sample_parts = 12;
  contract.smooth_absolute = 1;
  contract.noperspective_absolute = 2;
  contract.depth_absolute = 3;
  contract.depth_function = RASTERCHECK_DEPTH_FUNCTION_GREATER;
  contract.depth_error = RASTERCHECK_DEPTH_NEVER_FARTHER;
  const cases::Contract promised = contract_of(contract, plain_case());
  cases::Snapping grid = cases::with_steps({8, cases::Rounding::floor, 0}, 12);
  grid.rounding_of_y = cases::Rounding::toward_zero;
  EXPECT_EQ(promised.coverage, cases::Coverage(grid));
  EXPECT_EQ(promised.guard_beyond_viewport, 0.0F);
  EXPECT_TRUE(promised.culls_instead_of_clipping);
  EXPECT_EQ(promised.clip_error, 0.25);
  EXPECT_EQ(promised.numbers, (cases::MagnitudeRange{0x1p-60F, 0x1p60F}));
  EXPECT_EQ(promised.culls, cases::Winding::counter_clockwise);
  EXPECT_EQ(promised.least_area, 2.0F);
  EXPECT_EQ(promised.sample_position, (cases::PixelFraction{7, 5, 12}));
  EXPECT_EQ(promised.bounds.smooth, (cases::ValueBound{0.5F, 0, 0, 0, 1}));
  EXPECT_EQ(promised.bounds.noperspective.absolute, 2.0F);
  EXPECT_EQ(promised.bounds.depth.absolute, 3.0F);
  EXPECT_EQ(promised.depth_function, cases::KeptDepth::greater);
  EXPECT_EQ(promised.depth_error, cases::DepthError::never_farther);
  contract.guard_band = 64;
  EXPECT_EQ(contract_of(contract, plain_case()).guard_beyond_viewport, 64.0F);
}

TEST(PluginContract, SaysHowDepthsAreBiasedAndStored) {
  using cases::BiasSlope;
  using cases::BiasUnit;
  using cases::DepthStore;
  const auto promised_by = [](auto change) {
    rastercheck_contract contract{};
    change(contract);
    return contract_of(contract, plain_case());
  };
  const auto store = [&](std::uint32_t value) {
    return promised_by([value](auto& c) { c.depth_store = value; }).depth_store;
  };
  EXPECT_EQ(store(RASTERCHECK_STORE_NEAREST), DepthStore::nearest);
  EXPECT_EQ(store(RASTERCHECK_STORE_NEARLY_NEAREST), DepthStore::nearly_nearest);
  EXPECT_EQ(store(RASTERCHECK_STORE_EITHER), DepthStore::either);
  const auto slope = [&](std::uint32_t value) {
    return promised_by([value](auto& c) { c.bias_slope = value; }).depth_bias.slope;
  };
  EXPECT_EQ(slope(RASTERCHECK_SLOPE_GREATEST), BiasSlope::greatest);
  EXPECT_EQ(slope(RASTERCHECK_SLOPE_ROOT), BiasSlope::root);
  EXPECT_EQ(slope(RASTERCHECK_SLOPE_BETWEEN), BiasSlope::between);
  const auto unit = [&](std::uint32_t value) {
    return promised_by([value](auto& c) { c.bias_unit = value; }).depth_bias.unit;
  };
  EXPECT_EQ(unit(RASTERCHECK_UNIT_POWER), BiasUnit::power);
  EXPECT_EQ(unit(RASTERCHECK_UNIT_DOUBLE_POWER), BiasUnit::double_power);
  EXPECT_EQ(unit(RASTERCHECK_UNIT_EITHER_POWER), BiasUnit::either_power);
  EXPECT_EQ(unit(RASTERCHECK_UNIT_LEAST_VALUE), BiasUnit::least_value);
  EXPECT_EQ(unit(RASTERCHECK_UNIT_OPEN), BiasUnit::open);
  const auto exponent = [&](std::uint32_t value) {
    return promised_by([value](auto& c) { c.bias_exponent = value; }).depth_bias.exponent;
  };
  EXPECT_EQ(exponent(RASTERCHECK_EXPONENT_OF_VERTICES), cases::BiasExponent::vertices);
  EXPECT_EQ(exponent(RASTERCHECK_EXPONENT_OPEN), cases::BiasExponent::open);
}

TEST(PluginContract, TakesTheUnitFromTheRulesUnlessItSaysOne) {
  rastercheck_contract contract{};
  cases::Case c = plain_case();
  EXPECT_EQ(contract_of(contract, c).depth_bias.unit, cases::BiasUnit::power);
  c.rules = cases::Rules::d3d;
  EXPECT_EQ(contract_of(contract, c).depth_bias.unit, cases::BiasUnit::least_value);
  contract.bias_unit = RASTERCHECK_UNIT_POWER;
  EXPECT_EQ(contract_of(contract, c).depth_bias.unit, cases::BiasUnit::power);
}

// A case's unorm format is that of what is compared; the contract's is for the other cases.
TEST(PluginContract, ComparesWhatACaseStores) {
  rastercheck_contract contract{};
  contract.depth_format = RASTERCHECK_DEPTH_UNORM24;
  cases::Case c = plain_case();
  EXPECT_EQ(contract_of(contract, c).depth_format, cases::DepthFormat::unorm24);
  c.depth_format = cases::DepthFormat::unorm16;
  EXPECT_EQ(contract_of(contract, c).depth_format, cases::DepthFormat::unorm16);
}

// Kills: a table of enumerators in another order than the header's.
TEST(PluginContract, NamesEveryRoundingAndTieRule) {
  using cases::Rounding;
  using cases::TieRule;
  const auto promised = [](std::uint32_t rounding, std::uint32_t tie_rule) {
    rastercheck_contract contract{};
    contract.coverage = RASTERCHECK_COVERAGE_SNAPPED;
    contract.rounding = rounding;
    contract.tie_rule = tie_rule;
    return contract_of(contract, plain_case());
  };
  const std::array<std::pair<std::uint32_t, Rounding>, 7> roundings{
      {{RASTERCHECK_ROUNDING_NEAREST_EVEN, Rounding::nearest_even},
       {RASTERCHECK_ROUNDING_HALF_UP, Rounding::half_up},
       {RASTERCHECK_ROUNDING_UNSPECIFIED, Rounding::unspecified},
       {RASTERCHECK_ROUNDING_HALF_DOWN, Rounding::half_down},
       {RASTERCHECK_ROUNDING_FLOOR, Rounding::floor},
       {RASTERCHECK_ROUNDING_CEIL, Rounding::ceil},
       {RASTERCHECK_ROUNDING_TOWARD_ZERO, Rounding::toward_zero}}};
  for (const auto& [number, rounding] : roundings) {
    EXPECT_EQ(promised(number, 0).coverage->rounding, rounding);
  }
  const std::array<std::pair<std::uint32_t, TieRule>, 11> rules{
      {{RASTERCHECK_TIE_RULE_TOP_LEFT, TieRule::top_left},
       {RASTERCHECK_TIE_RULE_BOTTOM_LEFT, TieRule::bottom_left},
       {RASTERCHECK_TIE_RULE_UNSPECIFIED, TieRule::unspecified},
       {RASTERCHECK_TIE_RULE_TOP_RIGHT, TieRule::top_right},
       {RASTERCHECK_TIE_RULE_BOTTOM_RIGHT, TieRule::bottom_right},
       {RASTERCHECK_TIE_RULE_TOP_THEN_LEFT, TieRule::top_then_left},
       {RASTERCHECK_TIE_RULE_TOP_THEN_RIGHT, TieRule::top_then_right},
       {RASTERCHECK_TIE_RULE_BOTTOM_THEN_LEFT, TieRule::bottom_then_left},
       {RASTERCHECK_TIE_RULE_BOTTOM_THEN_RIGHT, TieRule::bottom_then_right},
       {RASTERCHECK_TIE_RULE_ALL, TieRule::all},
       {RASTERCHECK_TIE_RULE_NONE, TieRule::none}}};
  for (const auto& [number, rule] : rules) EXPECT_EQ(promised(0, number).tie_rule, rule);
}

TEST(PluginContract, MayCoverWholePixels) {
  rastercheck_contract contract{};
  EXPECT_FALSE(contract_of(contract, plain_case()).conservative);
  contract.conservative = RASTERCHECK_CONSERVATIVE_OUTER;
  contract.conservative_error = 0.25F;
  contract.conservative_growth = 0.5F;
  contract.shifts_edges = 1;
  contract.covers_degenerates = 1;
  EXPECT_EQ(contract_of(contract, plain_case()).conservative,
            (cases::Conservative{cases::ConservativeKind::outer, 0.25F, 0.5F,
                                 cases::ConservativeCorners::edges, true}));
  contract = {};
  contract.conservative = RASTERCHECK_CONSERVATIVE_INNER;
  EXPECT_EQ(contract_of(contract, plain_case()).conservative,
            (cases::Conservative{cases::ConservativeKind::inner}));
}

TEST(PluginContract, NeedNotPromiseDepth) {
  rastercheck_contract contract{};
  contract.lacks = RASTERCHECK_LACKS_DEPTH;
  EXPECT_GE(contract_of(contract, plain_case()).bounds.depth.constant, 0x1p24F);
}

TEST(PluginContract, SaysWhatItSays) {
  rastercheck_contract contract{};
  contract.coverage = RASTERCHECK_COVERAGE_SNAPPED;
  contract.subpixel_bits = 6;
  contract.rounding = RASTERCHECK_ROUNDING_UNSPECIFIED;
  contract.position_error = 0.125F;
  contract.clip_tolerance = 2;
  contract.guard_band = 1000;
  contract.tie_rule = RASTERCHECK_TIE_RULE_UNSPECIFIED;
  contract.basis = RASTERCHECK_BASIS_UNSPECIFIED;
  contract.claims = RASTERCHECK_CLAIM_AFFINE;
  contract.keeps =
      RASTERCHECK_KEEPS_CONSTANTS | RASTERCHECK_KEEPS_EQUAL_DEPTH | RASTERCHECK_KEEPS_SIGN_OF_ZERO;
  contract.depth_format = RASTERCHECK_DEPTH_UNORM24;
  contract.smooth = {1, 2, 3, 4};
  contract.depth.constant = 5;

  cases::Contract expected;
  expected.coverage = cases::Snapping{6, cases::Rounding::unspecified, 0.125F};
  expected.clip_tolerance = 2;
  expected.guard_band = 1000;
  expected.tie_rule = cases::TieRule::unspecified;
  expected.basis = cases::Basis::unspecified;
  expected.claims = cases::Claim::affine;
  expected.keeps_constants = true;
  expected.keeps_equal_depth = true;
  expected.depth_format = cases::DepthFormat::unorm24;
  expected.bounds.smooth = {1, 2, 3, 4};
  expected.bounds.depth.constant = 5;
  EXPECT_EQ(contract_of(contract, plain_case()), expected);

  // Values of the exact triangle cannot come from other positions.
  contract.coverage = RASTERCHECK_COVERAGE_EXACT;
  expected.coverage = std::nullopt;
  expected.basis = cases::Basis::ideal;
  EXPECT_EQ(contract_of(contract, plain_case()), expected);
}

/// Makes a plain case with one change, and returns what a contract with this bit of `lacks` says
/// about it.
template <typename Change>
std::string lacking(std::uint32_t bit, const Change& change) {
  rastercheck_contract contract{};
  contract.lacks = bit;
  cases::Case c = plain_case();
  EXPECT_EQ(lacks(contract, c), "");
  change(c);
  EXPECT_EQ(lacks({}, c), "");
  return lacks(contract, c);
}

// Kills: a plugin that was compiled again with a newer header, and asked for what it does not know.
TEST(PluginContract, DrawsBiasAndUnormDepthOnlyIfItSaysSo) {
  cases::Case biased = plain_case();
  biased.depth_bias.slope = -1;
  cases::Case stored = plain_case();
  stored.depth_format = cases::DepthFormat::unorm16;
  rastercheck_contract contract{};
  EXPECT_EQ(lacks(contract, biased), "depth bias");
  EXPECT_EQ(lacks(contract, stored), "depths stored in a unorm format");
  contract.draws = RASTERCHECK_DRAWS_DEPTH_BIAS;
  EXPECT_EQ(lacks(contract, biased), "");
  EXPECT_EQ(lacks(contract, stored), "depths stored in a unorm format");
  contract.draws |= RASTERCHECK_DRAWS_UNORM_DEPTH;
  EXPECT_EQ(lacks(contract, stored), "");
}

TEST(PluginContract, LacksWhatItSaysAndNothingElse) {
  using cases::Case;
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_D3D, [](Case& c) { c.rules = cases::Rules::d3d; }),
            "D3D's rules");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_OPENGL, [](Case& c) { c.rules = cases::Rules::opengl; }),
            "OpenGL's rules");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_NONPOSITIVE_W, [](Case& c) { c.triangles[0][1] = 3; }),
            "vertices with w <= 0");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_DEPTH_CLIPPING, [](Case& c) { c.positions[0].z = -0.5F; }),
            "clipping by depth");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_CLIP_DISTANCES, [](Case& c) { c.clip_distance_count = 1; }),
            "clip distances");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_DEPTH_CLAMP, [](Case& c) { c.depth_clamp = true; }),
            "depth clamp");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_DEPTH_RANGE, [](Case& c) { c.viewport.max_depth = 0.5F; }),
            "depth ranges other than 0 to 1");
  EXPECT_EQ(
      lacking(RASTERCHECK_LACKS_DEPTH_TEST, [](Case& c) { c.depth_test = cases::DepthTest::less; }),
      "the depth test");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_DEPTH_CLEAR,
                    [](Case& c) {
                      c.depth_test = cases::DepthTest::less;
                      c.depth_clear = 0.5F;
                    }),
            "depth buffers cleared to values other than 1");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_SIDE_CLIPPING, [](Case& c) { c.positions[1].x = 1.5F; }),
            "vertices beyond the viewport's sides");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_VIEWPORT, [](Case& c) { c.viewport.height = -4; }),
            "viewports other than the whole framebuffer");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_SCISSOR, [](Case& c) { c.scissor = cases::Scissor(); }),
            "scissors");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_CULLING, [](Case& c) { c.cull = cases::Cull::back; }),
            "culling");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_SMOOTH, [](Case& c) { c.attributes.resize(1); }),
            "smooth attributes");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_NOPERSPECTIVE,
                    [](Case& c) {
                      c.attributes = {{"", cases::Interpolation::noperspective, {}}};
                    }),
            "noperspective attributes");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_FLAT,
                    [](Case& c) {
                      c.attributes = {{"", cases::Interpolation::flat, {}}};
                    }),
            "flat attributes");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_CENTER,
                    [](Case& c) {
                      c.framebuffer.samples = 2;
                      c.attributes = {{"", {}, cases::Location::center}};
                    }),
            "attributes at centres of several samples");
  EXPECT_EQ(lacking(RASTERCHECK_LACKS_CENTROID,
                    [](Case& c) {
                      c.framebuffer.samples = 2;
                      c.attributes = {{"", {}, cases::Location::centroid}};
                    }),
            "attributes at centroids of several samples");
}

// Kills: a limit that excludes too much. With one sample, the centre is that sample; depth is not
// clipped if it is clamped; and a vertex that belongs to no triangle does not count.
TEST(PluginContract, IgnoresMissingFeaturesThatTheCaseDoesNotNeed) {
  rastercheck_contract contract{};
  contract.lacks = RASTERCHECK_LACKS_CENTER | RASTERCHECK_LACKS_CENTROID |
                   RASTERCHECK_LACKS_DEPTH_CLIPPING | RASTERCHECK_LACKS_NONPOSITIVE_W;
  cases::Case c = plain_case();
  c.attributes = {{"", {}, cases::Location::center}, {"", {}, cases::Location::centroid}};
  c.depth_clamp = true;
  c.positions[0].z = 5;
  EXPECT_EQ(lacks(contract, c), "");
  // OpenGL's clip space extends further down.
  c.depth_clamp = false;
  c.rules = cases::Rules::opengl;
  c.positions[0].z = -1;
  EXPECT_EQ(lacks(contract, c), "");
  c.positions[0].z = -1.5F;
  EXPECT_NE(lacks(contract, c), "");
}

TEST(PluginContract, HasLimitsOfNumber) {
  rastercheck_contract contract{};
  contract.sample_counts = 1 | 4;
  contract.max_size = 8;
  contract.max_attributes = 1;
  cases::Case c = plain_case();
  EXPECT_EQ(lacks(contract, c), "");
  c.framebuffer.samples = 2;
  EXPECT_EQ(lacks(contract, c), "2 samples");
  c.framebuffer = {8, 9, 4};
  EXPECT_EQ(lacks(contract, c), "framebuffers of 9 pixels");
  c.framebuffer = {8, 8, 4};
  c.attributes.resize(2);
  EXPECT_EQ(lacks(contract, c), "2 attributes");
}

TEST(Plugin, IsDescribedInALine) {
  Plugin plugin{"mine", "2.5", {}, nullptr};
  EXPECT_EQ(describe(plugin),
            "mine 2.5: coverage as each case asks, smooth values within 0.5 scale ULP");
  plugin.contract.coverage = RASTERCHECK_COVERAGE_SNAPPED;
  plugin.contract.subpixel_bits = 8;
  plugin.contract.smooth.per_condition = 1;
  plugin.contract.lacks = RASTERCHECK_LACKS_FLAT | RASTERCHECK_LACKS_CULLING;
  EXPECT_EQ(describe(plugin),
            "mine 2.5: coverage snapped to 8 subpixel bits, smooth values within 0.5 and more "
            "scale ULP; not supported: culling, flat attributes");
  plugin.contract.draws = RASTERCHECK_DRAWS_DEPTH_BIAS;
  EXPECT_EQ(describe(plugin),
            "mine 2.5: coverage snapped to 8 subpixel bits, smooth values within 0.5 and more "
            "scale ULP, depth bias; not supported: culling, flat attributes");
}

uint32_t draw_nothing(const rastercheck_draw* /*draw*/, rastercheck_output* /*output*/) {
  return RASTERCHECK_OK;
}

/// A plugin, its contract, and the members that a later version of the interface might add to each.
struct Structs {
  rastercheck_contract contract{};
  std::uint64_t more_of_the_contract = ~std::uint64_t{0};
  rastercheck_plugin plugin{};
  std::uint64_t more_of_the_plugin = ~std::uint64_t{0};

  Structs() {
    contract.size = sizeof contract;
    contract.max_attributes = 7;
    plugin.size = sizeof plugin;
    plugin.abi = RASTERCHECK_PLUGIN_ABI;
    plugin.name = "mine";
    plugin.version = "1";
    plugin.contract = &contract;
    plugin.draw = &draw_nothing;
  }
  Structs(const Structs&) = delete;
  Structs& operator=(const Structs&) = delete;

  std::string problem() const {
    const auto checked = checked_plugin(&plugin, "x.so");
    return checked ? "" : to_string(checked.error());
  }
};

// Kills: refusing plugins of another version of the same ABI; reading beyond the plugin's members.
TEST(Plugin, MayHaveMoreMembersButNotFewer) {
  Structs structs;
  EXPECT_EQ(structs.problem(), "");
  structs.plugin.size += 8;
  structs.contract.size += 8;
  const auto checked = checked_plugin(&structs.plugin, "x.so");
  ASSERT_TRUE(checked) << to_string(checked.error());
  EXPECT_EQ(checked->contract.max_attributes, 7U);
  structs.plugin.size = offsetof(rastercheck_plugin, query) - 8;
  EXPECT_EQ(structs.problem(),
            "plugin:x.so: the first member of its rastercheck_plugin, `size`, is not "
            "sizeof(rastercheck_plugin)");
  structs.plugin.size = 0;
  EXPECT_NE(structs.problem(), "");
  structs.plugin.size = sizeof(rastercheck_plugin);
  structs.contract.size = 8;
  EXPECT_EQ(
      structs.problem(),
      "plugin:x.so: the first member of its contract, `size`, is not sizeof(rastercheck_contract)");
}

// Kills: members of a draw that a plugin was compiled without, taken for read by it.
TEST(Plugin, LacksWhatCameAfterItWasCompiled) {
  const auto lacks_at = [](std::size_t size) {
    Structs structs;
    structs.contract.size = static_cast<std::uint32_t>(size);
    const auto checked = checked_plugin(&structs.plugin, "x.so");
    EXPECT_TRUE(checked);
    return checked ? checked->contract.lacks : 0;
  };
  EXPECT_EQ(lacks_at(sizeof(rastercheck_contract)), 0U);
  EXPECT_EQ(lacks_at(offsetof(rastercheck_contract, depth_format)), RASTERCHECK_LACKS_DEPTH_CLEAR);
}

// Each message names the two members.
TEST(Plugin, IsRefusedIfItsContractContradictsItself) {
  const auto problem_of = [](auto change) {
    Structs structs;
    change(structs.contract);
    const std::string problem = structs.problem();
    const std::string head = "plugin:x.so: in its contract, ";
    EXPECT_EQ(problem.substr(0, head.size()), head);
    return problem.substr(std::min(head.size(), problem.size()));
  };
  EXPECT_EQ(problem_of([](rastercheck_contract& c) { c.subpixel_bits = c.steps_per_pixel = 4; }),
            "steps_per_pixel contradicts subpixel_bits (one of them must be 0)");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) {
              c.rounding_of_y = RASTERCHECK_ROUNDING_UNSPECIFIED + 1;
            }),
            "rounding_of_y contradicts rounding (both must be unspecified, or neither)");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) {
              c.coverage = RASTERCHECK_COVERAGE_EXACT;
              c.basis = RASTERCHECK_BASIS_SNAPPED;
            }),
            "basis SNAPPED contradicts coverage EXACT, which has no snapped positions");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) {
              c.least_number = 2;
              c.greatest_number = 1;
            }),
            "least_number contradicts greatest_number, which is less");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) {
              c.sample_x = c.sample_parts = 3;
              c.sample_counts = 1;
            }),
            "sample_x or sample_y contradicts sample_parts, which must be greater");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) { c.sample_parts = 2; }),
            "sample_parts contradicts sample_counts, which must be 1 with it");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) {
              c.lacks = RASTERCHECK_LACKS_DEPTH;
              c.keeps = RASTERCHECK_KEEPS_EQUAL_DEPTH;
            }),
            "keeps EQUAL_DEPTH contradicts lacks DEPTH");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) {
              c.lacks = RASTERCHECK_LACKS_DEPTH;
              c.depth_error = RASTERCHECK_DEPTH_NEVER_NEARER;
            }),
            "depth_error contradicts lacks DEPTH");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) {
              c.conservative = RASTERCHECK_CONSERVATIVE_INNER;
              c.conservative_growth = 1;
            }),
            "conservative_growth contradicts conservative, which must be OUTER with it");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) { c.shifts_edges = 1; }),
            "shifts_edges contradicts conservative, which must be OUTER with it");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) { c.covers_degenerates = 1; }),
            "covers_degenerates contradicts conservative, which must be OUTER with it");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) { c.conservative_error = 1; }),
            "conservative_error contradicts conservative, which must be OUTER or INNER with it");
  EXPECT_EQ(problem_of([](rastercheck_contract& c) {
              c.max_size = 4;
              c.size_multiple = 8;
            }),
            "size_multiple contradicts max_size, which is less");
}

uint32_t answer_nothing(const rastercheck_query* /*query*/, rastercheck_answer* /*answer*/) {
  return RASTERCHECK_OK;
}

// Kills: a pointer read beyond the struct of a plugin from before there were queries.
TEST(Plugin, AnswersQueriesIfItSaysHow) {
  Structs structs;
  EXPECT_EQ(checked_plugin(&structs.plugin, "x.so").value().query, nullptr);
  structs.plugin.query = &answer_nothing;
  EXPECT_EQ(checked_plugin(&structs.plugin, "x.so").value().query, &answer_nothing);
  structs.plugin.size = offsetof(rastercheck_plugin, query);
  EXPECT_EQ(checked_plugin(&structs.plugin, "x.so").value().query, nullptr);
}

TEST(Plugin, SaysWhatCanBeSaid) {
  const auto problem_of = [](auto change) {
    Structs structs;
    change(structs);
    return structs.problem();
  };
  EXPECT_EQ(problem_of([](Structs& s) { s.plugin.abi = 2; }),
            "plugin:x.so: it was compiled for plugin ABI 2, but this RasterCheck has ABI 1; "
            "compile it with this version's rastercheck/plugin.h");
  const std::string null =
      "plugin:x.so: the name, version, contract or draw of its rastercheck_plugin is a null "
      "pointer";
  EXPECT_EQ(problem_of([](Structs& s) { s.plugin.name = nullptr; }), null);
  EXPECT_EQ(problem_of([](Structs& s) { s.plugin.draw = nullptr; }), null);
  const std::string contract = "plugin:x.so: its contract's ";
  EXPECT_EQ(problem_of([](Structs& s) { s.contract.subpixel_bits = 17; }),
            contract + "subpixel_bits is 17, but must be from 0 to 16");
  EXPECT_EQ(problem_of([](Structs& s) { s.contract.tie_rule = 12; }),
            contract + "tie_rule is 12, but must be from 0 to 11");
  EXPECT_EQ(problem_of([](Structs& s) { s.contract.lacks = 1U << 21U; }),
            contract + "lacks is 2097152, but must be from 0 to 2097151");
  EXPECT_EQ(problem_of([](Structs& s) { s.contract.depth_store = 3; }),
            contract + "depth_store is 3, but must be from 0 to 2");
  EXPECT_EQ(problem_of([](Structs& s) { s.contract.bias_slope = 3; }),
            contract + "bias_slope is 3, but must be from 0 to 2");
  EXPECT_EQ(problem_of([](Structs& s) { s.contract.bias_unit = 6; }),
            contract + "bias_unit is 6, but must be from 0 to 5");
  EXPECT_EQ(problem_of([](Structs& s) { s.contract.bias_exponent = 2; }),
            contract + "bias_exponent is 2, but must be from 0 to 1");
  EXPECT_EQ(problem_of([](Structs& s) { s.contract.depth_format = 5; }),
            contract + "depth_format is 5, but must be from 0 to 4");
  EXPECT_EQ(problem_of([](Structs& s) { s.contract.position_error = -1; }),
            contract + "position_error is -1, but must be from 0 to 65536");
  EXPECT_EQ(problem_of([](Structs& s) {
              s.contract.depth.constant = std::numeric_limits<float>::quiet_NaN();
            }),
            contract + "depth is nan, but must be from 0 to 3.5e+38");
  EXPECT_EQ(checked_plugin(nullptr, "x.so").error().reason,
            "rastercheck_plugin_get() returned a null pointer");
}

TEST(Plugin, IsRefusedWhereThereIsNone) {
  const auto none = load_plugin("nowhere.so");
  ASSERT_FALSE(none);
  EXPECT_EQ(
      to_string(none.error()),
      "plugin:nowhere.so: no such file; paths are relative to the folder that rastercheck runs in");
  EXPECT_EQ(none.error().failure, Failure::refused);
  const auto text = load_plugin(RASTERCHECK_SOURCE_DIR "/README.md");
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().failure, Failure::unavailable);
}

}  // namespace
}  // namespace rastercheck::backends::library_test
