#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "backends/backend.h"
#include "backends/exec/messages.h"
#include "backends/isolation.h"
#include "cases/case.h"
#include "tests/temporary_folder.h"

namespace rastercheck::backends::exec_test {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

/// The backend of program.py with these arguments, in a process of its own.
Result<std::unique_ptr<Backend>> program(const std::string& arguments, double seconds = 20,
                                         const std::string& options = "") {
  const Isolation isolation{.command = {RASTERCHECK_PROGRAM, "worker"},
                            .timeout = std::chrono::duration<double>(seconds)};
  return make_isolated_backend("exec:" + options +
                                   RASTERCHECK_PYTHON " " RASTERCHECK_SOURCE_DIR
                                                      "/tests/backends/exec/program.py " +
                                   arguments,
                               isolation);
}

/// A case of two triangles, 8 × 8 pixels and two attributes, the second one flat.
cases::Case two_triangles() {
  cases::Case c;
  c.rules = cases::Rules::vulkan;
  c.framebuffer = {8, 8, 1};
  c.viewport = {0, 0, 8, 8, 0, 1};
  c.positions = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}, {1, 1, 0, 1}};
  c.attributes = {{"u", cases::Interpolation::smooth, cases::Location::sample},
                  {"v", cases::Interpolation::flat, cases::Location::sample}};
  c.attribute_values = {8, 1, 16, 2, 24, 3, 32, 4};
  c.triangles = {{0, 1, 2}, {2, 1, 3}};
  return c;
}

TEST(Exec, DrawsEachTriangleAlone) {
  const auto backend = program("");
  ASSERT_TRUE(backend) << to_string(backend.error());
  EXPECT_EQ((*backend)->about().description, "program 7");
  const auto drawn = (*backend)->draw(two_triangles());
  ASSERT_TRUE(drawn) << to_string(drawn.error());
  EXPECT_THAT(drawn->fragments.triangle, ElementsAre(0, 0, 0, 0, 1, 1, 1, 1));
  EXPECT_THAT(drawn->fragments.x, ElementsAre(1, 2, 1, 2, 1, 2, 1, 2));
  EXPECT_THAT(drawn->fragments.y, ElementsAre(1, 1, 2, 2, 1, 1, 2, 2));
  EXPECT_THAT(drawn->fragments.depth, Each(0.25F));
  EXPECT_THAT(drawn->fragments.attributes, Each(0.25F));
}

TEST(Exec, DrawsAllTrianglesTogetherForADepthTest) {
  const auto backend = program("");
  ASSERT_TRUE(backend);
  cases::Case c = two_triangles();
  c.depth_test = cases::DepthTest::less;
  const auto drawn = (*backend)->draw(c);
  ASSERT_TRUE(drawn) << to_string(drawn.error());
  EXPECT_THAT(drawn->fragments.triangle, ElementsAre(0, 0, 0, 0));
}

// Kills: names that the protocol does not have, at which a program ends that reads names strictly.
TEST(Exec, AsksForOneRuleWhereTheCaseLeavesItOpen) {
  cases::Case c = two_triangles();
  c.coverage = cases::Snapping{.rounding = cases::Rounding::unspecified};
  c.fill_rule = cases::TieRule::unspecified;
  const std::string header = draw_message(c, cases::contract_of(c), 0).header;
  EXPECT_THAT(header, HasSubstr(R"("rounding":"nearest_even")"));
  EXPECT_THAT(header, HasSubstr(R"("tie_rule":"bottom_left")"));
  c.coverage->rounding = cases::Rounding::half_up;
  c.fill_rule = cases::TieRule::top_left;
  const std::string other = draw_message(c, cases::contract_of(c), 0).header;
  EXPECT_THAT(other, HasSubstr(R"("rounding":"half_up")"));
  EXPECT_THAT(other, HasSubstr(R"("tie_rule":"top_left")"));
}

TEST(Exec, PassesArraysThroughSharedMemoryThatGrows) {
  const auto backend = program("shared");
  ASSERT_TRUE(backend) << to_string(backend.error());
  for (const int size : {8, 2000, 8}) {
    cases::Case c = two_triangles();
    c.framebuffer.width = size;
    const auto drawn = (*backend)->draw(c);
    ASSERT_TRUE(drawn) << to_string(drawn.error());
    EXPECT_THAT(drawn->fragments.attributes, testing::SizeIs(16));
    EXPECT_THAT(drawn->fragments.attributes, Each(0.25F));
  }
}

