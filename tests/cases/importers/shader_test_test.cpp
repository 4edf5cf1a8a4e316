// Tests of piglit: which numbers are read, what a shader makes of them, which state a draw has, and
// what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/importer.h"

namespace rastercheck::cases::shader_test_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Parts {
  std::string require = "GLSL >= 1.30\n";
  std::string globals = "in vec4 vertex;\nin vec4 data;\nout vec4 colour;\n";
  std::string main = "gl_Position = vertex;\ncolour = data;\n";
  std::string fragment = "in vec4 colour;\nvoid main() { gl_FragColor = colour; }\n";
  std::string data =
      "vertex/float/2 data/float/4\n"
      "-1 -1  1 2 3 4\n 3 -1  5 6 7 8  # a comment\n\n-1 0x40400000  9 10 11 0.1\n";
  std::string test = "draw arrays GL_TRIANGLES 0 3\n";
};

std::string text_of(const Parts& p) {
  return "# A test\n[require]\n" + p.require + "[vertex shader]\n" + p.globals +
         "void main()\n{\n" + p.main + "}\n[fragment shader]\n" + p.fragment + "[vertex data]\n" +
         p.data + "[test]\n" + p.test;
}

Result<Imported> imported(const std::string& text, const ImportOptions& options = {}) {
  const Importer* importer = importer_of(text);
  if (importer == nullptr) return tl::unexpected(Error{"", "", "is in no known format"});
  EXPECT_EQ(importer->name, "shader_test");
  return importer->import(text, "folder/a.shader_test", options);
}
Result<Imported> imported(const Parts& parts) { return imported(text_of(parts)); }

Case case_of(const Parts& parts) {
  const Result<Imported> read = imported(parts);
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? read->drawn : Case();
}

std::vector<std::string> notes_of(const Parts& parts) {
  const Result<Imported> read = imported(parts);
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? read->notes : std::vector<std::string>();
}

std::string error_of(const Parts& parts) {
  const Result<Imported> read = imported(parts);
  return read ? "no error" : to_string(read.error());
}

Parts with_main(const std::string& main) {
  Parts parts;
  parts.main = main;
  return parts;
}
Parts with_test(const std::string& test) {
  Parts parts;
  parts.test = test;
  return parts;
}

// Kills: bits read as an integer, components that are filled with zeros only.
TEST(ShaderTest, ReadsVerticesAsTheRunnerDoes) {
  const Result<Imported> read = imported(Parts());
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_THAT(read->notes, IsEmpty());
  const Case& c = read->drawn;
  EXPECT_EQ(c.name, "a.shader_test");
  EXPECT_EQ(c.rules, Rules::opengl);
  EXPECT_EQ(c.fill_rule, TieRule::bottom_left);
  EXPECT_EQ(c.framebuffer, (FramebufferSize{250, 250, 1}));
  EXPECT_EQ(c.viewport, (Viewport{0, 0, 250, 250, 0, 1}));
  EXPECT_EQ(c.positions, (std::vector<ClipVertex>{{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}}));
  ASSERT_EQ(c.attributes.size(), 4U);
  EXPECT_EQ(c.attributes[1].name, "colour.y");
  EXPECT_EQ(c.attribute_values,
            (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0x1.99999ap-4F}));
  EXPECT_EQ(c.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_FALSE(c.camera);
}

// By hand: of data (1, 2, 3, 4), (5, 6, 7, 8), (9, 10, 11, 0.1).
TEST(ShaderTest, ComputesWhatTheShaderComputes) {
  const Case c = case_of(
      with_main("vec4 moved = vec4(vertex.xy * 2.0, -0.5, 1); // a local\n"
                "gl_Position = moved + vec4(1, 0, 0, 0);\n"
                "colour.xy = data.yx; colour.zw = vec2(-data.x - 1.0, (data[1] + 2.) / 4.0);\n"));
  EXPECT_EQ(c.positions[0], (ClipVertex{-1, -2, -0.5F, 1}));
  EXPECT_EQ(c.positions[1], (ClipVertex{7, -2, -0.5F, 1}));
  ASSERT_EQ(c.attribute_values.size(), 12U);
  EXPECT_EQ((std::vector<float>(c.attribute_values.begin(), c.attribute_values.begin() + 4)),
            (std::vector<float>{2, 1, -2, 1}));
}

