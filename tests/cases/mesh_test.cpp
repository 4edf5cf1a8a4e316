// The tests write their meshes themselves, each as small as its format allows.

#include "cases/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "cases/mesh_reader.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cases::mesh_test {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;
using ::testing::SizeIs;
using ::testing::StartsWith;

Result<Case> case_of_file(const std::string& file, const MeshOptions& options = {}) {
  return read_mesh(file)
      .and_then([&](const Mesh& mesh) { return case_of_mesh(mesh, file, options); })
      .map([](Imported&& imported) { return std::move(imported.drawn); });
}

Case read(const std::string& name, const std::string& content, const MeshOptions& options = {}) {
  const TemporaryFolder folder;
  const Result<Case> c = case_of_file(folder.put(name, content), options);
  EXPECT_TRUE(c.has_value()) << to_string(c.error());
  return c.value_or(Case{});
}

/// The reason for which a mesh is refused. Also checks that the error is one line.
std::string refusal(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  const std::string file = folder.put(name, content);
  const Result<Case> c = case_of_file(file);
  EXPECT_FALSE(c.has_value()) << name << ":\n" << content;
  if (c) return "";
  const std::string line = to_string(c.error());
  EXPECT_THAT(line, StartsWith(file + ": "));
  EXPECT_EQ(c.error().place, "");
  EXPECT_FALSE(c.error().reason.empty());
  EXPECT_TRUE(std::none_of(line.begin(), line.end(), [](char character) {
    return static_cast<unsigned char>(character) < 0x20 || character == 0x7f;
  })) << line;
  return c.error().reason;
}

/// The object positions of the corners of every triangle, in the order of the file.
std::vector<ClipVertex> corners(const Case& c) {
  std::vector<ClipVertex> positions;
  for (const Triangle& triangle : c.triangles) {
    for (const std::uint32_t index : triangle) positions.push_back(c.positions.at(index));
  }
  return positions;
}

/// True if every vertex lies strictly inside the clip volume (RULES §4), computed in double.
bool is_framed(const Case& c) {
  const auto times = [](const Matrix4& m, const std::array<double, 4>& v) {
    std::array<double, 4> product{};
    for (std::size_t i = 0; i < 16; ++i) product[i / 4] += double{m[i]} * v[i % 4];
    return product;
  };
  const Camera camera = c.camera.value_or(Camera{});
  return std::all_of(c.positions.begin(), c.positions.end(), [&](const ClipVertex& p) {
    const std::array<double, 4> object{p.x, p.y, p.z, p.w};
    const auto [x, y, z, w] =
        times(camera.projection, times(camera.view, times(camera.model, object)));
    const double nearest = c.rules == Rules::opengl ? -w : 0;
    return w > 0 && std::abs(x) < w && std::abs(y) < w && nearest < z && z < w;
  });
}

constexpr const char* kTexturedQuad =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\n"
    "vt 0 0.25\nvt 0.5 0.25\nvt 0.5 1\nvt 0 1\n"
    "f 1/1 2/2 3/3 4/4\n";
constexpr const char* kTriangle = "v 0 0 0\nv 2 0 0\nv 0 4 1\nf 1 2 3\n";

std::string ply(const std::string& vertices, const std::string& face) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices + face;
}

/// The bytes of a value as stored in little-endian files.
template <typename Value>
std::string bytes(Value value) {
  static_assert(std::endian::native == std::endian::little);
  const auto raw = std::bit_cast<std::array<char, sizeof(Value)>>(value);
  return {raw.begin(), raw.end()};
}

std::string base64(const std::string& data) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < data.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = i; j < i + 3; ++j) {
      group = group << 8U | (j < data.size() ? static_cast<unsigned char>(data[j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += i + j <= data.size() ? kDigits[group >> (18 - 6 * j) & 63U] : '=';
    }
  }
  return text;
}

/// A glTF 2.0 file: one triangle in a node that is moved by (10, 20, 30). `cameras` are further
/// members of the file, whose node 1, next to that of the mesh, is `camera_node`.
std::string gltf(const std::array<float, 9>& coordinates, std::uint16_t last_index,
                 const std::string& camera_node = "{}", const std::string& cameras = "") {
  std::string buffer;
  for (const float coordinate : coordinates) buffer += bytes(coordinate);
  for (const std::uint16_t index : {std::uint16_t{0}, std::uint16_t{1}, last_index}) {
    buffer += bytes(index);
  }
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"mesh": 0, "translation": [10, 20, 30]}, )" +
         camera_node + "], " + cameras + R"(
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                    {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "buffers": [{"byteLength": 42, "uri": "data:application/octet-stream;base64,)" +
         base64(buffer) + R"("}]})";
}