TEST(Exec, ComputesAttributesFromBarycentrics) {
  const auto backend = program("barycentrics");
  ASSERT_TRUE(backend) << to_string(backend.error());
  cases::Case c = two_triangles();
  const auto drawn = (*backend)->draw(c);
  ASSERT_TRUE(drawn) << to_string(drawn.error());
  // All weights are 1/4: (8 + 16 + 24) / 4, and (24 + 16 + 32) / 4. Vulkan's first vertex provokes.
  EXPECT_THAT(drawn->fragments.attributes,
              ElementsAre(12, 1, 12, 1, 12, 1, 12, 1, 18, 3, 18, 3, 18, 3, 18, 3));
  // Six times the bound of a weight, which the hello leaves at 1/2, and 1/2 for rounding.
  EXPECT_EQ(drawn->contract.bounds.smooth.constant, 3.5F + 0x1p-20F);
  c.attributes[0].interpolation = cases::Interpolation::noperspective;
  const auto refused = (*backend)->draw(c);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().failure, Failure::unsupported);
}

TEST(Exec, PromisesNothingAboutWhatAProgramDoesNotGive) {
  const auto coverage = program("triangle");
  ASSERT_TRUE(coverage) << to_string(coverage.error());
  EXPECT_THAT((*coverage)->about().description, HasSubstr("gives no depth and no attributes"));
  const auto drawn = (*coverage)->draw(two_triangles());
  ASSERT_TRUE(drawn) << to_string(drawn.error());
  EXPECT_TRUE(std::isnan(drawn->fragments.depth[0]));
  EXPECT_TRUE(std::isnan(drawn->fragments.attributes[0]));
  EXPECT_EQ(drawn->fragments.attributes[1], 1);  // flat: a copy, which the triangle decides
  EXPECT_GE(drawn->contract.bounds.smooth.constant, 0x1p24F);
  EXPECT_GE(drawn->contract.bounds.depth.constant, 0x1p24F);

  const auto depth = program("depth");
  ASSERT_TRUE(depth);
  const auto with_depth = (*depth)->draw(two_triangles());
  ASSERT_TRUE(with_depth);
  EXPECT_EQ(with_depth->fragments.depth[0], 0.25F);
  EXPECT_EQ(with_depth->contract.bounds.depth.constant, 0.5F);
}

TEST(Exec, IsNotAskedForCasesBeyondItsLimits) {
  const auto backend = program("bounded");
  ASSERT_TRUE(backend) << to_string(backend.error());
  const auto drawn = (*backend)->draw(two_triangles());
  ASSERT_FALSE(drawn);
  EXPECT_EQ(drawn.error().failure, Failure::unsupported);
  EXPECT_THAT(to_string(drawn.error()), HasSubstr("its limits exclude"));
}

// Kills: a program from before the protocol had these, asked for them.
TEST(Exec, IsAskedForBiasAndUnormOnlyIfItDrawsThem) {
  using cases::Feature;
  const auto lacked = [](const std::string& members) {
    const auto hello = parse_hello(R"({"protocol": 1, "name": "it")" + members + "}");
    EXPECT_TRUE(hello) << to_string(hello.error());
    return hello ? hello->limits.lacks : std::vector<Feature>();
  };
  EXPECT_THAT(lacked(""), ElementsAre(Feature::depth_bias, Feature::unorm_depth));
  EXPECT_THAT(lacked(R"(, "draws": ["unorm_depth"])"), ElementsAre(Feature::depth_bias));
  EXPECT_THAT(lacked(R"(, "draws": ["unorm_depth", "depth_bias"])"), testing::IsEmpty());
  EXPECT_THAT(lacked(R"(, "limits": {"lacks": ["scissor", "depth_bias"]})"),
              ElementsAre(Feature::depth_bias, Feature::unorm_depth, Feature::scissor));
  EXPECT_THAT(lacked(R"(, "gives": "barycentrics", "draws": ["depth_bias", "unorm_depth"])"),
              ElementsAre(Feature::noperspective, Feature::center, Feature::centroid));
  EXPECT_FALSE(parse_hello(R"({"protocol": 1, "name": "it", "draws": ["colours"]})"));
}

TEST(Exec, IsToldBiasAndFormat) {
  cases::Case c = two_triangles();
  const std::string plain = draw_message(c, cases::contract_of(c), 0).header;
  EXPECT_THAT(plain, HasSubstr(R"("bias_clamp":0.0,"bias_constant":0.0,"bias_slope":0.0)"));
  EXPECT_THAT(plain, HasSubstr(R"("depth_bits":0)"));
  c.depth_bias = {-3, 0.5F, 0x1p-10F};
  c.depth_format = cases::DepthFormat::unorm24;
  const std::string header = draw_message(c, cases::contract_of(c), 0).header;
  EXPECT_THAT(header, HasSubstr(R"("bias_constant":-3.0)"));
  EXPECT_THAT(header, HasSubstr(R"("bias_slope":0.5)"));
  EXPECT_THAT(header, HasSubstr(R"("bias_clamp":0.0009765625)"));
  EXPECT_THAT(header, HasSubstr(R"("depth_bits":24)"));
}

