// Shell scripts play mesh readers that fail.

#include "cases/mesh_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/temporary_folder.h"

namespace rastercheck::cases::mesh_process_test {
namespace {

using ::testing::HasSubstr;

constexpr ProcessLimits kLimits{std::uint64_t{1} << 20U, 7};

Mesh triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, -0.0F, 0}, {0, 4, 1e-45F}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

Mesh textured_quad() {
  Mesh mesh;
  mesh.is_textured = true;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.texture = {{0, 0}, {0.5F, 0}, {0.5F, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Mesh filmed_triangle() {
  Mesh mesh = triangle();
  MeshCamera& first = mesh.cameras.emplace_back();
  first.name = "a \"b\"\n";
  first.yfov = 0.1;
  first.znear = 1e-300;
  first.to_object = {1, 0, 0, 1.0 / 3, 0, 1, 0, -1e300, 0, 0, 1, 1e-7};
  MeshCamera& second = mesh.cameras.emplace_back();
  second.is_orthographic = true;
  second.xmag = 7;
  second.ymag = -0.25;
  second.zfar = 5;
  second.aspect_ratio = 16.0 / 9;
  return mesh;
}

/// The error for the answer of a shell script.
std::string refusal(const std::string& script) {
  const Result<Mesh> mesh = mesh_of_process({"/bin/sh", "-c", script}, "a.glb", kLimits);
  return mesh ? "read" : to_string(mesh.error());
}

std::string reply_refusal(const std::string& reply) {
  const Result<Mesh> mesh = mesh_from_reply(reply, "a.glb");
  return mesh ? "read" : to_string(mesh.error());
}

TEST(MeshReply, ComesBackAsItWas) {
  for (const Mesh& mesh : {triangle(), textured_quad(), filmed_triangle(), Mesh()}) {
    const Result<Mesh> again = mesh_from_reply(mesh_to_reply(mesh), "a.glb");
    ASSERT_TRUE(again.has_value()) << to_string(again.error());
    EXPECT_EQ(*again, mesh);
    EXPECT_EQ(mesh_to_reply(again), mesh_to_reply(mesh));
  }
}

TEST(MeshReply, CarriesAnErrorWithItsPlace) {
  EXPECT_EQ(reply_refusal(mesh_to_reply(tl::unexpected(Error{"b.obj", "2:1", "no\nmesh"}))),
            "b.obj: 2:1: no\\nmesh");
}

TEST(MeshReply, IsRefusedWhereItIsNone) {
  const std::string whole = mesh_to_reply(triangle());
  for (const std::string& reply :
       {std::string(), std::string("{}"), std::string("{}\n"), std::string("[]\n"),
        std::string("rubbish\n"), std::string(100'000, ' ') + whole,
        whole.substr(0, whole.size() - 1), whole + "x",
        std::string(R"({"error": {"file": "", "place": "", "reason": ""}})") + "\n",
        std::string(R"({"vertices": -1, "triangles": 0, "textured": false})") + "\n",
        std::string(R"({"vertices": 4294967295, "triangles": 4294967295, "textured": true})") +
            "\n"}) {
    EXPECT_THAT(reply_refusal(reply), HasSubstr("a.glb: the mesh reader's answer: ")) << reply;
  }
}

// Kills: trusting a process that has read a broken file.
TEST(MeshReply, IsRefusedWithAnIndexOutOfRange) {
  Mesh mesh = triangle();
  mesh.triangles[0][2] = 3;
  EXPECT_EQ(reply_refusal(mesh_to_reply(mesh)),
            "a.glb: the mesh reader's answer: an index is out of range");
}

TEST(MeshReply, IsRefusedWithANumberThatIsNotFinite) {
  const char* expected = "a.glb: the mesh reader's answer: a number is not finite";
  Mesh mesh = textured_quad();
  mesh.positions[3][2] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(reply_refusal(mesh_to_reply(mesh)), expected);
  mesh = textured_quad();
  mesh.texture[0][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(reply_refusal(mesh_to_reply(mesh)), expected);
}

// Kills: a camera's number that is used as it comes.
TEST(MeshReply, IsRefusedWithCamerasThatNoReaderFinds) {
  const std::string fault = "a.glb: the mesh reader's answer: ";
  Mesh mesh = filmed_triangle();
  mesh.cameras[1].to_object[11] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(reply_refusal(mesh_to_reply(mesh)), fault + "a camera's number is not finite");
  mesh = filmed_triangle();
  mesh.cameras[0].yfov = std::numeric_limits<double>::infinity();
  EXPECT_EQ(reply_refusal(mesh_to_reply(mesh)), fault + "a camera's number is not finite");
  mesh = filmed_triangle();
  mesh.cameras.resize(kMaxMeshCameras + 1);
  EXPECT_EQ(reply_refusal(mesh_to_reply(mesh)), fault + "too many cameras");
  for (const std::string& cameras :
       {std::string("7"), std::string("[{}]"), std::string(R"([{"to_object": [1]}])"),
        std::string(R"([{"to_object": [0,0,0,0,0,0,0,0,0,0,0,0], "zoom": 2}])")}) {
    EXPECT_THAT(reply_refusal(R"({"vertices": 0, "triangles": 0, "textured": false, "cameras": )" +
                              cameras + "}\n"),
                HasSubstr(fault));
  }
}

// As long as the names and numbers of cameras can be.
TEST(MeshReply, HasRoomForTheMostCameras) {
  Mesh mesh = filmed_triangle();
  mesh.cameras.assign(kMaxMeshCameras, mesh.cameras[0]);
  for (MeshCamera& camera : mesh.cameras) {
    camera.name = std::string(200, '\1');
    camera.to_object.fill(-1.0 / 3e-300);
    for (double* number : {&camera.yfov, &camera.xmag, &camera.ymag, &camera.znear}) {
      *number = -1.0 / 3e-300;
    }
    camera.aspect_ratio = camera.zfar = camera.yfov;
  }
  EXPECT_EQ(mesh_from_reply(mesh_to_reply(mesh), "a.glb").value(), mesh);
}

TEST(MeshProcess, AnswersWithAMesh) {
  const TemporaryFolder folder;
  const std::string reply = folder.put("reply", mesh_to_reply(textured_quad()));
  const Result<Mesh> mesh =
      mesh_of_process({"/bin/sh", "-c", "echo noise >&2; cat " + reply}, "a.glb", kLimits);
  ASSERT_TRUE(mesh.has_value()) << to_string(mesh.error());
  EXPECT_EQ(*mesh, textured_quad());
}

TEST(MeshProcess, ThatCrashesIsOneLine) {
  EXPECT_EQ(refusal("kill -SEGV $$"), "a.glb: the mesh reader crashed (Segmentation fault)");
  EXPECT_EQ(refusal("echo '{}'; kill -ABRT $$"), "a.glb: the mesh reader crashed (Aborted)");
}

TEST(MeshProcess, ThatEndsOtherwiseIsOneLine) {
  EXPECT_EQ(refusal("exit 3"), "a.glb: the mesh reader ended with exit code 3");
  EXPECT_EQ(refusal("exit 0"), "a.glb: the mesh reader's answer: no header line");
}

TEST(MeshProcess, ThatTakesTooLongIsEnded) {
  EXPECT_EQ(refusal("ulimit -S -t 1; while :; do :; done"),
            "a.glb: the mesh reader took longer than 7 s");
}

// Kills: keeping everything that a process writes, until no memory is left.
TEST(MeshProcess, ThatNeverEndsToTalkIsEnded) {
  EXPECT_EQ(refusal("while :; do echo nonsense; done"),
            "a.glb: the mesh reader's answer is larger than any mesh");
}

TEST(MeshProcess, ThatCannotBeStartedIsNamed) {
  const Result<Mesh> mesh = mesh_of_process({"/no/such/program"}, "a.glb", kLimits);
  ASSERT_FALSE(mesh.has_value());
  EXPECT_EQ(to_string(mesh.error()),
            "/no/such/program: cannot be started: No such file or directory");
}

}  // namespace
}  // namespace rastercheck::cases::mesh_process_test