std::string chunk(std::uint16_t id, const std::string& content) {
  return bytes(id) + bytes(static_cast<std::uint32_t>(content.size() + 6)) + content;
}

/// A 3DS file: a main chunk, the editor's chunk, an object "o", and its mesh of one triangle.
std::string three_ds(const std::array<float, 9>& coordinates) {
  std::string vertices = bytes(std::uint16_t{3});
  for (const float coordinate : coordinates) vertices += bytes(coordinate);
  std::string faces = bytes(std::uint16_t{1});
  for (std::uint16_t value = 0; value < 4; ++value) {
    faces += bytes(static_cast<std::uint16_t>(value % 3));  // three indices and flags
  }
  const std::string mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces));
  return chunk(0x4d4d, chunk(0x3d3d, chunk(0x4000, std::string("o\0", 2) + mesh)));
}

TEST(Mesh, QuadsAreCutIntoTrianglesAndTextureCoordinatesAreAttributes) {
  const Case c = read("quad.obj", kTexturedQuad);
  EXPECT_THAT(c.positions, ElementsAre(ClipVertex{0, 0, 0, 1}, ClipVertex{1, 0, 0, 1},
                                       ClipVertex{1, 1, 0, 1}, ClipVertex{0, 1, 0.5F, 1}));
  EXPECT_THAT(c.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_THAT(c.attributes, ElementsAre(Attribute{"u"}, Attribute{"v"}));
  EXPECT_THAT(c.attribute_values, ElementsAre(0, 0.25F, 0.5F, 0.25F, 0.5F, 1, 0, 1));
}

TEST(Mesh, WithoutTextureCoordinatesTheAttributesAreObjectXAndY) {
  const Case c = read("plain.obj", kTriangle);
  EXPECT_THAT(c.positions,
              ElementsAre(ClipVertex{0, 0, 0, 1}, ClipVertex{2, 0, 0, 1}, ClipVertex{0, 4, 1, 1}));
  EXPECT_THAT(c.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_THAT(c.attributes, ElementsAre(Attribute{"x"}, Attribute{"y"}));
  EXPECT_THAT(c.attribute_values, ElementsAre(0, 0, 2, 0, 0, 4));
}

TEST(Mesh, TheCaseHasTheStateThatWasAskedForAndIsNamedAfterTheFile) {
  for (const Rules rules : {Rules::opengl, Rules::vulkan, Rules::d3d}) {
    const Case c = read("state.obj", kTriangle, {40, 30, rules, 4, {}, {}});
    EXPECT_EQ(c.name, "state.obj");
    EXPECT_EQ(c.rules, rules);
    EXPECT_EQ(c.fill_rule, default_fill_rule(rules));
    EXPECT_EQ(c.basis, default_basis(rules));
    EXPECT_EQ(c.framebuffer, (FramebufferSize{40, 30, 4}));
    EXPECT_EQ(c.viewport, (Viewport{0, 0, 40, 30, 0, 1}));
    EXPECT_TRUE(c.camera.has_value());
  }
}

TEST(Mesh, TheCameraFramesItUnderAllRules) {
  for (const Rules rules : {Rules::opengl, Rules::vulkan, Rules::d3d}) {
    for (const auto& [width, height] : {std::pair{512, 512}, std::pair{640, 160}, {1, 4}}) {
      EXPECT_TRUE(is_framed(read("quad.obj", kTexturedQuad, {width, height, rules})));
      EXPECT_TRUE(is_framed(read("plain.obj", kTriangle, {width, height, rules})));
    }
  }
}

TEST(Mesh, PlyAndOffAreRead) {
  const auto positions =
      ElementsAre(ClipVertex{0, 0, 0, 1}, ClipVertex{2, 0, 0, 1}, ClipVertex{0, 4, 1, 1});
  EXPECT_THAT(corners(read("a.ply", ply("0 0 0\n2 0 0\n0 4 1\n", "3 0 1 2\n"))), positions);
  EXPECT_THAT(corners(read("a.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n0 4 1\n3 0 1 2\n")), positions);
}

TEST(Mesh, GltfNodesMoveTheirVertices) {
  const Case c = read("a.gltf", gltf({0, 0, 0, 2, 0, 0, 0, 4, 1}, 2));
  EXPECT_THAT(corners(c), ElementsAre(ClipVertex{10, 20, 30, 1}, ClipVertex{12, 20, 30, 1},
                                      ClipVertex{10, 24, 31, 1}));
  EXPECT_TRUE(is_framed(c));
}

/// A glTF file with two cameras 7 in front of the triangle's first corner. By hand (glTF 2.0,
/// section 3.10.3): that corner has the clip position (0, 0, z, 7).
std::string filmed(const std::string& perspective) {
  return gltf({0, 0, 0, 2, 0, 0, 0, 4, 1}, 2,
              R"({"name": "tripod", "translation": [10, 20, 37], "camera": 0, "children": [2]},
                 {"name": "plan", "camera": 1})",
              R"("cameras": [{"type": "perspective", "perspective": )" + perspective + R"(},
                 {"type": "orthographic",
                  "orthographic": {"xmag": 4, "ymag": 2, "znear": 1, "zfar": 9}}],)");
}