TEST(Exec, IsToldWhatVerticesAreJoinedTo) {
  cases::Case c = two_triangles();
  const std::string plain = draw_message(c, cases::contract_of(c), 0).header;
  EXPECT_THAT(plain, HasSubstr(R"("primitive":"triangles")"));
  c.primitive = cases::Primitive::lines;
  c.line_mode = cases::LineMode::bresenham;
  c.line_width = 2.5F;
  c.point_size = 7;
  const std::string header = draw_message(c, cases::contract_of(c), 0).header;
  EXPECT_THAT(header, HasSubstr(R"("primitive":"lines")"));
  EXPECT_THAT(header, HasSubstr(R"("line_mode":"bresenham","line_width":2.5)"));
  EXPECT_THAT(header, HasSubstr(R"("point_size":7.0)"));

  const auto hello = parse_hello(R"({"protocol": 1, "name": "it"})");
  EXPECT_FALSE(hello->limits.draws(cases::Primitive::lines));
  const auto more = parse_hello(
      R"({"protocol": 1, "name": "it", "limits": {"primitives": ["triangles", "lines"]}})");
  EXPECT_TRUE(more->limits.draws(cases::Primitive::lines));
  EXPECT_FALSE(more->limits.draws(cases::Primitive::points));
}

/// A way of program.py to go wrong.
struct Way {
  std::string name;
  std::string message;
  Failure failure = Failure::crash;
};
void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

class WrongHello : public testing::TestWithParam<Way> {};

TEST_P(WrongHello, IsRefusedWithItsReason) {
  const auto backend = program(GetParam().name, GetParam().name == "silent-hello" ? 1 : 30);
  ASSERT_FALSE(backend);
  EXPECT_EQ(backend.error().failure, Failure::unavailable);
  EXPECT_THAT(to_string(backend.error()), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongHello,
    testing::Values(Way{"exits-at-once",
                        "its program ended with exit code 4 while starting; its last output: "
                        "no such module"},
                    Way{"silent-hello", "did not answer within 1 s (--timeout) while starting"},
                    Way{"no-json", "its first line: 1:1"}, Way{"no-json", "it wrote \"Hello!\""},
                    Way{"other-protocol", "/protocol: must be 1"}, Way{"unknown-key", "colour"},
                    Way{"no-name", "name"}, Way{"bad-contract", "/contract"},
                    Way{"bad-limits", "/limits"},
                    Way{"endless-hello", "a line of more than 65536 bytes"}),
    [](const auto& tested) {
      std::string name = tested.param.name + std::to_string(tested.index);
      std::erase(name, '-');
      return name;
    });

class WrongAnswer : public testing::TestWithParam<Way> {};

// The first triangle is answered rightly, the second is not. After a crash, the next case gets a
// new program. (A process that did not answer is replaced as a whole: isolation_test.cpp.)
TEST_P(WrongAnswer, FailsItsCaseOnly) {
  const auto backend = program(GetParam().name, GetParam().failure == Failure::hang ? 3 : 30);
  ASSERT_TRUE(backend) << to_string(backend.error());
  const auto drawn = (*backend)->draw(two_triangles());
  ASSERT_FALSE(drawn);
  EXPECT_EQ(drawn.error().failure, GetParam().failure) << to_string(drawn.error());
  EXPECT_THAT(to_string(drawn.error()), HasSubstr(GetParam().message));
  EXPECT_FALSE((*backend)->is_lost());

  if (GetParam().failure != Failure::crash) return;
  // Without the triangle that is answered wrongly.
  cases::Case one = two_triangles();
  one.triangles.pop_back();
  const auto next = (*backend)->draw(one);
  EXPECT_TRUE(next) << to_string(next.error());
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongAnswer,
    testing::Values(
        Way{"segfault",
            "its program was killed by signal Segmentation fault while drawing; its "
            "last output: last words"},
        Way{"exit", "its program ended with exit code 3 while drawing"},
        Way{"silent", "did not answer within 3 s (--timeout) while drawing", Failure::hang},
        Way{"garbage", "it wrote \"triangle 0 is drawn\""}, Way{"list", "it wrote \"[1, 2]\""},
        Way{"endless-line", "a line of more than 65536 bytes"},
        Way{"truncated", "its answer ends after 5 of 64 bytes"},
        Way{"closes-output", "its program closed its standard input or output while drawing"},
        Way{"oversized", "its answer has 1000000000000000 bytes"},
        Way{"too-few-bytes", "its answer has 60 bytes; 2 x 2 pixels of 1 samples have 64"},
        Way{"outside", "its answer has an invalid rectangle: x from 1 to 1000"},
        Way{"turned-round", "its answer has an invalid rectangle: x from 3 to 1"},
        Way{"unknown-status", "/status"},
        Way{"wrong-triangle", "its answer shows triangle 7 at pixel 1, 1", Failure::refused},
        Way{"unsupported", "it answered unsupported: not today", Failure::unsupported},
        Way{"failed", "it answered failed: no room", Failure::refused}),
    [](const auto& tested) {
      std::string name = tested.param.name;
      std::erase(name, '-');
      return name;
    });

TEST(Exec, NoticesWhatNobodyAskedFor) {
  const auto backend = program("says-more");
  ASSERT_TRUE(backend);
  cases::Case three = two_triangles();
  three.triangles.push_back({0, 1, 3});
  const auto drawn = (*backend)->draw(three);
  ASSERT_FALSE(drawn);
  EXPECT_THAT(to_string(drawn.error()), HasSubstr("it wrote more than its answer"));
}

TEST(Exec, NoticesAnAnswerBeforeTheQuestion) {
  const auto backend = program("answers-first", 30);
  ASSERT_TRUE(backend) << to_string(backend.error());
  const auto drawn = (*backend)->draw(two_triangles());
  ASSERT_FALSE(drawn);
  EXPECT_EQ(drawn.error().failure, Failure::crash);
}

TEST(Exec, GivesUpAfterManyCrashesInARow) {
  const auto backend = program("garbage");
  ASSERT_TRUE(backend);
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE((*backend)->is_lost()) << i;
    EXPECT_FALSE((*backend)->draw(two_triangles()));
  }
  ASSERT_TRUE((*backend)->is_lost());
  EXPECT_THAT((*backend)->is_lost()->reason, HasSubstr("not drawn after 20 crashes in a row"));
}

