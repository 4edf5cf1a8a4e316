// Compares the oracle with exact answers that a separate implementation computed
// (tests/oracle/vectors).

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "cases/case_reader.h"
#include "cases/files.h"
#include "cases/json.h"
#include "oracle/fragment_json.h"
#include "oracle/fragments.h"

namespace rastercheck::oracle::vectors_test {
namespace {

using nlohmann::json;

std::vector<std::filesystem::path> vector_files() {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path folder = RASTERCHECK_SOURCE_DIR "/tests/oracle/vectors";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

json fragments_of(const cases::Case& c) {
  json list = json::array();
  const SceneTruth scene(c, cases::contract_of(c));
  for_each_fragment(scene, [&list](const Fragment& f, const TriangleTruth&) {
    list.push_back(json::parse(to_json(f)));
    return true;
  });
  return list;
}

class Vectors : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(Vectors, TheOracleGivesTheIndependentAnswer) {
  const std::string file = GetParam().string();
  const auto text = cases::read_text(file);
  ASSERT_TRUE(text);
  const auto document = cases::parse_json(*text, file);
  ASSERT_TRUE(document);
  const auto c = cases::parse_case(document->at("case").dump(), file);
  ASSERT_TRUE(c) << to_string(c.error());
  EXPECT_EQ(fragments_of(*c), document->at("oracle").at("fragments"));
}

INSTANTIATE_TEST_SUITE_P(Oracle, Vectors, testing::ValuesIn(vector_files()),
                         [](const auto& file) { return "n" + file.param.stem().string(); });

TEST(VectorFolder, HoldsAllAnswers) { EXPECT_EQ(vector_files().size(), 48U); }

}  // namespace
}  // namespace rastercheck::oracle::vectors_test
