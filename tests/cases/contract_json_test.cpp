#include "cases/contract_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace rastercheck::cases::contract_json_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kHeader = R"("format": "rastercheck-contract", "version": 1)";

Result<ContractTerms> parse(const std::string& members) {
  const std::string comma = members.empty() ? "" : ", ";
  return parse_contract(std::string("{") + kHeader + comma + members + "}", "c.json");
}

std::string refusal(const std::string& members) {
  const Result<ContractTerms> terms = parse(members);
  return terms ? "" : to_string(terms.error());
}

/// Terms with every member set, each to a value that no contract has by default.
ContractTerms all_terms() {
  ContractTerms terms;
  terms.name = "measured \"so\"";
  terms.coverage.emplace(Coverage(Snapping{4, Rounding::unspecified, 0.1F}));
  terms.is_on_grid = false;
  terms.basis.emplace(Basis::unspecified);
  terms.tie_rule.emplace(TieRule::unspecified);
  terms.conservative =
      Conservative{ConservativeKind::outer, 0x1p-9F, 0.75F, ConservativeCorners::edges, true};
  terms.guard_band = 16384.5F;
  terms.culls_instead_of_clipping = true;
  terms.culls = Winding::counter_clockwise;
  terms.least_area = 0.375F;
  terms.sample_position = PixelFraction{7, 3, 12};
  terms.clip_tolerance = 2.25F;
  terms.clip_error = 0.0625F;
  terms.viewport_error = 0.5F;
  terms.depth_format = DepthFormat::unorm24;
  terms.depth_store = DepthStore::nearly_nearest;
  terms.depth_bias = BiasPromise{BiasSlope::root, BiasUnit::open, BiasExponent::open};
  terms.depth_function = KeptDepth::greater_or_equal;
  terms.depth_error = DepthError::never_farther;
  terms.claims = Claim::affine;
  terms.smooth = ValueBound{6.84F, 0.25F, 0x1p-24F, 1e-7F};
  terms.noperspective = ValueBound{1, 2, 3, 4, 0x1p-9F};
  terms.depth = ValueBound{0.51F};
  terms.keeps_equal_depth = true;
  terms.keeps_constants = true;
  terms.keeps_vertex_values = true;
  terms.keeps_sign_of_zero = false;
  terms.is_invariant = false;
  terms.derivative_bound = std::optional<float>(0.75F);
  terms.quad_share = std::optional<float>(0x1p-29F);
  terms.numbers = MagnitudeRange{0x1p-126F, 0x1p62F};
  return terms;
}

TEST(ContractJson, ComesBackAsItWasWritten) {
  const ContractTerms terms = all_terms();
  const Result<ContractTerms> again = parse_contract(to_json(terms), "c.json");
  ASSERT_TRUE(again.has_value()) << to_string(again.error());
  EXPECT_EQ(*again, terms);
}

TEST(ContractJson, HasGridsAndRoundingsOfOtherKinds) {
  ContractTerms terms;
  terms.coverage.emplace(Coverage(with_steps({8, Rounding::floor, 0.5F}, 12)));
  const Result<ContractTerms> parsed =
      parse(R"("coverage": {"steps_per_pixel": 12, "rounding": "floor", "position_error": 0.5})");
  ASSERT_TRUE(parsed.has_value()) << to_string(parsed.error());
  EXPECT_EQ(*parsed, terms);
  EXPECT_EQ(parse_contract(to_json(terms), "c.json").value_or(ContractTerms()), terms);
  const Snapping twelfths = *std::get<Coverage>(*parsed->coverage);
  EXPECT_EQ(twelfths.odd_steps, 3);
  EXPECT_EQ(twelfths.subpixel_bits, 2);
  // A power of two is the same grid however it is named.
  EXPECT_EQ(parse(R"("coverage": {"steps_per_pixel": 16})").value_or(ContractTerms()),
            parse(R"("coverage": {"subpixel_bits": 4})").value_or(terms));

  Snapping by_axis{8, Rounding::ceil, 0};
  by_axis.rounding_of_y = Rounding::half_down;
  terms.coverage.emplace(Coverage(by_axis));
  EXPECT_EQ(
      parse(R"("coverage": {"subpixel_bits": 8, "rounding": {"x": "ceil", "y": "half_down"}})")
          .value_or(ContractTerms()),
      terms);
  EXPECT_EQ(parse_contract(to_json(terms), "c.json").value_or(ContractTerms()), terms);
  terms.coverage.emplace(AskedGrid{Rounding::ceil, 0, Rounding::floor});
  EXPECT_EQ(parse_contract(to_json(terms), "c.json").value_or(ContractTerms()), terms);
}

