// Draws that RenderDoc exported: which numbers are read, which triangles they form, what is
// guessed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/import_process.h"
#include "cases/importer.h"

namespace rastercheck::cases::renderdoc_csv_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kHeader =
    "VTX, IDX, gl_Position.x, gl_Position.y, gl_Position.z, gl_Position.w, uv.x, uv.y\n";

Result<Imported> imported(const std::string& text, const ImportOptions& options = {}) {
  const Importer* importer = importer_of(text);
  if (importer == nullptr) return tl::unexpected(Error{"", "", "is in no known format"});
  EXPECT_EQ(importer->name, "renderdoc-csv");
  return importer->import(text, "folder/draw.csv", options);
}

Case case_of(const std::string& text, const ImportOptions& options = {}) {
  const Result<Imported> read = imported(text, options);
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? read->drawn : Case();
}

std::string error_of(const std::string& text, const ImportOptions& options = {}) {
  const Result<Imported> read = imported(text, options);
  return read ? "no error" : to_string(read.error());
}

/// The rows of vertices 0, 1, …, each at its number.
std::string rows(int count) {
  std::string text = kHeader;
  for (int i = 0; i < count; ++i) {
    const std::string n = std::to_string(i);
    text += n + ", " + n + ", " + n + ".50, -0.25, 0.50, 1.00, " + n + ", 0.1\n";
  }
  return text;
}

// Kills: doubles rounded to float32 in two steps, columns mixed up.
TEST(RenderdocCsv, ReadsPositionsAndAttributes) {
  const Case c = case_of(rows(3));
  EXPECT_EQ(c.name, "draw.csv, from decimals");
  EXPECT_EQ(c.positions,
            (std::vector<ClipVertex>{
                {0.5F, -0.25F, 0.5F, 1}, {1.5F, -0.25F, 0.5F, 1}, {2.5F, -0.25F, 0.5F, 1}}));
  ASSERT_EQ(c.attributes.size(), 2U);
  EXPECT_EQ(c.attributes[0].name, "uv.x");
  EXPECT_EQ(c.attributes[1].name, "uv.y");
  EXPECT_EQ(c.attribute_values,
            (std::vector<float>{0, 0x1.99999ap-4F, 1, 0x1.99999ap-4F, 2, 0x1.99999ap-4F}));
  EXPECT_EQ(c.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  // Halfway between two floats but for the last digit: a double in between would round it down.
  const std::string text = std::string("VTX, IDX, SV_Position.x, SV_Position.y, a\n") +
                           "0, 0, 1.00000017881393432617187499, 1e-46, 1e-40\n" +
                           "1, 1, 1.00000017881393432617187501, -1e-99999, 1\n2, 2, 0, 1, 1\n";
  const Case close = case_of(text);
  EXPECT_EQ(close.positions[0], (ClipVertex{0x1.000002p0F, 0, 0, 1}));
  EXPECT_EQ(close.positions[1].x, 0x1.000004p0F);
  EXPECT_EQ(close.attribute_values[0], 1e-40F);
}

// The form of 2015, with Windows' line ends.
TEST(RenderdocCsv, ReadsTheOlderForm) {
  const Case c = case_of(
      "Vertex,Index,gl_Position 0,gl_Position 1,gl_Position 2,gl_Position 3,color 0\r\n"
      "0,0,-1,0,0,1,0.5\r\n1,1,1,0,0,1,0.25\r\n2,2,0,1,0,2,0\r\n\r\n");
  EXPECT_EQ(c.positions.back(), (ClipVertex{0, 1, 0, 2}));
  EXPECT_EQ(c.attribute_values, (std::vector<float>{0.5F, 0.25F, 0}));
}

// By hand, from the specifications' tables of primitives; IDX says what is shared.
TEST(RenderdocCsv, StripsFollowTheRules) {
  const std::string text = rows(4);
  ImportOptions options;
  options.rules = Rules::vulkan;
  EXPECT_EQ(case_of(text, options).triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
  options.topology = Topology::fan;
  EXPECT_EQ(case_of(text, options).triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
  const std::string more = rows(6) + "6, 65535 Restart, Restart, Restart, Restart\n" +
                           "7, 0, 0.50, -0.25, 0.50, 1.00, 0, 0.1\n" +
                           "8, 1, 1.50, -0.25, 0.50, 1.00, 1, 0.1\n" +
                           "9, 9, 9.50, -0.25, 0.50, 1.00, 1, 0.1\n";
  options.topology = std::nullopt;
  options.rules = Rules::opengl;
  const Result<Imported> read = imported(more, options);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->drawn.triangles,
            (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}, {0, 1, 6}}));
  EXPECT_EQ(read->drawn.positions.size(), 7U);
  EXPECT_THAT(read->notes, Contains(HasSubstr("a strip of triangles, because it has restarts")));
}

TEST(RenderdocCsv, ListsAreGuessedFromTheCount) {
  EXPECT_EQ(case_of(rows(6)).triangles.size(), 2U);
  EXPECT_THAT(imported(rows(6))->notes, Contains(HasSubstr("a list of triangles, because 6")));
  ImportOptions options;
  options.topology = Topology::strip;
  EXPECT_EQ(case_of(rows(6), options).triangles.size(), 4U);
  EXPECT_THAT(imported(rows(6), options)->notes, Not(Contains(HasSubstr("--topology"))));
}

