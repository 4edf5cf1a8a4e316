// Expected transforms are calculated by hand after glTF 2.0, section 3.5.3.

#include "cases/internal/gltf_cameras.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace rastercheck::cases::gltf_cameras_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A file of these nodes, whose scene begins with node 0. Camera 0 is a perspective one without a
/// name, 1 an orthographic one.
std::string file_of(const std::string& nodes) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)" +
         nodes + R"(], "cameras": [
    {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.25}},
    {"name": "plan", "type": "orthographic",
     "orthographic": {"xmag": 3, "ymag": 2, "znear": 0, "zfar": 100}}]})";
}

std::vector<std::string> names(const std::vector<MeshCamera>& cameras) {
  std::vector<std::string> all;
  for (const MeshCamera& camera : cameras) all.push_back(camera.name);
  return all;
}

TEST(GltfCameras, HaveTheNumbersOfTheFile) {
  const auto cameras =
      gltf_cameras(file_of(R"({"name": "tripod", "camera": 0, "children": [1]}, {"camera": 1})"));
  ASSERT_THAT(cameras, SizeIs(2));
  MeshCamera first;
  first.name = "tripod";
  first.yfov = 0.5;
  first.znear = 0.25;
  first.to_object = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  EXPECT_EQ(cameras[0], first);
  EXPECT_EQ(cameras[0].zfar, std::nullopt);
  MeshCamera second;
  second.name = "plan";
  second.is_orthographic = true;
  second.xmag = 3;
  second.ymag = 2;
  second.zfar = 100;
  second.to_object = first.to_object;
  EXPECT_EQ(cameras[1], second);
}