TEST(ShaderTest, SaysWhereArithmeticWasRounded) {
  EXPECT_THAT(notes_of(with_main("gl_Position = vertex; colour = data + 1.0;")),
              ElementsAre(HasSubstr("rounded to float32 in 1 vertex")));  // 0.1 + 1
  EXPECT_THAT(notes_of(with_main("gl_Position = vertex; colour = data / 3.0;")),
              ElementsAre(HasSubstr("rounded to float32 in 3 vertices")));
  EXPECT_THAT(notes_of(with_main("gl_Position = vertex; colour = data * 0.5;")), IsEmpty());
}

// Kills: a value taken from before a branch or a call that may have changed it.
TEST(ShaderTest, RefusesWhatItCannotFollow) {
  const auto error = [](const std::string& main) { return error_of(with_main(main)); };
  const std::string place = "folder/a.shader_test: line ";
  EXPECT_EQ(error("gl_Position = vertex;\ncolour = sin(data);\n"),
            place + "11: colour calls sin()");
  EXPECT_EQ(error("gl_Position = vertex; colour = data;\nif (data.x > 0.0) colour = vertex;\n"),
            place + "11: colour may be changed by 'if'");
  EXPECT_EQ(error("colour = data;\nif (data.x > 0.0) return;\ngl_Position = vertex;\n"),
            place + "12: gl_Position may be changed by 'if'");
  EXPECT_THAT(error("gl_Position = vertex; colour = data; change(colour);"),
              HasSubstr("colour may be changed by 'change…'"));
  EXPECT_THAT(error("gl_Position = vertex; vec4 a = change(colour); colour += data;"),
              HasSubstr("line 10: colour"));
  EXPECT_THAT(error("gl_Position = vertex; colour = data; vec4 a = colour = vertex;"),
              HasSubstr("line 10: colour"));
  EXPECT_THAT(error("gl_Position = vertex; float a = data.x; colour = vec4(a--); "),
              HasSubstr("line 10: colour"));
  EXPECT_THAT(error("gl_Position = vertex; colour = vec4(1 / 2);"),
              HasSubstr("colour divides integers"));
  EXPECT_THAT(error("gl_Position = vertex; vec4 colour = data;"),
              HasSubstr("'colour' is declared twice"));
  EXPECT_THAT(error("gl_Position = vertex + offset; colour = data;"),
              HasSubstr("gl_Position reads 'offset', which is not known here"));
  EXPECT_THAT(error("gl_Position.xy = vertex.xy; colour = data;"),
              HasSubstr("gl_Position is assigned in part"));
  EXPECT_THAT(error("colour = data;"), HasSubstr("line 8: gl_Position is never assigned"));
  // Values that nobody asks for may come from anywhere.
  EXPECT_EQ(error("vec4 a = sin(data); if (a.x > 0.0) a = data; gl_Position = vertex;\n"
                  "colour = data;\n"),
            "no error");
}

TEST(ShaderTest, RefusesUniformsAndOtherStages) {
  Parts parts;
  parts.globals += "uniform mat4 mvp;\n";
  parts.main = "gl_Position = mvp * vertex;\n";
  EXPECT_EQ(error_of(parts),
            "folder/a.shader_test: line 11: gl_Position reads 'mvp', which is declared as uniform "
            "mat4");
  parts = Parts();
  parts.fragment += "[geometry shader]\nvoid main() {}\n";
  EXPECT_THAT(error_of(parts),
              HasSubstr("line 16: the section [geometry shader] is no part of a case"));
  parts = Parts();
  parts.globals = "#define in attribute\n" + parts.globals;
  EXPECT_THAT(error_of(parts), HasSubstr("line 5: #define is not understood"));
}

TEST(ShaderTest, QualifiersAreThoseOfTheFragmentShader) {
  Parts parts;
  parts.globals =
      "in vec4 vertex;\nin vec4 data;\nflat out float a;\nnoperspective out vec2 b;\n"
      "out vec3 c, unread;\nflat out int number;\n";
  parts.main = "gl_Position = vertex; a = data.x; b = data.xy; c = data.xyz; unread = c;\n";
  parts.fragment =
      "flat in float a;\nnoperspective centroid in vec2 b;\nsample in vec3 c;\nin vec3 unread;\n"
      "flat in int number;\nvoid main() { gl_FragColor = vec4(a, b, c.x + float(number)); }\n";
  const Result<Imported> read = imported(parts);
  ASSERT_TRUE(read) << to_string(read.error());
  const auto& attributes = read->drawn.attributes;
  ASSERT_EQ(attributes.size(), 6U);
  EXPECT_EQ(attributes[0], (Attribute{"a", Interpolation::flat, Location::sample}));
  EXPECT_EQ(attributes[2], (Attribute{"b.y", Interpolation::noperspective, Location::centroid}));
  EXPECT_EQ(attributes[5], (Attribute{"c.z", Interpolation::smooth, Location::sample}));
  EXPECT_THAT(read->notes, Contains("unread left out: the fragment shader does not read it"));
  EXPECT_THAT(read->notes,
              Contains("number left out: attributes of a case are float32, and not int"));
}

