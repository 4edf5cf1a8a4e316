// `rastercheck judge` and `mask`, and the pictures of `render --picture`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cases/files.h"
#include "cases/picture_reader.h"
#include "cases/picture_writer.h"
#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::judge_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The square case in a folder, and a picture of it by `cpu`.
class Pictures {
 public:
  Pictures() : square_(folder_.put("square.json", square_case())) {}

  const std::string& square() const { return square_; }
  std::string path(const std::string& name) const { return folder_.path(name); }

  /// Draws the square into a picture file and returns the file's name.
  std::string draw(const std::string& name, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"render", square_, "--picture", path(name)};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_program(words);
    EXPECT_EQ(outcome.code, 0) << outcome;
    EXPECT_EQ(outcome.out, "");
    return path(name);
  }

  Outcome judge(const std::string& picture, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"judge", square_, picture};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }

  /// Changes one number of a picture file.
  void spoil(const std::string& file, std::size_t index, float value) const {
    Result<cases::PictureFile> picture = cases::read_picture(file, cases::ArrayOrder::hwc);
    ASSERT_TRUE(picture.has_value());
    picture->values.at(index) = value;
    ASSERT_TRUE(cases::write_picture(*picture, file).has_value());
  }

 private:
  TemporaryFolder folder_;
  std::string square_;
};

// Kills: lists that swallow the files after them.
TEST(Judge, TakesListsBeforeFiles) {
  const Pictures pictures;
  const std::string picture = pictures.draw("a.npy", {"--channels", "R=x,G=one"});
  const Outcome outcome = run_program(
      {"judge", "--background", "0,0", "--channels", "R=x,G=one", pictures.square(), picture});
  EXPECT_EQ(outcome.code, 0) << outcome;
}

TEST(Judge, CallsPicturesOfEveryFormatRight) {
  const Pictures pictures;
  const std::vector<std::string> scaled{"--channels", "Y=one", "--storage", "unorm8"};
  for (const std::string& picture :
       {pictures.draw("a.exr"), pictures.draw("a.npy"),
        pictures.draw("a.pfm", {"--channels", "Y=x"}), pictures.draw("a.png", scaled)}) {
    const std::vector<std::string> layout = picture.ends_with(".png") ? scaled
                                            : picture.ends_with(".pfm")
                                                ? std::vector<std::string>{"--channels", "Y=x"}
                                                : std::vector<std::string>{};
    const Outcome outcome = pictures.judge(picture, layout);
    EXPECT_EQ(outcome.code, 0) << outcome;
    EXPECT_THAT(outcome.out, HasSubstr("Right: all 64 pixels.")) << outcome;
  }
}

// Pixel (0, 0) shows the window x of its centre: 0.5.
TEST(Judge, SaysWhichPixelIsWrongAndByHowMuch) {
  const Pictures pictures;
  const std::string picture = pictures.draw("a.npy");
  pictures.spoil(picture, 0, 0.75F);
  const Outcome outcome = pictures.judge(picture, {"--mask", pictures.path("mask.png")});
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("Wrong: 1 of 64 pixels (1.56%)."));
  EXPECT_THAT(outcome.out, HasSubstr("R 0.75, not 0.499999"));
  const auto mask = cases::read_picture(pictures.path("mask.png"), cases::ArrayOrder::hwc);
  ASSERT_TRUE(mask.has_value());
  EXPECT_NE(mask->values[0], mask->values[3]);
  EXPECT_EQ(mask->values[3], mask->values[6]);

  const Outcome as_json = pictures.judge(picture, {"--json"});
  const json judged = json::parse(as_json.out);
  EXPECT_EQ(judged.at("format"), "rastercheck-judged-picture");
  EXPECT_EQ(judged.at("wrong"), 1);
  EXPECT_EQ(judged.at("worst").at(0).at("x"), 0);
  EXPECT_EQ(judged.at("worst").at(0).at("row"), 0);
  EXPECT_EQ(judged.at("worst").at(0).at("channels").at(0).at("stored"), "0x1.8p-1");
}

