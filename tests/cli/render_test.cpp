#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::render_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(Render, PrintsTheContractsJson) {
  const Outcome outcome = run_program(
      {"render", "--json", "--backend", "cpu", source_file("cases/corpus/through-samples.json")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json document = json::parse(outcome.out);
  EXPECT_EQ(document.at("format"), "rastercheck-fragments");
  EXPECT_EQ(document.at("version"), 1);
  EXPECT_EQ(document.at("backend"), "cpu");
  EXPECT_EQ(document.at("fragments").size(), 25U);
  // The square's first corner lies exactly on the sample of pixel (1, 1).
  const json first = {
      {"triangle", 0},           {"x", 1}, {"y", 1}, {"sample", 0}, {"depth", "0x0p+0"},
      {"attributes", {"0x0p+0"}}};
  EXPECT_EQ(document.at("fragments").at(0), first);
}

TEST(Render, PrintsATableForPeople) {
  const Outcome outcome = run_program({"render", source_file("cases/corpus/camera.json")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("35 fragments"));
}

TEST(Render, RefusesABackendThatIsNotThere) {
  const Outcome outcome =
      run_program({"render", "--backend", "gpu", source_file("cases/corpus/camera.json")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("unknown backend; backends: cpu"));
}

TEST(Render, ThinksOfTheBackendThatWasMeant) {
  const Outcome outcome =
      run_program({"render", "--backend", "opengl", source_file("cases/corpus/camera.json")});
  EXPECT_THAT(outcome.err, HasSubstr("; did you mean gl?"));
}

// Kills: overwriting a case with its own picture; a PNG written under the name of another format.
TEST(Render, WritesNoPictureOverItsCaseNorUnderAnotherFormatsName) {
  const TemporaryFolder folder;
  const std::string own = folder.put("own.png", square_case());
  const Outcome over = run_program({"render", own, "--png", own});
  EXPECT_TRUE(is_failure(over, 2)) << over;
  EXPECT_THAT(over.err, HasSubstr("own.png: is the input and would be overwritten"));
  EXPECT_EQ(folder.content("own.png"), square_case());
  const Outcome other = run_program({"render", own, "--png", folder.path("x.jpg")});
  EXPECT_TRUE(is_failure(other, 2)) << other;
  EXPECT_THAT(other.err, HasSubstr("x.jpg: must end in .png, because the picture is a PNG"));
  EXPECT_EQ(folder.files(), std::vector<std::string>{"own.png"});
}

TEST(Render, QuietlyPrintsRowsOnly) {
  const Outcome outcome = run_program({"render", "--quiet", "-"}, square_case());
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 64);
}

/// Reads a big-endian number of four bytes.
std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = at; i < at + 4; ++i) {
    number = number << 8U | static_cast<unsigned char>(bytes.at(i));
  }
  return number;
}

TEST(Render, WritesAPicture) {
  const TemporaryFolder folder;
  const std::string file = folder.path("camera.png");
  const Outcome outcome =
      run_program({"render", "--png", file, source_file("cases/corpus/camera.json")});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(outcome.out, "");
  const std::string png = folder.content("camera.png");
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const json c = json::parse(std::ifstream(source_file("cases/corpus/camera.json")));
  EXPECT_EQ(number_at(png, 16), c.at("framebuffer").at("width"));
  EXPECT_EQ(number_at(png, 20), c.at("framebuffer").at("height"));
  // No half-written file is left beside it.
  EXPECT_THAT(folder.files(), testing::ElementsAre("camera.png"));
}

TEST(Render, NamesAPictureThatCannotBeWritten) {
  const TemporaryFolder folder;
  const std::string file = folder.path("none/x.png");
  const Outcome outcome = run_program({"render", "--png", file, "-"}, square_case());
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr(file + ": cannot be written"));
}

TEST(Render, TellsABackendThatCannotRunHereFromOneThatFails) {
  const auto render = [](const std::string& backend) {
    return run_damaged_program({"render", "--backend", backend, "-"}, square_case());
  };
  const Outcome absent = render("damaged:absent");
  EXPECT_TRUE(is_failure(absent, 4)) << absent;
  const Outcome refused = render("damaged:refuses");
  EXPECT_TRUE(is_failure(refused, 2)) << refused;
  EXPECT_EQ(refused.err, "rastercheck: -: out of memory\n");
}

TEST(Render, WantsAllForManySamples) {
  std::string text = square_case();
  const std::string from = R"({"width": 8, "height": 8}, "rules")";
  text.replace(text.find(from), from.size(), R"({"width": 16384, "height": 8192}, "rules")");
  const Outcome refused = run_program({"render", "-"}, text);
  EXPECT_TRUE(is_failure(refused, 2)) << refused;
  EXPECT_THAT(refused.err,
              HasSubstr("-: /framebuffer: 134217728 samples exceed the limit of 2^26"));
  const Outcome all = run_program({"render", "--all", "--json", "-"}, text);
  EXPECT_EQ(all.code, 0);
  EXPECT_EQ(json::parse(all.out).at("fragments").size(), 64U);
}

TEST(Render, RefusesPositionsBeyondFloat32) {
  const std::string camera =
      R"("camera": {"model": ["0x1p+127",0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],
                    "view": [4,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}, )";
  const Outcome outcome = run_program({"render", "-"}, square_case(camera));
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("-: /vertices/0/position: its clip x overflows float32"));
}

}  // namespace
}  // namespace rastercheck::cli::render_test