Result<Imported> import(const std::string& content, const MeshOptions& options) {
  const TemporaryFolder folder;
  const std::string file = folder.put("a.gltf", content);
  return read_mesh(file).and_then(
      [&](const Mesh& mesh) { return case_of_mesh(mesh, "a.gltf", options); });
}

/// The clip position of the corner (12, 20, 30).
std::array<double, 4> corner_seen_by(const Case& c) {
  std::array<double, 4> at{12, 20, 30, 1};
  for (const Matrix4& m : {c.camera->view, c.camera->projection}) {
    std::array<double, 4> product{};
    for (std::size_t i = 0; i < 16; ++i) product[i / 4] += double{m[i]} * at[i % 4];
    at = product;
  }
  return at;
}

// By hand: (12, 20, 30) is 2 to the right of the camera's axis and 7 away. With a slope of 1/2, an
// aspect ratio of 2 and no far plane, x = 2 / (2 · 1/2), z = 7 − 2 · 1 in OpenGL, w = 7.
// Kills: assimp's cameras, whose far plane is at 100 if the file has none.
TEST(Mesh, AGltfFileIsSeenByItsFirstCamera) {
  const std::string file = filmed(R"({"yfov": 0.9272952180016122, "aspectRatio": 2, "znear": 1})");
  const auto first = import(file, {512, 256, Rules::opengl, 1, {}, {}});
  ASSERT_TRUE(first.has_value()) << first.error().reason;
  EXPECT_THAT(corner_seen_by(first->drawn),
              Pointwise(DoubleNear(1e-5), std::array{2.0, 0.0, 5.0, 7.0}));
  EXPECT_THAT(first->notes,
              ElementsAre("camera 0 'tripod' of 2 (--camera NAME|INDEX, or none to see all)"));
  // Asked for, it needs no note.
  for (const char* name : {"tripod", "0"}) {
    const auto same = import(file, {512, 256, Rules::opengl, 1, {}, name});
    EXPECT_EQ(same->drawn, first->drawn);
    EXPECT_THAT(same->notes, SizeIs(0));
  }
}

