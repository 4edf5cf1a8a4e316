#include "backends/factory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace rastercheck::backends::factory_test {
namespace {

const Listing* row_of(const std::vector<Listing>& listings, const std::string& specification) {
  const auto found = std::find_if(
      listings.begin(), listings.end(),
      [&specification](const Listing& one) { return one.specification == specification; });
  return found == listings.end() ? nullptr : &*found;
}

TEST(BackendFactory, ListsTheRasterizerAndTheMethods) {
  std::vector<std::string> names;
  for (const Listing& listing : BackendFactory().list()) names.push_back(listing.specification);
  EXPECT_THAT(names, testing::IsSupersetOf({"cpu", "method:rational-linear"}));
}

TEST(BackendFactory, MakesEverythingItListsAsAvailable) {
  for (const Listing& listing : BackendFactory().list()) {
    if (!listing.unavailable_because.empty()) continue;
    EXPECT_TRUE(make_backend(listing.specification)) << listing.specification;
  }
}

TEST(BackendFactory, NamesWhatThereIsWhereAskedForSomethingElse) {
  const auto none = make_backend("gpu:fast");
  ASSERT_FALSE(none);
  EXPECT_THAT(to_string(none.error()),
              testing::StartsWith("gpu:fast: unknown backend; backends: cpu, "));
  EXPECT_THAT(to_string(none.error()), testing::HasSubstr(", method"));
  EXPECT_FALSE(make_backend("method:magic"));
  EXPECT_FALSE(make_backend("cpu:magic=1"));
}

TEST(BackendFactory, HoldsWhatItMakesToItsTerms) {
  cases::ContractTerms terms;
  terms.guard_band = 64;
  cases::Case c;
  c.coverage = cases::Snapping{};
  const BackendFactory factory{.make_foreign = {}, .terms = terms};
  EXPECT_EQ(factory.make("cpu").value()->contract(c).guard_band, 64);
  EXPECT_EQ(make_backend("cpu").value()->contract(c).guard_band, 32768);
}

// Kills: running foreign code in this process although the factory isolates it; listing a backend
// without its own description, or holding it to no terms, if another function makes it.
TEST(BackendFactory, LeavesForeignBackendsToWhoMakesThem) {
  const BackendKind kind{"foreign", [](const std::string&) { return make_backend("cpu"); },
                         [] {
                           return std::vector<Listing>{{"foreign:a", "one"},
                                                       {"foreign:b", "two"},
                                                       {"foreign:c", "three", "no file"}};
                         },
                         true};
  const BackendRegistration registration(kind);
  BackendFactory factory;
  factory.terms.emplace().guard_band = 64;
  std::vector<std::string> made;
  factory.make_foreign =
      [&made](const std::string& specification) -> Result<std::unique_ptr<Backend>> {
    made.push_back(specification);
    if (specification == "foreign:b") {
      return tl::unexpected(Error{specification, "", "not here", Failure::unavailable});
    }
    return make_backend("method:rational-linear");
  };
  const std::vector<Listing> listings = factory.list();
  EXPECT_THAT(made, testing::ElementsAre("foreign:a", "foreign:b"));
  ASSERT_NE(row_of(listings, "foreign:b"), nullptr);
  EXPECT_EQ(row_of(listings, "foreign:a")->unavailable_because, "");
  EXPECT_EQ(row_of(listings, "foreign:b")->unavailable_because, "not here");
  EXPECT_EQ(row_of(listings, "foreign:b")->summary, "two");
  EXPECT_EQ(row_of(listings, "foreign:c")->unavailable_because, "no file");
  EXPECT_EQ(factory.make("foreign:a").value()->terms(), factory.terms);
  EXPECT_NE(make_backend("foreign:a").value()->picture_drawer(), nullptr);  // the backend `cpu`
}

TEST(Factory, KnowsKindsByTheirNames) {
  EXPECT_TRUE(names_a_kind("cpu"));
  EXPECT_TRUE(names_a_kind("cpu:nonsense"));
  EXPECT_FALSE(names_a_kind("cpu.json"));
  EXPECT_FALSE(names_a_kind("unknown:cpu"));
  EXPECT_FALSE(names_a_kind(""));
}

}  // namespace
}  // namespace rastercheck::backends::factory_test
