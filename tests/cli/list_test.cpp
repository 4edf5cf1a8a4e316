#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace rastercheck::cli {
namespace {

using testing::HasSubstr;

TEST(List, ShowsEveryKind) {
  const Outcome outcome = run_program({"list"});
  EXPECT_EQ(outcome.code, 0);
  for (const std::string kind : {"backends:", "properties:", "methods:", "rules:", "patterns:"}) {
    EXPECT_THAT(outcome.out, HasSubstr(kind));
  }
}

TEST(List, OfOneKindShowsNoOther) {
  const Outcome outcome = run_program({"list", "rules", "--quiet"});
  EXPECT_EQ(
      outcome.out,
      "opengl  bottom_left  ideal\nvulkan  top_left     ideal\nd3d     top_left     snapped\n");
}

TEST(List, AsJsonIsJson) {
  const auto document = nlohmann::json::parse(run_program({"list", "--json"}).out);
  EXPECT_EQ(document.at("rules").size(), 3U);
  EXPECT_EQ(document.at("patterns").at(1),
            nlohmann::json::parse(R"({"samples": 2, "positions": [[12, 12], [4, 4]]})"));
  EXPECT_TRUE(document.at("backends").is_array());
}

}  // namespace
}  // namespace rastercheck::cli