// By hand, from the specification's tables of primitives.
TEST(ShaderTest, PrimitivesBecomeTriangles) {
  Parts parts;
  parts.globals = "in vec4 vertex;\nin float data;\nflat out float colour;\n";
  parts.fragment = "flat in float colour;\nvoid main() { gl_FragColor = vec4(colour); }\n";
  parts.data = "vertex/float/2 data/float/1\n0 0 0\n1 0 1\n0 1 2\n1 1 3\n0 2 4\n";
  const auto corners = [&](const std::string& test) {
    parts.test = test;
    const Case c = case_of(parts);
    std::vector<std::array<float, 3>> all;
    for (const Triangle& t : c.triangles) {
      all.push_back({c.attribute_values[t[0]], c.attribute_values[t[1]], c.attribute_values[t[2]]});
    }
    return all;
  };
  using Corners = std::vector<std::array<float, 3>>;
  EXPECT_EQ(corners("draw arrays GL_TRIANGLE_STRIP 0 5\n"),
            (Corners{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}}));
  EXPECT_EQ(corners("draw arrays GL_TRIANGLE_STRIP 1 4\n"), (Corners{{1, 2, 3}, {3, 2, 4}}));
  EXPECT_EQ(corners("draw arrays GL_TRIANGLE_FAN 0 4\n"), (Corners{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(corners("draw arrays GL_QUADS 0 4\n"), (Corners{{0, 1, 3}, {1, 2, 3}}));
  EXPECT_EQ(corners("draw arrays GL_QUAD_STRIP 0 4\n"), (Corners{{0, 1, 3}, {2, 0, 3}}));
  EXPECT_EQ(corners("draw arrays GL_POLYGON 0 4\n"), (Corners{{1, 2, 0}, {2, 3, 0}}));
  // The provoking vertices 0, 1, 2 come last, and no triangle changes sides.
  EXPECT_EQ(corners("provoking vertex first\ndraw arrays GL_TRIANGLE_STRIP 0 5\n"),
            (Corners{{1, 2, 0}, {3, 2, 1}, {3, 4, 2}}));
  EXPECT_THAT(notes_of(parts), Contains(HasSubstr("triangles are turned")));
  EXPECT_EQ(corners("provoking vertex first\ndraw arrays GL_TRIANGLE_FAN 0 4\n"),
            (Corners{{2, 0, 1}, {3, 0, 2}}));
  parts.test = "draw arrays GL_TRIANGLES 3 3\n";
  EXPECT_THAT(error_of(parts), HasSubstr("line 24: draws beyond the 5 rows of [vertex data]"));
}

// 250 pixels: −1 + 2 · 50/250 = −0.6, in the runner's precisions.
TEST(ShaderTest, RectanglesAreStrips) {
  const std::string head =
      "[vertex shader passthrough]\n[fragment shader]\nvoid main() {}\n[test]\n";
  Result<Imported> read = imported(head + "draw rect -1 -0.5 2 1\n");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->drawn.positions,
            (std::vector<ClipVertex>{
                {-1, -0.5F, 0, 1}, {1, -0.5F, 0, 1}, {-1, 0.5F, 0, 1}, {1, 0.5F, 0, 1}}));
  EXPECT_EQ(read->drawn.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
  read = imported(head + "draw rect ortho 50 0 125 250\n");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->drawn.positions.front(), (ClipVertex{-0.6F, -1, 0, 1}));
  EXPECT_EQ(read->drawn.positions.back(), (ClipVertex{-0.6F + 1.0F, 1, 0, 1}));
  // The fixed function has texture coordinates.
  read = imported(
      "[fragment shader]\nvoid main() { gl_FragColor = gl_TexCoord[0]; }\n"
      "[test]\ndraw rect tex 0 0 1 1  0.25 0 0.5 2\n");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->drawn.attributes.front().name, "gl_TexCoord[0].x");
  EXPECT_EQ(read->drawn.attribute_values,
            (std::vector<float>{0.25F, 0, 0, 1, 0.75F, 0, 0, 1, 0.25F, 2, 0, 1, 0.75F, 2, 0, 1}));
}

