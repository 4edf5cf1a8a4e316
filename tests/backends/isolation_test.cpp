#include "backends/isolation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case_reader.h"
#include "tests/backends/assembled_cases.h"
#include "tests/temporary_folder.h"

namespace rastercheck::backends::isolation_test {
namespace {

using testing::HasSubstr;

Isolation isolation() {
  Isolation isolation;
  isolation.command = {RASTERCHECK_PROGRAM, "worker"};
  return isolation;
}

/// A process that runs a shell script. The script gets the worker's arguments.
Isolation script(const std::string& text) {
  Isolation isolation;
  isolation.command = {"/bin/sh", "-c", text, "worker"};
  isolation.timeout = std::chrono::milliseconds(300);
  return isolation;
}

std::vector<cases::Case> corpus() {
  std::vector<cases::Case> all;
  for (const auto& entry :
       std::filesystem::directory_iterator(RASTERCHECK_SOURCE_DIR "/cases/corpus")) {
    const Result<cases::Case> c = cases::read_case(entry.path().string());
    if (c && !c->camera) all.push_back(*c);
  }
  return all;
}

TEST(Isolation, DrawsTheSameBitsAndPromisesTheSame) {
  const auto direct = make_backend("cpu");
  const auto isolated = make_isolated_backend("cpu", isolation());
  ASSERT_TRUE(direct);
  ASSERT_TRUE(isolated) << to_string(isolated.error());
  std::size_t fragments = 0;
  for (const cases::Case& c : corpus()) {
    EXPECT_EQ((*isolated)->contract(c), (*direct)->contract(c)) << c.name;
    const auto expected = (*direct)->draw(c);
    const auto drawn = (*isolated)->draw(c);
    ASSERT_EQ(drawn.has_value(), expected.has_value()) << c.name;
    if (!drawn) continue;
    EXPECT_EQ(drawn->contract, expected->contract) << c.name;
    EXPECT_EQ(drawn->fragments.triangle, expected->fragments.triangle) << c.name;
    EXPECT_EQ(drawn->fragments.x, expected->fragments.x) << c.name;
    EXPECT_EQ(drawn->fragments.y, expected->fragments.y) << c.name;
    EXPECT_EQ(drawn->fragments.sample, expected->fragments.sample) << c.name;
    EXPECT_EQ(drawn->fragments.depth, expected->fragments.depth) << c.name;
    EXPECT_EQ(drawn->fragments.attributes, expected->fragments.attributes) << c.name;
    fragments += drawn->fragments.size();
  }
  EXPECT_GT(fragments, 8000);
}

TEST(Isolation, AssemblesStripsAndFans) {
  const auto isolated = make_isolated_backend("cpu", isolation()).value();
  expect_strips_and_fans(*isolated, cases::Rules::opengl);
  expect_strips_of_lines(*isolated, cases::Rules::vulkan);
  cases::Case large = case_of_corners(cases::Rules::vulkan);  // an answer longer than any contract
  large.framebuffer = {128, 128, 1};
  large.viewport = {0, 0, 128, 128, 0, 1};
  expect_assembled(*isolated, large, cases::Topology::strip, {0, 1, 2, 3}, {{0, 1, 2}, {1, 3, 2}});
  const auto method = make_isolated_backend("method:rational-linear", isolation()).value();
  EXPECT_EQ(method->assembler(), nullptr);
}

TEST(Isolation, AnswersOcclusionQueriesAlike) {
  const auto direct = make_backend("cpu").value();
  const auto isolated = make_isolated_backend("cpu", isolation()).value();
  ASSERT_NE(isolated->occlusion_culler(), nullptr);
  int occluded = 0;
  int visible = 0;
  for (const cases::Case& c : corpus()) {
    if (c.triangles.empty()) continue;
    const std::size_t occluders = c.triangles.size() - 1;
    const auto expected = direct->occlusion_culler()->is_occluded(c, occluders);
    const auto answer = isolated->occlusion_culler()->is_occluded(c, occluders);
    ASSERT_EQ(answer.has_value(), expected.has_value()) << c.name;
    if (!answer) continue;
    EXPECT_EQ(*answer, *expected) << c.name;
    ++(*answer ? occluded : visible);
  }
  EXPECT_GT(occluded, 5);
  EXPECT_GT(visible, 20);
  const auto method = make_isolated_backend("method:rational-linear", isolation()).value();
  EXPECT_EQ(method->occlusion_culler(), nullptr);
}

TEST(Isolation, DrawsPicturesAlike) {
  const auto direct = make_backend("cpu").value();
  const auto isolated = make_isolated_backend("cpu", isolation()).value();
  ASSERT_NE(isolated->picture_drawer(), nullptr);
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::always;
  pipeline.blend = cases::Blend::additive;
  int drawn = 0;
  for (const cases::Case& c : corpus()) {
    const auto expected = direct->picture_drawer()->draw_picture(c, pipeline);
    const auto picture = isolated->picture_drawer()->draw_picture(c, pipeline);
    ASSERT_EQ(picture.has_value(), expected.has_value()) << c.name;
    if (!picture) continue;
    EXPECT_EQ(picture->size, expected->size) << c.name;
    EXPECT_EQ(picture->color, expected->color) << c.name;
    EXPECT_EQ(picture->depth, expected->depth) << c.name;
    ++drawn;
  }
  EXPECT_GT(drawn, 20);
  cases::Case large = corpus().front();  // an answer longer than any contract
  large.framebuffer = {512, 512, 1};
  EXPECT_TRUE(isolated->picture_drawer()->draw_picture(large, pipeline));
  const auto method = make_isolated_backend("method:rational-linear", isolation()).value();
  EXPECT_EQ(method->picture_drawer(), nullptr);
}

TEST(Isolation, HasTheBackendsOwnErrors) {
  const auto none = make_isolated_backend("cpu:magic=1", isolation());
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().failure, Failure::refused);
  EXPECT_THAT(to_string(none.error()), HasSubstr("unknown option 'magic=1'"));
}

TEST(Isolation, TellsHowAProcessEndedAndWhatItSaid) {
  const auto killed =
      make_isolated_backend("some", script("echo out; echo words >&2; kill -11 $$"));
  ASSERT_FALSE(killed);
  EXPECT_EQ(killed.error().failure, Failure::unavailable);
  // Standard output belongs to the channel, so only text on standard error is heard.
  EXPECT_EQ(to_string(killed.error()),
            "some: its process was killed by signal Segmentation fault while starting; its last "
            "output: words");
  const auto ended = make_isolated_backend("some", script("exit 3"));
  ASSERT_FALSE(ended);
  EXPECT_EQ(to_string(ended.error()), "some: its process ended with exit code 3 while starting");
}

TEST(Isolation, WaitsNoLongerThanItMay) {
  const auto hung = make_isolated_backend("some", script("sleep 1000; true"));
  ASSERT_FALSE(hung);
  EXPECT_THAT(to_string(hung.error()),
              HasSubstr("did not answer within 0.3 s (--timeout) while starting"));
}

// Kills: a pipe that nobody reads, whose writer waits forever.
TEST(Isolation, HearsAProcessThatTalksALot) {
  const auto ended = make_isolated_backend(
      "some", script("head -c 1000000 /dev/zero | tr '\\0' 'x' >&2; echo; echo end >&2; exit 1"));
  ASSERT_FALSE(ended);
  EXPECT_THAT(to_string(ended.error()), HasSubstr("ended with exit code 1"));
  EXPECT_THAT(to_string(ended.error()), testing::EndsWith("xend"));
}

/// A triangle over the whole framebuffer of n × n pixels.
cases::Case wide_case(int n) {
  cases::Case c;
  c.framebuffer = {n, n, 1};
  c.viewport.width = static_cast<float>(n);
  c.viewport.height = static_cast<float>(n);
  c.positions = {{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
  c.triangles = {{0, 1, 2}};
  return c;
}

/// Makes processes that a test can end. Each process writes its number to a file. A new process
/// ends by itself as long as a certain file exists.
class Mortal {
 public:
  Isolation isolation() const {
    Isolation isolation;
    isolation.command = {"/bin/sh", "-c",
                         "test -e " + folder_.path("no-more") + " && exit 5; echo $$ > " +
                             folder_.path("number") +
                             "; exec " RASTERCHECK_PROGRAM " worker \"$@\"",
                         "worker"};
    return isolation;
  }
  void kill() const { ::kill(std::stoi(folder_.content("number")), SIGKILL); }
  void forbid() const { folder_.put("no-more", ""); }
  void allow() const { std::filesystem::remove(folder_.path("no-more")); }

 private:
  TemporaryFolder folder_;
};

TEST(Isolation, StartsAnewAfterACrash) {
  const Mortal mortal;
  const auto backend = make_isolated_backend("cpu", mortal.isolation());
  ASSERT_TRUE(backend) << to_string(backend.error());
  for (int i = 0; i < 3; ++i) {
    const auto drawn = (*backend)->draw(wide_case(16));
    ASSERT_TRUE(drawn) << to_string(drawn.error());
    EXPECT_EQ(drawn->fragments.size(), 256);
    mortal.kill();
    const auto lost = (*backend)->draw(wide_case(16));
    ASSERT_FALSE(lost);
    EXPECT_EQ(lost.error().failure, Failure::crash);
    // The process may have taken a moment to end.
    EXPECT_THAT(to_string(lost.error()),
                testing::StartsWith("cpu: its process was killed by signal Killed "));
    EXPECT_FALSE((*backend)->is_lost());
  }
}

TEST(Isolation, AsksANewProcessForItsContract) {
  const Mortal mortal;
  const auto backend = make_isolated_backend("cpu", mortal.isolation());
  ASSERT_TRUE(backend) << to_string(backend.error());
  mortal.kill();
  cases::Case c = wide_case(16);
  c.coverage = cases::Snapping{4, cases::Rounding::nearest_even, 0};
  EXPECT_EQ((*backend)->contract(c), (*make_backend("cpu"))->contract(c));
  EXPECT_TRUE((*backend)->draw(c));
}

// Kills: blaming the next case, whichever that is.
TEST(Isolation, FailsOnlyTheCaseWhoseContractFailed) {
  const Mortal mortal;
  const auto backend = make_isolated_backend("cpu", mortal.isolation());
  ASSERT_TRUE(backend) << to_string(backend.error());
  for (const bool is_same : {true, false}) {
    mortal.kill();
    mortal.forbid();
    (*backend)->contract(wide_case(is_same ? 16 : 17));
    mortal.allow();
    EXPECT_EQ((*backend)->draw(wide_case(16)).has_value(), !is_same);
    EXPECT_TRUE((*backend)->draw(wide_case(16)));
  }
}

TEST(Isolation, GivesUpWhatComesToNothingAgainAndAgain) {
  const Mortal mortal;
  const auto backend = make_isolated_backend("cpu", mortal.isolation());
  ASSERT_TRUE(backend) << to_string(backend.error());
  mortal.kill();
  mortal.forbid();
  int crashes = 0;
  for (; !(*backend)->is_lost() && crashes < 100; ++crashes) {
    EXPECT_FALSE((*backend)->draw(wide_case(16)));
  }
  EXPECT_EQ(crashes, 20);
  EXPECT_THAT(to_string(*(*backend)->is_lost()),
              HasSubstr("cpu: not drawn after 20 crashes in a row and 0 hangs; the last one: its "
                        "process ended with exit code 5 while starting"));
  // The backend still tries if it is asked again, and is then no longer given up.
  mortal.allow();
  EXPECT_TRUE((*backend)->draw(wide_case(16)));
  EXPECT_FALSE((*backend)->is_lost());
}

TEST(Isolation, OfADrawingThatTakesTooLongIsAHang) {
  Isolation short_of_time = isolation();
  // Enough time for a busy machine to start the process.
  short_of_time.timeout = std::chrono::seconds(2);
  const auto backend = make_isolated_backend("cpu", short_of_time);
  ASSERT_TRUE(backend) << to_string(backend.error());
  // 10^5 triangles of 10^6 pixels each, which would take days.
  cases::Case c = wide_case(1024);
  c.triangles.resize(100000, {0, 1, 2});
  const auto hung = (*backend)->draw(c);
  ASSERT_FALSE(hung);
  EXPECT_EQ(hung.error().failure, Failure::hang);
  EXPECT_THAT(to_string(hung.error()),
              HasSubstr("did not answer within 2 s (--timeout) while drawing"));
}

}  // namespace
}  // namespace rastercheck::backends::isolation_test
