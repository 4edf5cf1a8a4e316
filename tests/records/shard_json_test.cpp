#include "records/shard_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/records/sample_shard.h"

namespace rastercheck::records::shard_json_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

Result<Shard> read(const json& document) {
  return cases::read_json(document.dump(), "file", &cases::read_as<Shard>);
}

TEST(ShardJson, ComesBackAsItWas) {
  EXPECT_EQ(read(cases::json_of(sample_shard())).value(), sample_shard());
  EXPECT_EQ(read(cases::json_of(Shard())).value(), Shard());
}

// Kills: writing keys that have no content.
TEST(ShardJson, OmitsAbsentMembers) {
  const json document = cases::json_of(Shard());
  EXPECT_EQ(document.size(), 3U);
}

TEST(ShardJson, IsRefusedWithItsPlace) {
  const auto error = [](const char* pointer, const char* value) {
    json document = cases::json_of(sample_shard());
    document[json::json_pointer(pointer)] = json::parse(value);
    const Result<Shard> shard = read(document);
    return shard ? "was read" : to_string(shard.error());
  };
  EXPECT_THAT(error("/more", "1"), HasSubstr("unknown key"));
  EXPECT_THAT(error("/promises/0", "{}"), HasSubstr("file: /promises/0: missing key"));
  EXPECT_THAT(error("/saved/0/version", "9"), HasSubstr("file: /saved/0/version: "));
  json document = cases::json_of(sample_shard());
  document["saved"][0].erase("found");
  EXPECT_THAT(to_string(read(document).error()), HasSubstr("file: /saved/0: has no 'found'"));
}

}  // namespace
}  // namespace rastercheck::records::shard_json_test
