#include "backends/backend.h"

#include <gtest/gtest.h>

namespace rastercheck::backends::backend_test {
namespace {

/// A backend that promises a guard band of its own and draws nothing.
class DrawsNothing : public Backend {
 public:
  cases::Contract promise(const cases::Case& /*c*/) const override {
    cases::Contract contract;
    contract.guard_band = 7;
    contract.keeps_constants = true;
    return contract;
  }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& /*c*/) override {
    return cases::Fragments{};
  }
};

TEST(Backend, CanDoNothingBesidesUnlessItSaysSo) {
  DrawsNothing backend;
  EXPECT_EQ(backend.picture_drawer(), nullptr);
  EXPECT_EQ(backend.assembler(), nullptr);
  EXPECT_EQ(backend.vertex_stage(), nullptr);
  EXPECT_EQ(backend.tracer(), nullptr);
  EXPECT_EQ(backend.about(), About());
  EXPECT_FALSE(backend.is_lost().has_value());
}

// Kills: terms that affect only contract() or only draw(); terms that change what they do not
// mention; terms that stay after they are removed.
TEST(Backend, IsHeldToTermsUntilToldOtherwise) {
  cases::ContractTerms terms;
  terms.guard_band = 64;
  DrawsNothing backend;
  EXPECT_EQ(backend.contract({}).guard_band, 7);
  backend.hold_to(terms);
  EXPECT_EQ(backend.terms(), terms);
  EXPECT_EQ(backend.contract({}).guard_band, 64);
  EXPECT_EQ(backend.draw({})->contract, backend.contract({}));
  EXPECT_TRUE(backend.contract({}).keeps_constants);
  EXPECT_EQ(backend.promise({}).guard_band, 7);
  backend.hold_to(std::nullopt);
  EXPECT_EQ(backend.contract({}).guard_band, 7);
  EXPECT_EQ(backend.draw({})->contract.guard_band, 7);
}

}  // namespace
}  // namespace rastercheck::backends::backend_test