TEST(ContractJson, HasSamplePositionsAsFractions) {
  const auto read = [](const std::string& text) {
    return parse("\"sample_position\": " + text).value_or(ContractTerms()).sample_position;
  };
  EXPECT_EQ(read(R"(["7/12", "7/12"])"), (PixelFraction{7, 7, 12}));
  EXPECT_EQ(read(R"([0, "1/3"])"), (PixelFraction{0, 1, 3}));
  EXPECT_EQ(read(R"(["1/4", "1/6"])"), (PixelFraction{3, 2, 12}));
  for (const char* wrong :
       {R"(["1/1", 0])", R"(["-1/2", 0])", R"(["1/2"])", R"([0.5, 0])", R"(["1/257", 0])",
        R"(["1/255", "1/254"])", R"(["/2", 0])", R"(["1/2/3", 0])", R"("1/2")", R"(["1/0", 0])"}) {
    EXPECT_THAT(refusal(std::string("\"sample_position\": ") + wrong),
                HasSubstr("/sample_position"))
        << wrong;
  }
}

TEST(ContractJson, HasDistancesBeyondTheViewport) {
  ContractTerms terms;
  terms.guard_beyond_viewport = 0.0F;
  EXPECT_EQ(parse_contract(to_json(terms), "c.json").value_or(ContractTerms()), terms);
  Contract own;
  own.guard_beyond_viewport = 4.0F;
  ContractTerms of_origin;
  of_origin.guard_band = 99.0F;
  EXPECT_EQ(with_terms(own, of_origin, Case()).guard_beyond_viewport, std::nullopt);
  EXPECT_EQ(with_terms(own, terms, Case()).guard_beyond_viewport, 0.0F);
}

TEST(ContractJson, HasWordsForBiasAndStorage) {
  const auto bias = [](const std::string& text) {
    return parse("\"depth_bias\": " + text).value_or(ContractTerms()).depth_bias;
  };
  EXPECT_EQ(bias("{}"), BiasPromise());
  EXPECT_EQ(bias(R"({"slope": "between"})"), (BiasPromise{.slope = BiasSlope::between}));
  EXPECT_EQ(bias(R"({"unit": "double_power"})"), (BiasPromise{.unit = BiasUnit::double_power}));
  EXPECT_EQ(bias(R"({"unit": "either_power"})"), (BiasPromise{.unit = BiasUnit::either_power}));
  EXPECT_EQ(bias(R"({"unit": "least_value"})"), (BiasPromise{.unit = BiasUnit::least_value}));
  EXPECT_EQ(bias(R"({"exponent": "open"})"), (BiasPromise{.exponent = BiasExponent::open}));
  EXPECT_EQ(parse(R"("depth_store": "either")").value_or(ContractTerms()).depth_store,
            DepthStore::either);
  EXPECT_THAT(refusal(R"("depth_bias": {"slope": "steep"})"), HasSubstr("/depth_bias/slope"));
  EXPECT_THAT(refusal(R"("depth_bias": {"clamp": 1})"), HasSubstr("/depth_bias"));
  EXPECT_THAT(refusal(R"("depth_store": "unorm")"), HasSubstr("/depth_store"));
}

// A case that asks for a unorm format gets it; the term is about the other cases.
TEST(ContractJson, LeavesTheFormatOfACaseThatAsksForOne) {
  ContractTerms terms;
  terms.depth_format = DepthFormat::float64;
  terms.depth_store = DepthStore::either;
  terms.depth_bias = BiasPromise{.slope = BiasSlope::root};
  Case c;
  EXPECT_EQ(with_terms(contract_of(c), terms, c).depth_format, DepthFormat::float64);
  c.depth_format = DepthFormat::unorm24;
  const Contract contract = with_terms(contract_of(c), terms, c);
  EXPECT_EQ(contract.depth_format, DepthFormat::unorm24);
  EXPECT_EQ(contract.depth_store, DepthStore::either);
  EXPECT_EQ(contract.depth_bias.slope, BiasSlope::root);
}

// Each message names both members.
TEST(ContractJson, RefusesWhatContradictsItself) {
  EXPECT_EQ(refusal(R"("guard_band": 1, "guard_beyond_viewport": 1)"),
            "c.json: /guard_beyond_viewport: contradicts guard_band: only one of them can hold");
  EXPECT_EQ(refusal(R"("coverage": "exact", "basis": "snapped")"),
            "c.json: /basis: snapped contradicts coverage: exact, which has no snapped positions");
  EXPECT_THAT(refusal(R"("coverage": "exact", "guard_beyond_viewport": 1)"),
              HasSubstr("contradicts coverage: exact"));
  EXPECT_THAT(refusal(R"("coverage": {"subpixel_bits": 8, "steps_per_pixel": 12})"),
              HasSubstr("must have either subpixel_bits or steps_per_pixel"));
  EXPECT_THAT(refusal(R"("coverage": {"rounding": "floor"})"),
              HasSubstr("must have either subpixel_bits or steps_per_pixel"));
  EXPECT_THAT(
      refusal(
          R"("coverage": {"subpixel_bits": 8, "rounding": {"x": "unspecified", "y": "floor"}})"),
      HasSubstr("x and y must both be unspecified, or neither"));
}