TEST(Judge, WritesTheReport) {
  const Pictures pictures;
  const std::string picture = pictures.draw("a.npy");
  pictures.spoil(picture, 0, 0.75F);
  const std::string page = pictures.path("judged.html");
  const Outcome outcome = pictures.judge(picture, {"--html", page, "--promised-by", "cpu"});
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("Wrong: 1 of 64 pixels"));
  const std::string text = cases::read_text(page).value();
  EXPECT_THAT(text, HasSubstr("Wrong: 1 of 64 pixels"));
  EXPECT_THAT(text, HasSubstr("what cpu promises"));
  // The command of the page works, and explains the pixel's window position.
  const std::string command = " --backend cpu --pixel 0,0 --triangle ";
  const std::size_t at = text.find(command);
  ASSERT_NE(at, std::string::npos);
  const Outcome explained =
      run_program({"explain", pictures.square(), "--backend", "cpu", "--pixel", "0,0", "--triangle",
                   text.substr(at + command.size(), 1)});
  EXPECT_EQ(explained.code, 0) << explained;
  EXPECT_TRUE(is_failure(pictures.judge(picture, {"--html", picture}), 2));
}

TEST(Judge, JudgesByABackendsPromiseOrAContractFile) {
  const Pictures pictures;
  const TemporaryFolder folder;
  const std::string picture = pictures.draw("a.npy");
  pictures.spoil(picture, 0, 0.5F + 0x1p-18F);  // four scale ULP of values up to 8
  EXPECT_EQ(pictures.judge(picture).code, 1);
  const std::string contract = folder.put(
      "wide.json",
      R"({"format": "rastercheck-contract", "version": 1, "bounds": {"smooth": {"constant": 8}}})");
  EXPECT_EQ(pictures.judge(picture, {"--contract", contract}).code, 0);
  EXPECT_EQ(pictures.judge(picture, {"--promised-by", "cpu"}).code, 1);
  EXPECT_TRUE(is_failure(pictures.judge(picture, {"--promised-by", "gpu"}), 2));
}

TEST(Judge, RefusesInOneLineWhatItCannotRead) {
  const Pictures pictures;
  const TemporaryFolder folder;
  const Outcome text = pictures.judge(folder.put("a.png", "no picture"));
  EXPECT_TRUE(is_failure(text, 2)) << text;
  EXPECT_THAT(text.err, HasSubstr("a.png: is not a picture"));
  const Outcome missing = pictures.judge("/nowhere/a.png");
  EXPECT_TRUE(is_failure(missing, 2)) << missing;
  const Outcome channels = pictures.judge(pictures.draw("a.npy"), {"--channels", "R"});
  EXPECT_TRUE(is_failure(channels, 2)) << channels;
  EXPECT_THAT(channels.err, HasSubstr("--channels: R: is not NAME=WHAT, as R=u"));
  const Outcome over =
      pictures.judge(pictures.draw("b.png", {"--storage", "unorm8", "--channels", "Y=one"}),
                     {"--mask", pictures.path("b.png"), "--channels", "Y=one"});
  EXPECT_TRUE(is_failure(over, 2)) << over;
}

TEST(Judge, ReadsTheLayoutOfTheCase) {
  const TemporaryFolder folder;
  const std::string square = folder.put(
      "square.json",
      square_case(R"("picture": {"channels": [{"name": "Y", "shows": "one", "background": 0.5}],
                                 "storage": "unorm8"},)"));
  const std::string picture = folder.path("a.png");
  ASSERT_EQ(run_program({"render", square, "--picture", picture}).code, 0);
  EXPECT_EQ(run_program({"judge", square, picture}).code, 0);
  EXPECT_EQ(run_program({"judge", square, picture, "--storage", "unorm16"}).code, 2);
}

