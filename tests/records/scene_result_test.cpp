#include "records/scene_result.h"

#include <gtest/gtest.h>

namespace rastercheck::records::scene_result_test {
namespace {

TEST(SceneSentence, SaysHowMuchWasJudged) {
  SceneResult scene{"bunny.obj", "cpu", 69666, 51234, 51240, 0, 0, false, {}};
  EXPECT_EQ(scene_sentence(scene),
            "Scene bunny.obj on cpu: 69666 triangles, 51234 fragments; 51240 samples judged, all "
            "correct.");
  scene.wrong = 6;
  EXPECT_EQ(scene_sentence(scene),
            "Scene bunny.obj on cpu: 69666 triangles, 51234 fragments; 51240 samples judged, 6 "
            "wrong.");
  scene.is_known = true;
  EXPECT_NE(scene_sentence(scene).find("6 wrong, in known ways."), std::string::npos);
}

// Kills: a scene that looks completely right although nothing of it was judged.
TEST(SceneSentence, SaysWhyNothingWasJudged) {
  const SceneResult left_out{
      "bunny.obj", "gl:llvmpipe", 69666, 0, 0, 0, 0, false, {{"it is too far", 69666}}};
  EXPECT_EQ(scene_sentence(left_out),
            "Scene bunny.obj on gl:llvmpipe: its 69666 triangles could not be judged: it is "
            "too far.");
  const SceneResult in_parts{
      "a", "cpu", 5, 9, 9, 0, 0, false, {{"it is far", 1}, {"it is near", 2}}};
  EXPECT_EQ(scene_sentence(in_parts),
            "Scene a on cpu: 5 triangles, 9 fragments; 9 samples judged, all correct; 1 triangle "
            "not judged: it is far; 2 triangles not judged: it is near.");
  const SceneResult unseen{"a", "cpu", 2, 0, 0, 0, 0, false, {}};
  EXPECT_EQ(scene_sentence(unseen),
            "Scene a on cpu: its 2 triangles could not be judged: no sample is required to be "
            "drawn.");
}

TEST(SceneSentence, SaysWhatShareIsOpen) {
  const SceneResult scene{"a", "cpu", 5, 400, 390, 10, 0, false, {}};
  EXPECT_EQ(scene_sentence(scene),
            "Scene a on cpu: 5 triangles, 400 fragments; 390 of 400 samples judged (97.5%), all "
            "correct.");
  const SceneResult open{"a", "cpu", 5, 400, 0, 400, 0, false, {}};
  EXPECT_EQ(scene_sentence(open),
            "Scene a on cpu: its 5 triangles could not be judged: the contract leaves "
            "something open for each of 400 fragments.");
}

}  // namespace
}  // namespace rastercheck::records::scene_result_test