// AddressSanitizer has terabytes of memory, to which a worker's limit adds.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool kHasLimitOfMemory = false;
#else
constexpr bool kHasLimitOfMemory = true;
#endif
#else
constexpr bool kHasLimitOfMemory = true;
#endif

TEST(Exec, LimitsMemory) {
  if (!kHasLimitOfMemory) GTEST_SKIP() << "under AddressSanitizer";
  const auto hungry = program("much-memory");
  ASSERT_TRUE(hungry);
  const auto crashed = (*hungry)->draw(two_triangles());
  ASSERT_FALSE(crashed);
  EXPECT_THAT(to_string(crashed.error()), HasSubstr("MemoryError"));
}

TEST(Exec, LimitsFilesUnlessToldOtherwise) {
  const TemporaryFolder folder;
  const std::string where = "writes-files " + folder.path();
  const auto confined = program(where);
  ASSERT_TRUE(confined) << to_string(confined.error());
  const auto refused = (*confined)->draw(two_triangles());
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("it answered failed: "));
  EXPECT_FALSE(std::filesystem::exists(folder.path("written")));

  const auto free = program(where, 20, "--no-sandbox ");
  ASSERT_TRUE(free) << to_string(free.error());
  EXPECT_THAT((*free)->about().description, HasSubstr("runs without a sandbox"));
  EXPECT_TRUE((*free)->draw(two_triangles()));
  EXPECT_TRUE(std::filesystem::exists(folder.path("written")));
}

TEST(Exec, SplitsItsCommandAsAShellDoesAndRunsNothing) {
  const auto reason = [](const std::string& specification) {
    const auto made = make_backend(specification);
    return made ? std::string("made") : to_string(made.error());
  };
  EXPECT_THAT(reason("exec:"), HasSubstr("names no command"));
  EXPECT_THAT(reason("exec:--no-sandbox"), HasSubstr("names no command"));
  EXPECT_THAT(reason("exec:echo 'x"), HasSubstr("has a quote that does not end"));
  EXPECT_THAT(reason("exec:echo $(touch /tmp/x)"), HasSubstr("has a command within it"));
  EXPECT_THAT(reason("exec:a | b"), HasSubstr("needs quotes around one of |"));
  EXPECT_THAT(reason("exec:/no/such/program"), HasSubstr("cannot be started"));
  EXPECT_THAT(reason("exec:printf '%s\\n' \"two  spaces\""), HasSubstr("it wrote \"two  spaces\""));
}

}  // namespace
}  // namespace rastercheck::backends::exec_test
