#include "backends/held_backend.h"

#include <gtest/gtest.h>

#include <utility>

namespace rastercheck::backends::held_backend_test {
namespace {

/// Answers every question in another way than a backend that forgets to.
class Talkative : public Backend {
 public:
  std::string description() const override { return "talkative"; }
  std::optional<Driver> driver() const override { return Driver{"t", "1"}; }
  bool has_limits() const override { return true; }
  std::optional<Error> is_lost() const override { return Error{"", "", "lost"}; }
  cases::Contract contract(const cases::Case& /*c*/) const override {
    cases::Contract contract;
    contract.guard_band = 7;
    contract.keeps_constants = true;
    return contract;
  }
  Result<cases::Fragments> draw(const cases::Case& /*c*/) override { return fail("draw"); }
  bool traces() const override { return true; }
  Result<std::optional<records::SampleTrace>> trace(const cases::Case& /*c*/,
                                                    const cases::SamplePlace& /*at*/) override {
    return fail("trace");
  }
  bool draws_pictures() const override { return true; }
  Result<cases::Picture> draw_picture(const cases::Case& /*c*/,
                                      const cases::Pipeline& /*pipeline*/) override {
    return fail("draw_picture");
  }
  bool draws_over() const override { return true; }
  Result<void> draw_over(const cases::Case& /*c*/, const cases::Pipeline& /*pipeline*/,
                         cases::Picture& /*picture*/) override {
    return fail("draw_over");
  }
  std::vector<std::string> same_as() const override { return {"another"}; }
  bool assembles() const override { return true; }
  Result<cases::Fragments> draw_assembled(const cases::Case& /*c*/, cases::Topology /*topology*/,
                                          std::span<const std::uint32_t> /*indices*/) override {
    return fail("draw_assembled");
  }
  bool transforms() const override { return true; }
  Result<std::vector<cases::ClipVertex>> transform(const cases::Case& /*c*/) override {
    return fail("transform");
  }
  Result<std::vector<cases::Normal>> transform_normals(
      const cases::Matrix4& /*model*/, std::span<const cases::Normal> /*normals*/) override {
    return fail("transform_normals");
  }

 private:
  static tl::unexpected<Error> fail(const char* question) {
    return tl::unexpected(Error{"", "", question});
  }
};

template <typename T>
std::string reason_of(const Result<T>& answer) {
  return answer ? "" : answer.error().reason;
}

// Kills: a question that is answered by Backend's default instead of by the backend.
TEST(HeldBackend, ForwardsEveryQuestion) {
  const auto held = held_to({}, std::make_unique<Talkative>());
  EXPECT_EQ(held->description(), "talkative");
  EXPECT_EQ(held->driver(), (Driver{"t", "1"}));
  EXPECT_TRUE(held->has_limits());
  EXPECT_TRUE(held->is_lost().has_value());
  EXPECT_EQ(held->contract({}).guard_band, 7);
  EXPECT_EQ(reason_of(held->draw({})), "draw");
  EXPECT_TRUE(held->traces());
  EXPECT_EQ(reason_of(held->trace({}, {})), "trace");
  EXPECT_TRUE(held->draws_pictures());
  EXPECT_EQ(reason_of(held->draw_picture({}, {})), "draw_picture");
  EXPECT_TRUE(held->draws_over());
  cases::Picture picture;
  EXPECT_EQ(reason_of(held->draw_over({}, {}, picture)), "draw_over");
  EXPECT_EQ(held->same_as(), std::vector<std::string>{"another"});
  EXPECT_TRUE(held->assembles());
  EXPECT_EQ(reason_of(held->draw_assembled({}, {}, {})), "draw_assembled");
  EXPECT_TRUE(held->transforms());
  EXPECT_EQ(reason_of(held->transform({})), "transform");
  EXPECT_EQ(reason_of(held->transform_normals({}, {})), "transform_normals");
}

TEST(HeldBackend, PromisesWhatItIsHeldTo) {
  cases::ContractTerms terms;
  terms.guard_band = 64;
  Talkative backend;
  const cases::Contract contract = held_to(terms, backend)->contract({});
  EXPECT_EQ(contract.guard_band, 64);
  EXPECT_TRUE(contract.keeps_constants);  // of which the terms say nothing
}

TEST(HeldBackend, IsWhatIsMadeUntilToldOtherwise) {
  cases::ContractTerms terms;
  terms.guard_band = 64;
  cases::Case c;
  c.coverage = cases::Snapping{};
  hold_backends_to(terms);
  const auto held = make_backend("cpu");
  hold_backends_to(std::nullopt);
  const auto own = make_backend("cpu");
  ASSERT_TRUE(held.has_value() && own.has_value());
  EXPECT_EQ((*held)->contract(c).guard_band, 64);
  EXPECT_EQ((*own)->contract(c).guard_band, 32768);
}

}  // namespace
}  // namespace rastercheck::backends::held_backend_test