// By hand: the parent turns by 180° about y, which is the quaternion (0, 1, 0, 0), scales y by 3
// and moves by (1, 2, 3). Its child's origin, (10, 20, 30), is scaled to (10, 60, 30), turned to
// (−10, 60, −30) and moved to (−9, 62, −27).
TEST(GltfCameras, AreMovedByAllNodesAboveThem) {
  const auto cameras = gltf_cameras(file_of(
      R"({"translation": [1, 2, 3], "rotation": [0, 1, 0, 0], "scale": [1, 3, 1], "children": [1]},
         {"translation": [10, 20, 30], "camera": 0})"));
  ASSERT_THAT(cameras, SizeIs(1));
  EXPECT_THAT(cameras[0].to_object, ElementsAre(-1, 0, 0, -9,  //
                                                0, 3, 0, 62,   //
                                                0, 0, -1, -27));
}

// A quaternion of 90° about x turns y to z. The file's is twice as long as it should be.
TEST(GltfCameras, AreTurnedByQuaternionsOfAnyLength) {
  const auto cameras = gltf_cameras(file_of(R"({"rotation": [2, 0, 0, 2], "camera": 0})"));
  ASSERT_THAT(cameras, SizeIs(1));
  EXPECT_THAT(cameras[0].to_object, ElementsAre(1, 0, 0, 0,   //
                                                0, 0, -1, 0,  //
                                                0, 1, 0, 0));
}

// A third of a turn about (1, 1, 1) turns x to y, y to z and z to x. Kills: one wrong sign of nine.
TEST(GltfCameras, AreTurnedAboutAnyAxis) {
  const auto cameras = gltf_cameras(file_of(R"({"rotation": [0.5, 0.5, 0.5, 0.5], "camera": 0})"));
  ASSERT_THAT(cameras, SizeIs(1));
  EXPECT_THAT(cameras[0].to_object, ElementsAre(0, 0, 1, 0,  //
                                                1, 0, 0, 0,  //
                                                0, 1, 0, 0));
}

// Kills: a matrix read row by row; it is written column by column.
TEST(GltfCameras, MatricesAreReadByColumns) {
  const auto cameras = gltf_cameras(
      file_of(R"({"matrix": [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 10, 20, 30, 1], "camera": 0})"));
  ASSERT_THAT(cameras, SizeIs(1));
  EXPECT_THAT(cameras[0].to_object, ElementsAre(0, 0, 1, 10,  //
                                                0, 1, 0, 20,  //
                                                -1, 0, 0, 30));
}

TEST(GltfCameras, ComeInTheOrderOfTheFile) {
  const auto cameras = gltf_cameras(file_of(
      R"({"children": [3, 1, 2]}, {"name": "a", "camera": 1}, {"name": "b", "camera": 0},
         {"name": "c", "camera": 0})"));
  EXPECT_THAT(names(cameras), ElementsAre("c", "b", "plan"));
}

TEST(GltfCameras, OnlyThoseOfTheScene) {
  EXPECT_THAT(gltf_cameras(file_of(R"({}, {"camera": 0})")), IsEmpty());
}

// Kills: following nodes for ever.
TEST(GltfCameras, ANodeIsVisitedOnce) {
  EXPECT_THAT(gltf_cameras(file_of(R"({"camera": 0, "children": [0, 1, 1]},
                                      {"camera": 0, "children": [0]})")),
              SizeIs(2));
}

TEST(GltfCameras, NoMoreThanTheMostAndNoLongNames) {
  std::string nodes = R"({"children": [)";
  for (int i = 1; i <= 40; ++i) nodes += (i == 1 ? "" : ", ") + std::to_string(i);
  nodes += "]}";
  for (int i = 1; i <= 40; ++i) {
    nodes += R"(, {"camera": 0, "name": ")" + std::string(1000, 'n') + R"("})";
  }
  const auto cameras = gltf_cameras(file_of(nodes));
  ASSERT_THAT(cameras, SizeIs(kMaxMeshCameras));
  EXPECT_THAT(cameras[0].name, SizeIs(200));
}

TEST(GltfCameras, OfBinaryFilesToo) {
  const std::string json = file_of(R"({"camera": 0})");
  const auto length = static_cast<std::uint32_t>(json.size());
  std::string file = std::string("glTF\2\0\0\0....", 12);
  std::array<char, 4> bytes{};
  std::memcpy(bytes.data(), &length, 4);
  file += std::string(bytes.begin(), bytes.end()) + "JSON" + json + "binary";
  EXPECT_THAT(gltf_cameras(file), SizeIs(1));
  EXPECT_THAT(gltf_cameras(file.substr(0, 19)), IsEmpty());
  EXPECT_THAT(gltf_cameras(file.substr(0, 40)), IsEmpty());
}

TEST(GltfCameras, OtherFilesHaveNone) {
  for (const std::string& content :
       {std::string(), std::string("v 0 0 0\n"), std::string("{"), std::string("{}"),
        std::string("[]"), std::string(R"({"asset": {"version": "1.0"}})"),
        std::string(R"({"asset": {"version": "2.0"}, "nodes": {}, "cameras": 7, "scenes": []})"),
        file_of(R"(3)"), file_of(R"({"camera": 7})"), file_of(R"({"camera": -1})"),
        file_of(R"({"children": [9, -1, "x"]})"), file_of(R"({"children": 7})")}) {
    EXPECT_THAT(gltf_cameras(content), IsEmpty()) << content;
  }
}

// Whoever uses the camera refuses them.
TEST(GltfCameras, NumbersThatAreNoneAreZero) {
  const auto cameras = gltf_cameras(
      R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
          "nodes": [{"camera": 0, "scale": [1e200, 1, 1], "children": [1]},
                    {"camera": 1, "scale": [1e200, 1, 1], "name": 7}],
          "cameras": [{"type": "perspective", "perspective": {"yfov": "wide"}}, {}]})");
  ASSERT_THAT(cameras, SizeIs(2));
  EXPECT_EQ(cameras[0].yfov, 0);
  MeshCamera none;  // its transform overflows
  EXPECT_EQ(cameras[1], none);
}

}  // namespace
}  // namespace rastercheck::cases::gltf_cameras_test