// By hand: x = 2 / 4, z = −(2 · 7 − (9 + 1)) / (1 − 9) = 1/2 in OpenGL.
TEST(Mesh, AGltfFileIsSeenByTheCameraThatIsAskedFor) {
  const std::string file = filmed(R"({"yfov": 0.5, "znear": 1})");
  for (const char* name : {"plan", "1"}) {
    const auto second = import(file, {512, 256, Rules::opengl, 1, {}, name});
    EXPECT_THAT(corner_seen_by(second->drawn),
                Pointwise(DoubleNear(1e-5), std::array{0.5, 0.0, 0.5, 1.0}));
  }
  const auto none = import(file, {512, 256, Rules::opengl, 1, {}, kNoCamera});
  EXPECT_TRUE(is_framed(none->drawn));
  EXPECT_THAT(none->notes, SizeIs(0));
  View view;
  view.fov = 60;
  EXPECT_TRUE(is_framed(import(file, {512, 256, Rules::opengl, 1, view, {}})->drawn));
  EXPECT_EQ(import(file, {512, 256, Rules::opengl, 1, {}, "top"}).error().reason,
            "has no camera 'top', but 0 'tripod', 1 'plan'");
  EXPECT_EQ(import(gltf({0, 0, 0, 2, 0, 0, 0, 4, 1}, 2), {8, 8, {}, 1, {}, "0"}).error().reason,
            "has no cameras, so no '0'");
}

TEST(Mesh, APictureOfAnotherShapeIsNoted) {
  const std::string file = filmed(R"({"yfov": 0.5, "aspectRatio": 2, "znear": 1})");
  EXPECT_THAT(import(file, {512, 512, {}, 1, {}, "0"})->notes,
              ElementsAre("its camera's picture is 2 times as wide as high, so that this one shows "
                          "more above and below (--width 512 --height 256 shows what the camera "
                          "does)"));
  EXPECT_THAT(import(file, {512, 128, {}, 1, {}, "0"})->notes,
              ElementsAre("its camera's picture is 2 times as wide as high, so that this one shows "
                          "more at the sides (--width 256 --height 128 shows what the camera "
                          "does)"));
}

// Kills: a mesh that cannot be drawn because of a camera that nobody asked for.
TEST(Mesh, ACameraThatMakesNoSenseIsRefusedIfAskedFor) {
  const std::string file = filmed(R"({"yfov": 4, "znear": 1})");
  const std::string reason =
      "camera 0 'tripod' cannot be used: its yfov, 4 radians, is not between 0 and π";
  EXPECT_EQ(import(file, {8, 8, {}, 1, {}, "0"}).error().reason, reason);
  const auto framed = import(file, {8, 8, {}, 1, {}, {}});
  EXPECT_TRUE(is_framed(framed->drawn));
  EXPECT_THAT(framed->notes, ElementsAre(reason + "; all of the mesh is shown instead"));
}

// In 3DS, z points up. assimp turns it by the root node's transform, from (x, y, z) to (x, z, -y).
TEST(Mesh, ThreeDsIsReadWithItsUpTurnedToY) {
  const Case c = read("a.3ds", three_ds({0, 0, 0, 2, 0, 0, 0, 4, 1}));
  EXPECT_THAT(corners(c),
              ElementsAre(ClipVertex{0, 0, 0, 1}, ClipVertex{2, 0, 0, 1}, ClipVertex{0, 1, -4, 1}));
}

