// The law catches strips that are drawn as other lines than the API specifies.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"
#include "tests/properties/laws/own_findings.h"

namespace rastercheck::properties::line_strips_are_their_lines_test {
namespace {

using cases::Case;
using cases::Topology;
using testing::HasSubstr;
using testing::IsSupersetOf;

constexpr std::string_view kLaw = "line-strips-are-their-lines";

/// The findings of the law in its own cases, drawn with damaged indices.
Found find_with(AssemblyDamage damage, std::uint64_t count = 30) {
  DamagedBackend backend({}, "cpu");
  backend.assembly_damage = std::move(damage);
  return find_in_cases(kLaw, backend, count);
}

TEST(LineStrips, MeetEveryModeTopologyAndRestart) {
  const Found found = find_with({}, 200);
  EXPECT_EQ(found.violations, 0U);
  EXPECT_THAT(found.labels, IsSupersetOf({"list", "restart", "strip"}));
  EXPECT_THAT(found.strata, testing::ElementsAre("bresenham", "parallelogram", "rectangular"));
}

TEST(LineStrips, FindRestartsThatAreSkipped) {
  EXPECT_GT(find_with([](const Case&, Topology&, std::vector<std::uint32_t>& indices) {
              std::erase(indices, cases::kRestart);
            }).violations,
            0U);
}

TEST(LineStrips, FindStripsDrawnAsLists) {
  const Found found = find_with([](const Case&, Topology& topology, std::vector<std::uint32_t>&) {
    topology = Topology::triangles;
  });
  EXPECT_GT(found.violations, 0U);
  for (const std::string& note : found.notes) EXPECT_THAT(note, HasSubstr("a strip of vertices"));
}

TEST(LineStrips, FindALastLineThatIsMissing) {
  EXPECT_GT(find_with([](const Case&, Topology&, std::vector<std::uint32_t>& indices) {
              indices.pop_back();
            }).violations,
            0U);
}

// The provoking vertex is then the other one, and Bresenham's lines leave out the other end. Lines
// keep their numbers: only lists change, whose indices have no restarts.
TEST(LineStrips, FindLinesDrawnFromTheirEnd) {
  EXPECT_GT(find_with(
                [](const Case&, Topology& topology, std::vector<std::uint32_t>& indices) {
                  if (topology == Topology::strip || std::ranges::count(indices, cases::kRestart)) {
                    return;
                  }
                  for (std::size_t i = 0; i + 1 < indices.size(); i += 2) {
                    std::swap(indices[i], indices[i + 1]);
                  }
                },
                100)
                .violations,
            0U);
}

TEST(LineStrips, SayNothingOnTriangles) {
  DamagedBackend backend({}, "cpu");
  const Check check =
      check_law(*find_law(kLaw), own_case("strips-and-fans-are-their-triangles", 0).source, backend,
                0)
          .value();
  EXPECT_EQ(check.why_not, "the property is about lines");
}

}  // namespace
}  // namespace rastercheck::properties::line_strips_are_their_lines_test