// glFrustum of −1 1 −1 1 1 3, row by row, by hand.
TEST(ShaderTest, ProjectionsAreTheCamera) {
  Parts parts = with_main("gl_Position = gl_ModelViewProjectionMatrix * vertex; colour = data;");
  EXPECT_FALSE(case_of(parts).camera);
  parts.test = "frustum -1 1 -1 1 1 3\n" + parts.test;
  const Case c = case_of(parts);
  ASSERT_TRUE(c.camera);
  EXPECT_EQ(c.camera->projection, (Matrix4{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2, -3, 0, 0, -1, 0}));
  EXPECT_EQ(c.positions[1], (ClipVertex{3, -1, 0, 1}));
  EXPECT_THAT(notes_of(parts), IsEmpty());
  parts.require = "SIZE 64 10\n";
  parts.test = "ortho\ndraw arrays GL_TRIANGLES 0 3\n";
  EXPECT_EQ(case_of(parts).camera->projection,
            (Matrix4{0.03125F, 0, 0, -1, 0, 0.2F, 0, -1, 0, 0, -1, 0, 0, 0, 0, 1}));
  EXPECT_THAT(notes_of(parts), ElementsAre(HasSubstr("the projection has numbers")));
  parts.main = "gl_Position = ftransform() + vertex; colour = data;";
  parts.globals = "in vec4 vertex;\nin vec4 data, gl_Vertex;\nout vec4 colour;\n";
  parts.data.replace(0, 6, "gl_Vertex/float/2 vertex");
  parts.data = "vertex/float/2 gl_Vertex/float/2 data/float/1\n0 0 0 0 0\n0 0 0 0 0\n0 0 0 0 0\n";
  EXPECT_THAT(error_of(parts), HasSubstr("computes with projected positions"));
}

// Plane 1, x + 2 y + 0.5: by hand for (−1, −1), (3, −1), (−1, 3).
TEST(ShaderTest, PlanesBecomeClipDistances) {
  Parts parts = with_main("gl_Position = vertex; gl_ClipVertex = vertex; colour = data;");
  parts.test =
      "clip plane 1 1 2 0 0.5\nenable GL_CLIP_PLANE1\nenable GL_CLIP_PLANE2\n"
      "disable GL_CLIP_PLANE2\ndraw arrays GL_TRIANGLES 0 3\n";
  Case c = case_of(parts);
  EXPECT_EQ(c.clip_distance_count, 1U);
  EXPECT_EQ(c.clip_distances, (std::vector<float>{-2.5F, 1.5F, 5.5F}));
  parts.main = "gl_Position = vertex; colour = data;";
  EXPECT_EQ(case_of(parts).clip_distances, c.clip_distances);
  EXPECT_THAT(notes_of(parts), IsEmpty());
  parts.main += "gl_ClipDistance[0] = data.x; gl_ClipDistance[1] = -1.75 - vertex.x;";
  EXPECT_EQ(case_of(parts).clip_distances, (std::vector<float>{-0.75F, -4.75F, -0.75F}));
  parts.test = "enable GL_CLIP_PLANE3\n" + parts.test;
  EXPECT_THAT(error_of(parts), HasSubstr("gl_ClipDistance[3] is never assigned"));
  parts.main = "gl_Position = gl_ModelViewProjectionMatrix * vertex; colour = data;";
  parts.test = "ortho 0 1 0 1\nenable GL_CLIP_PLANE0\ndraw arrays GL_TRIANGLES 0 3\n";
  EXPECT_THAT(error_of(parts), HasSubstr("line 23: clips projected positions with planes"));
}

