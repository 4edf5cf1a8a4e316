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
  terms.coverage = Coverage(Snapping{4, Rounding::unspecified, 0.1F});
  terms.is_on_grid = false;
  terms.basis = Basis::unspecified;
  terms.tie_rule = TieRule::unspecified;
  terms.conservative =
      Conservative{ConservativeKind::outer, 0x1p-9F, 0.75F, ConservativeCorners::edges, true};
  terms.guard_band = 16384.5F;
  terms.clip_tolerance = 2.25F;
  terms.clip_error = 0.0625F;
  terms.viewport_error = 0.5F;
  terms.depth_format = DepthFormat::unorm24;
  terms.claims = Claim::affine;
  terms.smooth = ValueBound{6.84F, 0.25F, 0x1p-24F, 1e-7F};
  terms.noperspective = ValueBound{1, 2, 3, 4};
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
  terms.coverage = AsAsked{};
  terms.basis = AsAsked{};
  terms.tie_rule = AsAsked{};
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
  terms.coverage = AskedGrid{Rounding::unspecified, 0.25F};
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
  EXPECT_THAT(refusal(R"("tie_rule": "top_right")"), HasSubstr("/tie_rule: must be top_left"));
  EXPECT_THAT(refusal(R"("guard_band": -1)"), HasSubstr("/guard_band"));
  EXPECT_THAT(refusal(R"("bounds": {"smooth": {}})"), HasSubstr("/bounds/smooth"));
  EXPECT_THAT(refusal(R"("bounds": {"depth": {"constant": 1, "per_horizon": 1}})"),
              HasSubstr("/bounds/depth: must have a constant only"));
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
  expected.is_on_grid = false;
  expected.clip_tolerance = 2.25;
  expected.clip_error = 0.0625;
  expected.viewport_error = 0.5;
  expected.depth_format = DepthFormat::unorm24;
  expected.claims = Claim::affine;
  expected.bounds = {{6.84F, 0.25F, 0x1p-24F, 1e-7F}, {1, 2, 3, 4}, {0.51F}};
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
  terms.coverage = AsAsked{};
  terms.basis = AsAsked{};
  terms.tie_rule = AsAsked{};
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