// Kills: a digest of the file's text, or of only some terms.
TEST(ContractDigest, IsOfTheTermsAlone) {
  const ContractTerms terms = all_terms();
  ContractTerms other = terms;
  other.name = "another";
  EXPECT_EQ(digest_of(other), digest_of(terms));
  const std::string keys = R"("is_invariant": false, "guard_band": 16)";
  const std::string turned = R"("guard_band": 1.6e1,   "is_invariant": false)";
  EXPECT_EQ(digest_of(parse(keys).value()), digest_of(parse(turned).value()));
  EXPECT_NE(digest_of(parse(keys).value()), digest_of(parse("").value()));
  other.numbers->greatest = 0x1p63F;
  EXPECT_NE(digest_of(other), digest_of(terms));
}

TEST(ContractJson, DistinguishesAsAskedFromAbsentTerms) {
  ContractTerms terms;
  terms.coverage.emplace(AsAsked{});
  terms.basis.emplace(AsAsked{});
  terms.tie_rule.emplace(AsAsked{});
  terms.derivative_bound = std::optional<float>();
  terms.quad_share = std::optional<float>();
  terms.conservative = std::optional<Conservative>();
  const Result<ContractTerms> again = parse_contract(to_json(terms), "c.json");
  ASSERT_TRUE(again.has_value()) << to_string(again.error());
  EXPECT_EQ(*again, terms);
  EXPECT_EQ(parse("").value_or(terms), ContractTerms());
  EXPECT_THAT(to_json(ContractTerms()), Not(HasSubstr("coverage")));
}

TEST(ContractJson, ExactIsNoGrid) {
  const Result<ContractTerms> terms = parse(R"("coverage": "exact")");
  ASSERT_TRUE(terms.has_value());
  EXPECT_EQ(terms->coverage, CoverageTerm(Coverage()));
}

// Kills: a grid that the case asks for, rounded as the case says instead of as the file says.
TEST(ContractJson, HasGridsOfTheCaseRoundedInOneWay) {
  ContractTerms terms;
  terms.coverage.emplace(AskedGrid{Rounding::unspecified, 0.25F});
  EXPECT_EQ(parse_contract(to_json(terms), "c.json").value_or(ContractTerms()), terms);
  Case c;
  c.coverage = Snapping{5, Rounding::half_up, 0};
  EXPECT_EQ(with_terms(Contract(), terms, c).coverage,
            Coverage(Snapping{5, Rounding::unspecified, 0.25F}));
  c.coverage.reset();
  EXPECT_EQ(with_terms(Contract(), terms, c).coverage, Coverage());
}

TEST(ContractJson, HasConservativeCoverageOfItsKindAlone) {
  const Result<ContractTerms> terms = parse(R"("conservative": {"kind": "inner"})");
  ASSERT_TRUE(terms.has_value());
  EXPECT_EQ(terms->conservative, Conservative{.kind = ConservativeKind::inner});
}

// Kills: values that contradict each other, accepted.
TEST(ContractJson, RefusesConservativeCoverageThatContradictsItself) {
  EXPECT_EQ(refusal(R"("conservative": {"kind": "inner", "growth": 0.5})"),
            "c.json: /conservative/growth: must be 0 for inner coverage, which never grows");
  EXPECT_EQ(refusal(R"("conservative": {"kind": "inner", "corners": "edges"})"),
            "c.json: /conservative/corners: must be \"square\" for inner coverage");
  EXPECT_EQ(refusal(R"("conservative": {"kind": "inner", "covers_degenerates": true})"),
            "c.json: /conservative/covers_degenerates: must be false for inner coverage: no pixel "
            "lies in a triangle without area");
  EXPECT_EQ(refusal(R"("conservative": "outer")"),
            "c.json: /conservative: must be \"none\" or an object with a kind");
  EXPECT_THAT(refusal(R"("conservative": {"kind": "outer", "error": -1})"),
              HasSubstr("/conservative/error"));
  EXPECT_THAT(refusal(R"("conservative": {"error": 1})"), HasSubstr("/conservative"));
}