TEST(ShaderTest, StateIsThatOfTheDraw) {
  Parts parts;
  parts.test =
      "fb ms GL_RGBA8 40 30 4\nviewport indexed 0 1 2 30.5 20\nviewport indexed 1 0 0 1 1\n"
      "enable GL_DEPTH_CLAMP\nenable GL_DEPTH_TEST\ndraw arrays GL_TRIANGLES 0 3\n";
  const Case c = case_of(parts);
  EXPECT_EQ(c.framebuffer, (FramebufferSize{40, 30, 4}));
  EXPECT_EQ(c.viewport, (Viewport{1, 2, 30.5F, 20, 0, 1}));
  EXPECT_TRUE(c.depth_clamp);
  EXPECT_EQ(c.depth_test, DepthTest::none);
  EXPECT_EQ(c.attributes[0].location, Location::center);
  EXPECT_THAT(notes_of(parts), ElementsAre("no depth test: the framebuffer has no depth buffer",
                                           HasSubstr("colour is evaluated at the pixel's centre")));
  parts.require = "depthbuffer\n";
  parts.test = "enable GL_DEPTH_TEST\nclear depth 0.5\nclear\ndraw arrays GL_TRIANGLES 0 3\n";
  const Case tested = case_of(parts);
  EXPECT_EQ(tested.depth_test, DepthTest::less);
  EXPECT_EQ(tested.depth_clear, 0.5F);
  parts.test = "depthfunc GL_GREATER\n" + parts.test;
  EXPECT_THAT(error_of(parts), HasSubstr("line 27: the depth function is GL_GREATER"));
}

// Kills: draws that vanish without a word.
TEST(ShaderTest, DrawsOfOtherStatesAreToldAndLeftOut) {
  Parts parts = with_test(
      "draw arrays GL_LINES 0 2\ndraw arrays GL_TRIANGLES 0 3\nprobe all rgba 0 0 0 0\n"
      "draw arrays GL_TRIANGLES 0 3\nfb tex 2d 0\ndraw arrays GL_TRIANGLES 0 3\nfb winsys\n"
      "viewport indexed 0 0 0 8 8\ndraw arrays GL_TRIANGLES 0 3\n");
  EXPECT_THAT(
      notes_of(parts),
      ElementsAre(
          "1 draw left out, the first in line 23: draws GL_LINES; a case has only triangles, each "
          "drawn once",
          "1 draw left out, the first in line 28: draws into a framebuffer of kind 'tex'",
          "1 draw left out, the first in line 31: has another state than the first draw",
          "1 draw left out: the same vertices are drawn before",
          "1 probe left out: a case says nothing about the test's colours"));
  EXPECT_EQ(case_of(parts).triangles.size(), 1U);
  EXPECT_THAT(error_of(with_test("draw arrays GL_POINTS 0 3\n")),
              HasSubstr("line 23: draws GL_POINTS; a case has only triangles"));
  EXPECT_THAT(error_of(with_test("draw arrays instanced GL_TRIANGLES 0 3 2\n")),
              HasSubstr("draws instances"));
  EXPECT_THAT(error_of(with_test("link success\n")), HasSubstr("line 22: draws nothing"));
}

TEST(ShaderTest, NamesWhatIsWrongAndWhere) {
  EXPECT_THAT(error_of(with_test("calllist 3\n")),
              HasSubstr("line 23: 'calllist 3' is not understood"));
  EXPECT_THAT(error_of(with_test("enable GL_STENCIL_TEST\n")), HasSubstr("is not understood"));
  Parts parts;
  parts.data = "vertex/float/2 data/float/4\n1 2 3 4 5\n";
  EXPECT_THAT(error_of(parts), HasSubstr("line 18: has 5 numbers, too few for the columns"));
  parts.data = "vertex/float/2 data/float/vec4\n1 2 3 4 5 0x123456789\n";
  EXPECT_THAT(error_of(parts), HasSubstr("line 18: '0x123456789' is no number"));
  parts.data = "vertex\n";
  EXPECT_THAT(error_of(parts), HasSubstr("line 17: 'vertex' is no column"));
  ImportOptions options;
  options.width = 8;
  const Result<Imported> read = imported(text_of(Parts()), options);
  ASSERT_FALSE(read);
  EXPECT_THAT(to_string(read.error()), HasSubstr("takes no option"));
}

TEST(ShaderTest, LeavesOutWhatIsNotFiniteAndSaysSo) {
  Parts parts;
  parts.data =
      "vertex/float/2 data/float/4\n0 0 1 1 1 1\n1 0 1 inf 1 1\n0 1 1 1 1 1\nnan 0 1 1 1 1\n"
      "0 0 1 1 1 1\n1e300 1 1 1 1 1\n";
  parts.test = "draw arrays GL_TRIANGLES 0 6\n";
  const Result<Imported> read = imported(parts);
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->drawn.triangles.size(), 1U);
  EXPECT_EQ(read->drawn.attributes.size(), 3U);
  EXPECT_THAT(read->notes, ElementsAre("colour.y left out: a number is NaN or infinite",
                                       "1 triangle left out: a position is NaN or infinite"));
}

}  // namespace
}  // namespace rastercheck::cases::shader_test_test
