// The law catches strips and fans that are drawn as other triangles than the API specifies.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"
#include "tests/properties/laws/own_findings.h"

namespace rastercheck::properties::strips_and_fans_are_their_triangles_test {
namespace {

using cases::Case;
using cases::Fragments;
using cases::Topology;
using records::FragmentClass;
using testing::HasSubstr;
using testing::IsSupersetOf;

constexpr std::string_view kLaw = "strips-and-fans-are-their-triangles";

Found find_with(AssemblyDamage damage, std::uint64_t count = 30) {
  DamagedBackend backend({}, "cpu");
  backend.assembly_damage = std::move(damage);
  return find_in_cases(kLaw, backend, count);
}

TEST(StripsAndFans, MeetEveryTopologyRuleAndRestart) {
  const Found found = find_with({}, 200);
  EXPECT_EQ(found.violations, 0U);
  EXPECT_THAT(found.labels, IsSupersetOf({"culled", "fan", "list", "restart", "strip"}));
  EXPECT_THAT(found.strata,
              testing::ElementsAre("fan of d3d", "fan of opengl", "fan of vulkan", "list of d3d",
                                   "list of opengl", "list of vulkan", "strip of d3d",
                                   "strip of opengl", "strip of vulkan"));
}

TEST(StripsAndFans, FindRestartsThatAreSkipped) {
  const Found found = find_with([](const Case&, Topology&, std::vector<std::uint32_t>& indices) {
    std::erase(indices, cases::kRestart);
  });
  EXPECT_GT(found.violations, 0U);
}

TEST(StripsAndFans, FindOneTopologyTakenForAnother) {
  const Found found = find_with([](const Case&, Topology& topology, std::vector<std::uint32_t>&) {
    if (topology == Topology::fan) topology = Topology::strip;
  });
  EXPECT_GT(found.violations, 0U);
  for (const std::string& note : found.notes) EXPECT_THAT(note, HasSubstr("a fan"));
}

/// Makes the triangles of strips itself, with a given order of vertices; it draws everything else
/// correctly.
class StripsBy : public DamagedBackend {
 public:
  using TriangleOf = cases::Triangle (*)(std::span<const std::uint32_t> run, std::size_t i);
  explicit StripsBy(TriangleOf triangle_of)
      : DamagedBackend({}, "cpu"), triangle_of_(triangle_of) {}
  Result<Fragments> draw_assembled(const Case& c, Topology topology,
                                   std::span<const std::uint32_t> indices) override {
    if (topology != Topology::strip) {
      return DamagedBackend::draw_assembled(c, topology, indices);
    }
    Case triangles = c;
    triangles.triangles.clear();
    while (!indices.empty()) {
      const auto end = std::find(indices.begin(), indices.end(), cases::kRestart);
      const auto run = indices.first(static_cast<std::size_t>(end - indices.begin()));
      for (std::size_t i = 0; i + 2 < run.size(); ++i) {
        triangles.triangles.push_back(triangle_of_(run, i));
      }
      indices = indices.subspan(std::min(run.size() + 1, indices.size()));
    }
    return draw_fragments(triangles);
  }

 private:
  TriangleOf triangle_of_;
};

TEST(StripsAndFans, FindOddTrianglesWoundTheOtherWay) {
  StripsBy backend([](std::span<const std::uint32_t> run, std::size_t i) {
    return cases::Triangle{run[i], run[i + 1], run[i + 2]};
  });
  const Found found = find_in_cases(kLaw, backend, 60);
  EXPECT_GT(found.violations, 0U);
  ASSERT_FALSE(found.notes.empty());
  EXPECT_THAT(*found.notes.begin(), HasSubstr(" of vertices "));
}

// Strips with OpenGL's provoking vertex. They are right in the cases with OpenGL's rules, which are
// a third of all cases. In the other cases the triangles have the right winding but the wrong
// provoking vertex.
TEST(StripsAndFans, FindAnotherProvokingVertex) {
  StripsBy backend([](std::span<const std::uint32_t> run, std::size_t i) {
    const bool is_odd = i % 2 == 1;
    return cases::Triangle{run[is_odd ? i + 1 : i], run[is_odd ? i : i + 1], run[i + 2]};
  });
  std::set<std::string> wrong;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Generated made = own_case(kLaw, i);
    const Check check = check_law(*find_law(kLaw), made.source, backend, i).value();
    if (check.violation_count > 0) wrong.insert(made.stratum);
    for (const records::Violation& violation : check.violations) {
      EXPECT_EQ(violation.kind, records::AttributeKind::flat);
    }
  }
  EXPECT_THAT(wrong, testing::ElementsAre("strip of d3d", "strip of vulkan"));
}

TEST(StripsAndFans, FindAMissingFragmentAndNameItsTriangle) {
  DamagedBackend backend(
      [](const Case&, Fragments& drawn) {
        drawn.derivatives.clear();
        if (find(drawn, 1, 6, 6) < drawn.size()) drop(drawn, 1, 6, 6);
      },
      "cpu");
  bool is_plain_strip = false;
  backend.assembly_damage = [&](const Case&, Topology& topology,
                                std::vector<std::uint32_t>& indices) {
    is_plain_strip =
        topology == Topology::strip && indices == std::vector<std::uint32_t>{0, 1, 2, 3};
  };
  Case c = square();
  Check check = check_of(kLaw, c, backend);
  for (int i = 0; i < 100 && !is_plain_strip; ++i) {
    for (cases::ClipVertex& p : c.positions) p.z /= 2;  // makes the law choose other indices
    check = check_of(kLaw, c, backend);
  }
  ASSERT_TRUE(is_plain_strip);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations[0].place.x, 6U);
  EXPECT_EQ(
      check.violations[0].note,
      "a strip of vertices 0 1 2 3 (R: restart) instead of the case's triangles, its triangle 1 of "
      "vertices 1, 3, 2");
}

TEST(StripsAndFans, HoldOfCasesThatAreNoStrip) {
  DamagedBackend backend({}, "cpu");
  const Check check = check_of(kLaw, square(), backend);
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  Case none = square();
  none.positions.resize(2);
  none.attribute_values.resize(6);
  none.triangles.clear();
  EXPECT_FALSE(check_of(kLaw, none, backend).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::strips_and_fans_are_their_triangles_test
