// A fragment as JSON, by hand. The triangle's window corners are (0,0), (4,0), (0,4); with
// w = (1, 2, 1): e_0 = 1 - u/4 - v/4, e_1 = u/8, and 1/w = 1 - u/8 is 15/16 at (1/2, 1/2).

#include "oracle/fragment_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::fragment_json_test {
namespace {

using nlohmann::json;

cases::Case corner(float w1) {
  return small_case(cases::Rules::vulkan, 4, 4, {{{-1, -1, 0, 1}, {w1, -w1, 0, w1}, {-1, 1, 0, 1}}},
                    {{{0}, {1}, {0}}});
}

json detailed(const cases::Case& c, int x, int y) {
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  const Fragment fragment = fragment_at(scene, truth, 0, x, y, 0, truth.judge(x, y, 0));
  return json::parse(to_detailed_json(fragment, truth));
}

TEST(FragmentJson, HasTheFragmentAndWhatIsAskedBesides) {
  const json f = detailed(corner(2), 0, 0);
  EXPECT_EQ(f["triangle"], 0);
  EXPECT_EQ(f["verdict"], "required");
  EXPECT_EQ(f["depth"], "0");
  EXPECT_EQ(f["attributes"], json::parse(R"(["1/15"])"));
  EXPECT_EQ(f["distance"], json::parse("[0.5, 0.5]"));
  EXPECT_EQ(f["derivatives"], json::parse(R"([["32/225", "0"]])"));
  EXPECT_EQ(f["kappa"], json::parse(R"(["1"])"));
  EXPECT_EQ(f["kappa_d"], json::parse(R"(["4/3"])"));  // (1 + 1/8 + 1/8) / (15/16)
}

// w1 = -1: 1/w = 1 - u/2 is negative in pixel 2, and the attribute is evaluated at its centre.
TEST(FragmentJson, IsNullWhereThereIsNothing) {
  cases::Case c = corner(-1);
  c.attributes[0].location = cases::Location::center;
  const json f = detailed(c, 2, 0);
  for (const char* const name : {"attributes", "derivatives", "kappa", "kappa_d"}) {
    EXPECT_EQ(f[name], json::parse("[null]")) << name;
  }
}

// The vertices lie on one line: a triangle without orientation has no distances.
TEST(FragmentJson, HasNoDistanceOfATriangleWithoutOrientation) {
  cases::Case c = corner(1);
  c.positions[2] = {0, -1, 0, 1};
  EXPECT_EQ(detailed(c, 0, 0)["distance"], nullptr);
}

TEST(FragmentJson, GivesBothEndsOfAnOpenRange) {
  EXPECT_EQ(to_json(ValueRange{Rational(0.5), Rational(2), true}), R"(["1/2", "2"])");
  EXPECT_EQ(to_json(ValueRange{Rational(0.5), Rational(0.5), true}), R"(["1/2", "1/2"])");
  EXPECT_EQ(to_json(ValueRange{Rational(0.5), Rational(0.5), false}), R"("1/2")");
  EXPECT_EQ(to_json(std::optional<ValueRange>()), "null");
}

}  // namespace
}  // namespace rastercheck::oracle::fragment_json_test
