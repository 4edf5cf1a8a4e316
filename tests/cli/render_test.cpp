#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace rastercheck::cli {
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
  // The square's first corner lies on the sample of pixel (1, 1) exactly.
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
  EXPECT_THAT(outcome.err, HasSubstr("no backend of that name; there are: cpu, method"));
}

}  // namespace
}  // namespace rastercheck::cli