// Half of 0.5 over the background 0.2 (code 51). Straight, 0.25 + 0.1 is code 89 (89.25).
// Premultiplied, the background 0.2 · 0.4 is code 20, and 0.25 + 10/255 is code 74 (73.75). Alpha:
// 0.5 + 0.5 · 0.4 is 178.5.
TEST(Judge, JudgesBlendedAndPremultipliedPictures) {
  const Pictures pictures;
  for (const auto& [alpha, red] :
       {std::pair("straight", 89.0F), std::pair("premultiplied", 74.0F)}) {
    const std::vector<std::string> layout{"--channels",   "Y=0.5,A=0.5", "--storage", "unorm8",
                                          "--background", "0.2,0.4",     "--blend",   "over",
                                          "--alpha",      alpha};
    const std::string picture = pictures.draw(std::string(alpha) + ".png", layout);
    const auto drawn = cases::read_picture(picture, cases::ArrayOrder::hwc);
    ASSERT_TRUE(drawn.has_value());
    EXPECT_EQ(drawn->values[0], red);
    const Outcome right = pictures.judge(picture, layout);
    EXPECT_EQ(right.code, 0) << right;
    EXPECT_THAT(right.out, HasSubstr("Right: all 64 pixels."));
    pictures.spoil(picture, 0, red + 1);
    EXPECT_EQ(pictures.judge(picture, layout).code, 1);
  }
}

TEST(Judge, CountsPixelsOfSeveralBlendedTriangles) {
  const TemporaryFolder folder;
  std::string twice = square_case(
      R"("picture": {"channels": [{"name": "R", "shows": "one"}], "blend": "additive"},)");
  twice.replace(twice.find("[[0, 1, 2]"), 10, "[[0, 1, 2], [0, 1, 2]");
  const std::string file = folder.put("twice.json", twice);
  const std::string picture = folder.path("a.exr");
  ASSERT_EQ(run_program({"render", file, "--picture", picture}).code, 0);
  const Outcome outcome = run_program({"judge", file, picture});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("not judged"));
  EXPECT_THAT(outcome.out, HasSubstr("since several triangles may be blended"));
  const Outcome mask = run_program({"mask", file, "--json"});
  const Outcome as_json = run_program({"judge", file, picture, "--json"});
  EXPECT_GE(json::parse(mask.out).at("layered"), 28);  // half of the 64, without the diagonal
  EXPECT_EQ(json::parse(as_json.out).at("layered"), json::parse(mask.out).at("layered"));
  EXPECT_EQ(json::parse(as_json.out).at("pixels").at("not judged"),
            json::parse(mask.out).at("layered"));
}

TEST(Judge, SaysWhyAlphaIsMissing) {
  const Pictures pictures;
  const std::string picture = pictures.draw("a.exr", {"--channels", "R=x,A=depth"});
  const Outcome none = pictures.judge(picture, {"--channels", "R=x,A=depth", "--blend", "over"});
  EXPECT_TRUE(is_failure(none, 2)) << none;
  EXPECT_THAT(none.err, HasSubstr("a.exr: channel A shows no alpha, which blend over needs"));
  const Outcome mask =
      run_program({"mask", pictures.square(), "--channels", "R=x", "--alpha", "premultiplied"});
  EXPECT_TRUE(is_failure(mask, 2)) << mask;
  EXPECT_THAT(mask.err, HasSubstr("has no channel A, which alpha premultiplied needs"));
  EXPECT_EQ(pictures.judge(picture, {"--blend", "multiply"}).code, 2);
}

TEST(Mask, SaysWhatMayDiffer) {
  const Pictures pictures;
  const Outcome outcome =
      run_program({"mask", pictures.square(), "--storage", "unorm8", "--channels", "R=one", "--png",
                   pictures.path("mask.png"), "--bounds", pictures.path("bounds.exr")});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(outcome.out, "64 pixels must have one value, 0 may differ, 0 must be background.\n");
  const auto bounds = cases::read_picture(pictures.path("bounds.exr"), cases::ArrayOrder::hwc);
  ASSERT_TRUE(bounds.has_value()) << to_string(bounds.error());
  EXPECT_EQ(bounds->channels, (std::vector<std::string>{"lower.R", "upper.R"}));
  EXPECT_EQ(bounds->values[0], 1);
  EXPECT_EQ(bounds->values[1], 1);
  const Outcome as_json = run_program({"mask", pictures.square(), "--json"});
  EXPECT_EQ(json::parse(as_json.out).at("may_differ"), 64);  // floats within half an ULP
}

}  // namespace
}  // namespace rastercheck::cli::judge_test