TEST(ContractJson, RefusesWhatNoContractHas) {
  EXPECT_EQ(refusal(R"("bound": {})"), "c.json: /bound: unknown key 'bound'");
  EXPECT_THAT(refusal(R"("coverage": "snapped")"), HasSubstr("c.json: /coverage: must be"));
  EXPECT_THAT(refusal(R"("coverage": {"subpixel_bits": 17})"),
              HasSubstr("/coverage/subpixel_bits"));
  EXPECT_THAT(refusal(R"("tie_rule": "left_top")"), HasSubstr("/tie_rule: must be top_left"));
  EXPECT_THAT(refusal(R"("coverage": {"steps_per_pixel": 0})"),
              HasSubstr("/coverage/steps_per_pixel"));
  EXPECT_THAT(refusal(R"("guard_band": -1)"), HasSubstr("/guard_band"));
  EXPECT_THAT(refusal(R"("bounds": {"smooth": {}})"), HasSubstr("/bounds/smooth"));
  EXPECT_THAT(refusal(R"("bounds": {"depth": {"constant": 1, "per_horizon": 1}})"),
              HasSubstr("/bounds/depth: must have only constant and absolute"));
  EXPECT_THAT(refusal(R"("numbers": {"least": 2, "greatest": 1})"), HasSubstr("/numbers: least"));
  EXPECT_THAT(refusal(R"("derivative_bound": "nothing")"), HasSubstr("/derivative_bound"));
  const Result<ContractTerms> later =
      parse_contract(R"({"format": "rastercheck-contract", "version": 2, "new": 1})", "c.json");
  ASSERT_FALSE(later.has_value());
  EXPECT_EQ(to_string(later.error()), "c.json: /version: version must be 1");
}

// Kills: a term that is read and then ignored.
TEST(ContractTerms, TakeThePlaceOfWhatIsPromised) {
  const Contract held = with_terms(Contract(), all_terms(), Case());
  Contract expected;
  expected.coverage = Snapping{4, Rounding::unspecified, 0.1F};
  expected.basis = Basis::unspecified;
  expected.tie_rule = TieRule::unspecified;
  expected.conservative =
      Conservative{ConservativeKind::outer, 0x1p-9F, 0.75F, ConservativeCorners::edges, true};
  expected.guard_band = 16384.5F;
  expected.culls_instead_of_clipping = true;
  expected.culls = Winding::counter_clockwise;
  expected.least_area = 0.375F;
  expected.sample_position = PixelFraction{7, 3, 12};
  expected.depth_function = KeptDepth::greater_or_equal;
  expected.depth_error = DepthError::never_farther;
  expected.is_on_grid = false;
  expected.clip_tolerance = 2.25;
  expected.clip_error = 0.0625;
  expected.viewport_error = 0.5;
  expected.depth_format = DepthFormat::unorm24;
  expected.depth_store = DepthStore::nearly_nearest;
  expected.depth_bias = {BiasSlope::root, BiasUnit::open, BiasExponent::open};
  expected.claims = Claim::affine;
  expected.bounds = {{6.84F, 0.25F, 0x1p-24F, 1e-7F}, {1, 2, 3, 4, 0x1p-9F}, {0.51F}};
  expected.keeps_equal_depth = true;
  expected.keeps_constants = true;
  expected.keeps_vertex_values = true;
  expected.keeps_sign_of_zero = false;
  expected.is_invariant = false;
  expected.derivative_bound = 0.75F;
  expected.quad_share = 0x1p-29F;
  expected.numbers = {0x1p-126F, 0x1p62F};
  EXPECT_EQ(held, expected);
}

TEST(ContractTerms, EmptyTermsKeepThePromise) {
  const Contract own = with_terms(Contract(), all_terms(), Case());
  EXPECT_EQ(with_terms(own, ContractTerms(), Case()), own);
}

TEST(ContractTerms, AsAskedTakesTheTermsOfTheCase) {
  ContractTerms terms;
  terms.coverage.emplace(AsAsked{});
  terms.basis.emplace(AsAsked{});
  terms.tie_rule.emplace(AsAsked{});
  Case c;
  c.coverage = Snapping{5, Rounding::half_up, 0};
  c.basis = Basis::snapped;
  c.fill_rule = TieRule::bottom_left;
  Contract expected;
  expected.coverage = c.coverage;
  expected.basis = Basis::snapped;
  expected.tie_rule = TieRule::bottom_left;
  EXPECT_EQ(with_terms(Contract(), terms, c), expected);
  c.coverage.reset();
  EXPECT_EQ(with_terms(Contract(), terms, c).basis, Basis::ideal);
}

}  // namespace
}  // namespace rastercheck::cases::contract_json_test