TEST(RenderdocCsv, LeavesOutWhatIsNotFiniteAndSaysSo) {
  std::string text = rows(6);
  text.replace(text.find("4.50"), 4, "nan");
  Result<Imported> read = imported(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->drawn.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(read->drawn.positions.size(), 3U);
  EXPECT_THAT(read->notes, Contains("1 triangle left out: a position is missing, NaN or infinite"));
  text = rows(3);
  text.replace(text.rfind("0.1"), 3, "---");
  read = imported(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->drawn.attributes.size(), 1U);
  EXPECT_THAT(read->notes, Contains("1 column left out: a number is missing, NaN or infinite"));
  EXPECT_THAT(error_of(std::string(kHeader) + "0, 0, ---, ---, ---, ---, ---, ---\n"),
              HasSubstr("has no triangle that could be drawn"));
}

TEST(RenderdocCsv, RulesFollowNamesAndDepths) {
  EXPECT_EQ(case_of(rows(3)).rules, Rules::vulkan);
  const auto of = [](const std::string& name, const std::string& z) {
    return "VTX, IDX, " + name + ".x, " + name + ".y, " + name + ".z, " + name +
           ".w\n0, 0, 0, 0, " + z + ", 1\n1, 1, 5, 0, -9, 1\n2, 2, 0, 5, 0, 1\n";
  };
  EXPECT_EQ(case_of(of("gl_Position", "0")).rules, Rules::vulkan);
  EXPECT_EQ(case_of(of("gl_Position", "-0.5")).rules, Rules::opengl);
  EXPECT_EQ(case_of(of("gl_PerVertex.gl_Position", "-0.5")).rules, Rules::opengl);
  EXPECT_EQ(case_of(of("SV_POSITION", "-0.5")).rules, Rules::d3d);
  EXPECT_EQ(case_of(of("SV_POSITION", "-0.5")).basis, Basis::snapped);
}

TEST(RenderdocCsv, OptionsSetWhatTheFileLacks) {
  ImportOptions options;
  options.width = 40;
  options.height = 30;
  options.samples = 4;
  options.viewport = {1, 2, 30, -20};
  options.rules = Rules::opengl;
  options.topology = Topology::triangles;
  options.cull = Cull::back;
  options.front_face = FrontFace::cw;
  options.flat = {"uv.x"};
  options.noperspective = {"uv"};
  const Result<ImportOptions> copy = import_options_from_json(to_json(options));
  ASSERT_TRUE(copy) << to_string(copy.error());
  const Result<Imported> read = imported(rows(3), *copy);
  ASSERT_TRUE(read);
  EXPECT_THAT(read->notes, ElementsAre());
  const Case& c = read->drawn;
  EXPECT_EQ(c.framebuffer, (FramebufferSize{40, 30, 4}));
  EXPECT_EQ(c.viewport, (Viewport{1, 2, 30, -20, 0, 1}));
  EXPECT_EQ(c.rules, Rules::opengl);
  EXPECT_EQ(c.fill_rule, TieRule::bottom_left);
  EXPECT_EQ(c.cull, Cull::back);
  EXPECT_EQ(c.front_face, FrontFace::cw);
  EXPECT_EQ(c.attributes[0].interpolation, Interpolation::flat);
  EXPECT_EQ(c.attributes[1].interpolation, Interpolation::noperspective);
}

TEST(RenderdocCsv, ClipDistancesAreNoAttributes) {
  const Case c = case_of(
      "VTX, IDX, gl_Position.x, gl_Position.y, gl_ClipDistance[0], gl_ClipDistance[1], "
      "gl_PointSize\n"
      "0, 0, 0, 0, 1, 2, 1\n1, 1, 1, 0, 3, 4, 1\n2, 2, 0, 1, 5, 6, 1\n");
  EXPECT_TRUE(c.attributes.empty());
  EXPECT_EQ(c.clip_distance_count, 2U);
  EXPECT_EQ(c.clip_distances, (std::vector<float>{1, 2, 3, 4, 5, 6}));
}

TEST(RenderdocCsv, NamesWhatIsWrongAndWhere) {
  EXPECT_EQ(error_of(rows(3) + "3, 3, 1\n"),
            "folder/draw.csv: line 5, column 3: has 3 cells where the header has 8");
  std::string text = rows(3);
  text.replace(text.find("1.50"), 4, "1.5x");
  EXPECT_EQ(error_of(text), "folder/draw.csv: line 3, column 3: '1.5x' is no number");
  EXPECT_THAT(error_of("VTX, IDX, position.x, position.y\n0, 0, 1, 1\n"),
              HasSubstr("export the tab VS Out"));
  EXPECT_THAT(error_of("a, b, c\n"), HasSubstr("is in no known format"));
  ImportOptions options;
  options.flat = {"colour"};
  EXPECT_THAT(error_of(rows(3), options), HasSubstr("has no column 'colour'"));
}

// Kills: an answer taken on trust.
TEST(ImportReply, IsReadBackOrRefused) {
  const Result<Imported> read = imported(rows(3));
  ASSERT_TRUE(read);
  const std::string reply = import_to_reply(read);
  const Result<Imported> back = import_from_reply(reply, "draw.csv");
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(back->drawn, read->drawn);
  EXPECT_EQ(back->notes, read->notes);
  const Error error{"draw.csv", "line 1", "bad"};
  EXPECT_EQ(to_string(import_from_reply(import_to_reply(tl::unexpected(error)), "x").error()),
            to_string(error));
  for (const std::string& bad :
       {std::string(), std::string("{\"notes\": []}"), std::string("{\"notes\": []}\n{}"),
        reply.substr(0, reply.size() - 3),
        "{\"notes\": 1}\n" + reply.substr(reply.find('\n') + 1)}) {
    EXPECT_THAT(to_string(import_from_reply(bad, "draw.csv").error()),
                HasSubstr("draw.csv: the import reader's answer: "))
        << bad;
  }
}

}  // namespace
}  // namespace rastercheck::cases::renderdoc_csv_test
