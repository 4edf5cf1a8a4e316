#include "properties/campaign/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::checkpoint_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kCoverage = "coverage-obeys-the-contract";

/// A checkpoint with every kind of content.
Checkpoint sample() {
  Checkpoint checkpoint;
  records::Plan& plan = checkpoint.plan;
  plan.seed = std::numeric_limits<std::uint64_t>::max();
  plan.cases_per_law = 12;
  plan.backends = {"cpu", "a \"b\""};
  plan.laws = {kCoverage};
  plan.properties = {"*edge*"};
  plan.shrinking = {77, 0.25};
  plan.shard = {2, 7};
  plan.corpus = "/some/folder";
  plan.known = {"/another/folder"};
  plan.ignores_known = true;
  plan.scene = "bunny.obj";
  plan.scene_size = 640;
  plan.timeout = 2.5;
  plan.contract.emplace().file = "lax.json";
  plan.contract->terms.coverage =
      cases::Coverage(cases::Snapping{4, cases::Rounding::half_up, 0.1F});
  plan.contract->terms.keeps_constants = false;
  checkpoint.corpus_digest = "0123456789abcdef";
  checkpoint.known_digest = "fedcba9876543210";
  checkpoint.program = "1.2.3";
  checkpoint.saved = {square()};
  checkpoint.saved[0].found = cases::Found{kCoverage, "cpu", "missing", 3, 4};
  checkpoint.is_done = {true, false, true, true, false, false, true};
  DamagedBackend backend([](const cases::Case&, cases::Fragments& d) { drop(d, 0, 1, 1); });
  check_case(*find_law(kCoverage), "cpu", backend, 1, {square(), "here", 4}, checkpoint.findings);
  keep(checkpoint.findings,
       records::UnexpectedPass{"cpu", "driver-1", kCoverage, records::Staleness::other_version});
  return checkpoint;
}

TEST(Checkpoint, ComesBackAsItWas) {
  EXPECT_FALSE(sample().findings.counterexamples.empty());
  EXPECT_EQ(parse_checkpoint(to_json(sample()), "file").value(), sample());
  EXPECT_EQ(parse_checkpoint(to_json(Checkpoint()), "file").value(), Checkpoint());
}

TEST(Checkpoint, WritesWhatIsDoneAsRanges) {
  EXPECT_EQ(json::parse(to_json(sample())).at("done"), json::parse("[[0, 1], [2, 4], [6, 7]]"));
}

// Kills: resuming from half a file, or from a file of another format.
TEST(Checkpoint, IsRefusedWithItsPlace) {
  const auto error = [](const char* pointer, const char* value) {
    json document = json::parse(to_json(sample()));
    document[json::json_pointer(pointer)] = json::parse(value);
    const auto read = parse_checkpoint(document.dump(), "file");
    return read ? "was read" : to_string(read.error());
  };
  EXPECT_THAT(error("/format", R"("rastercheck-run")"), HasSubstr("file: /format: must be"));
  EXPECT_THAT(error("/version", "1"), HasSubstr("file: /version: version must be 2"));
  EXPECT_THAT(error("/more", "1"), HasSubstr("unknown key"));
  EXPECT_THAT(error("/plan/seed", "-1"), HasSubstr("file: /plan/seed: "));
  EXPECT_THAT(error("/plan/shard/index", "8"), HasSubstr("/plan/shard/index: must be from 1 to 7"));
  EXPECT_THAT(error("/plan/scene_size", "0"), HasSubstr("file: /plan/scene_size: "));
  EXPECT_THAT(error("/done/0", "[0, 8]"), HasSubstr("file: /done/0/1: "));
  EXPECT_THAT(error("/tasks", "3"), HasSubstr("file: /done/"));
  EXPECT_THAT(error("/tasks", "1e18"), HasSubstr("file: /tasks: "));
  EXPECT_THAT(error("/saved/0/version", "7"), HasSubstr("file: /saved/0/version: "));
  EXPECT_THAT(error("/counterexamples/0/origin", "1"), HasSubstr("/counterexamples/0/origin: "));
  EXPECT_THAT(error("/records/0", "{}"), HasSubstr("file: /records/0"));
  json document = json::parse(to_json(sample()));
  document["saved"][0].erase("found");
  EXPECT_THAT(to_string(parse_checkpoint(document.dump(), "file").error()),
              HasSubstr("file: /saved/0: has no 'found'"));
  const std::string text = to_json(sample());
  for (std::size_t size = 0; size + 1 < text.size(); size += 97) {
    EXPECT_FALSE(parse_checkpoint(text.substr(0, size), "file")) << size;
  }
}

TEST(DigestOf, TellsCasesApart) {
  cases::Case other = square();
  other.positions[0].x = std::nextafter(other.positions[0].x, 0.0F);
  EXPECT_EQ(digest_of({square()}), digest_of({square()}));
  EXPECT_NE(digest_of({square()}), digest_of({other}));
  EXPECT_NE(digest_of({square()}), digest_of({square(), square()}));
  EXPECT_NE(digest_of({square(), other}), digest_of({other, square()}));
  EXPECT_EQ(digest_of({}).size(), 16U);
}

}  // namespace
}  // namespace rastercheck::properties::checkpoint_test
