#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backends/backend.h"

namespace rastercheck::backends::registry_test {
namespace {

TEST(Registry, ListsTheRasterizerAndTheMethods) {
  std::vector<std::string> names;
  for (const Listing& listing : list_backends()) names.push_back(listing.specification);
  EXPECT_THAT(names, testing::IsSupersetOf({"cpu", "method:rational-linear"}));
}

TEST(Registry, MakesEverythingItListsAsAvailable) {
  for (const Listing& listing : list_backends()) {
    if (!listing.unavailable_because.empty()) continue;
    EXPECT_TRUE(make_backend(listing.specification)) << listing.specification;
  }
}

TEST(Registry, NamesWhatThereIsWhereAskedForSomethingElse) {
  const auto none = make_backend("gpu:fast");
  ASSERT_FALSE(none);
  EXPECT_THAT(to_string(none.error()),
              testing::StartsWith("gpu:fast: no backend of that name; there are: cpu, "));
  EXPECT_THAT(to_string(none.error()), testing::HasSubstr(", method"));
  EXPECT_FALSE(make_backend("method:magic"));
  EXPECT_FALSE(make_backend("cpu:magic=1"));
}

}  // namespace
}  // namespace rastercheck::backends::registry_test