// Kills: joining vertices that are nearer than some epsilon, instead of only identical ones.
TEST(Mesh, VerticesThatDifferInTheLastBitStayApart) {
  const Case tiny = read("tiny.obj", "v 0 0 0\nv 1e-6 0 0\nv 0 1e-6 0\nf 1 2 3\n");
  EXPECT_THAT(tiny.positions, SizeIs(3));
  EXPECT_THAT(tiny.triangles, ElementsAre(Triangle{0, 1, 2}));
  const Case close = read("close.obj", "v 0 0 0\nv 0.5 0.5 0\nv 0.50000006 0.5 0\nf 1 2 3\n");
  EXPECT_THAT(close.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Mesh, PolygonsAndTrianglesOfOneFileAreAllDrawn) {
  const Case c =
      read("mixed.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 5\nf 1 2 5\nf 1 2 3 4\nl 1 3\n");
  EXPECT_THAT(c.triangles, SizeIs(3));
}

constexpr const char* kOneOfTwoObjectsTextured =
    "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.5\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\n"
    "o b\nv 0 0 5\nf 1 2 4\n";

TEST(Mesh, TextureCoordinatesOfSomeVerticesOnlyAreNotUsed) {
  EXPECT_THAT(read("some.obj", kOneOfTwoObjectsTextured).attributes,
              ElementsAre(Attribute{"x"}, Attribute{"y"}));
}

// Kills: grouping objects by the kinds of data that their vertices have.
TEST(Mesh, TrianglesComeInTheOrderOfTheFile) {
  EXPECT_THAT(corners(read("order.obj", kOneOfTwoObjectsTextured)),
              ElementsAre(ClipVertex{0, 0, 0, 1}, ClipVertex{1, 0, 0, 1}, ClipVertex{0, 1, 0, 1},
                          ClipVertex{0, 0, 0, 1}, ClipVertex{1, 0, 0, 1}, ClipVertex{0, 0, 5, 1}));
}

TEST(Mesh, WhatIsNoMeshIsRefusedInOneLine) {
  refusal("empty.obj", "");
  refusal("empty.ply", "");
  refusal("empty.off", "");
  refusal("empty.gltf", "");
  refusal("empty.3ds", "");
  for (const char* name : {"text.obj", "text.ply", "text.off", "text.gltf", "text.3ds", "text.x"}) {
    refusal(name, "This is a text,\nof two lines.\n");
  }
}

TEST(Mesh, AMissingFileIsRefusedInOneLine) {
  const std::string file = testing::TempDir() + "rastercheck_no_such_mesh.obj";
  const Result<Case> c = case_of_file(file);
  ASSERT_FALSE(c.has_value());
  EXPECT_THAT(to_string(c.error()), StartsWith(file + ": "));
  EXPECT_EQ(to_string(c.error()).find('\n'), std::string::npos);
}

TEST(Mesh, AFileWithoutTrianglesIsRefused) {
  refusal("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  EXPECT_EQ(refusal("lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n"), "has no triangles");
}

// Kills: passing on an importer's message, which quotes the file, unescaped.
TEST(Mesh, WhatAMessageQuotesStaysOnOneLine) {
  refusal("quote.gltf",
          R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
              "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
              "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
              "bufferViews": [{"buffer": 0, "byteLength": 36}],
              "buffers": [{"byteLength": 36, "uri": "no\nsuch\u001b[31m.bin"}]})");
}

TEST(Mesh, ACoordinateThatIsNotFiniteIsRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  refusal("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  refusal("infinite.obj", "v 0 0 0\nv 1 0 inf\nv 0 1 0\nf 1 2 3\n");
  refusal("nan.gltf", gltf({0, 0, 0, 1, nan, 0, 0, 1, 0}, 2));
  refusal("infinite.gltf", gltf({0, 0, 0, 1, -infinity, 0, 0, 1, 0}, 2));
  refusal("nan.3ds", three_ds({0, 0, 0, 1, 0, nan, 0, 1, 0}));
}

// Kills: joining a vertex that has NaN with the one before it, because its distance is not above
// the limit.
TEST(Mesh, ACoordinateThatIsNotFiniteIsRefusedInPlyToo) {
  refusal("nan.ply", ply("0 0 0\n1 nan 0\n0 1 0\n", "3 0 1 2\n"));
}

TEST(Mesh, AnIndexOutOfRangeIsRefused) {
  refusal("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  refusal("index.gltf", gltf({0, 0, 0, 1, 0, 0, 0, 1, 0}, 9));
}

// Kills: reading beyond the vertices, which ends in a crash or in a triangle that is not in the
// file.
TEST(Mesh, AnIndexOutOfRangeIsRefusedInPlyToo) {
  refusal("index.ply", ply("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 7\n"));
  refusal("index_huge.ply", ply("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 70000000\n"));
  refusal("index_negative.ply", ply("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 -1\n"));
}

TEST(Mesh, FileNamesAreKnownByTheirEnding) {
  for (const char* file :
       {"a.obj", "a.OBJ", "/b/c.d/a.ply", "a.off", "a.gltf", "a.glb", "a.3ds", "two.parts.stl"}) {
    EXPECT_TRUE(is_mesh_file(file)) << file;
  }
  for (const char* file :
       {"", "-", "a", "a.", "obj", ".obj", "a.json", "a.obj.json", "a.cpp", "a.png", "dir.obj/a"}) {
    EXPECT_FALSE(is_mesh_file(file)) << file;
  }
}

}  // namespace
}  // namespace rastercheck::cases::mesh_test
