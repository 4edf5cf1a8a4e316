#include "records/case_record_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "records/record.h"

namespace rastercheck::records::case_record_json_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

CaseRecordSet two_cases() {
  CaseRecord of_corpus;
  of_corpus.name = "a sliver";
  of_corpus.stratum = kCorpusStratum;
  of_corpus.outcome = CaseOutcome::known;
  of_corpus.source_digest = 1;
  of_corpus.found_digest = std::numeric_limits<std::uint64_t>::max();
  of_corpus.mismatches = 3;
  WorstError worst;
  worst.error = {-0.5, -0.5};
  worst.exact = "84/5";
  worst.actual = 16.5F;
  worst.case_index = 3;
  worst.case_name = "a sliver";
  worst.place.triangle = 1;
  worst.place.x = 2;
  worst.place.y = 7;
  worst.place.sample = 5;
  worst.attribute = 4;
  of_corpus.worst[AttributeKind::smooth][Stratum::sliver] = worst;
  worst.attribute.reset();
  of_corpus.worst[AttributeKind::depth][Stratum::near_horizon] = worst;
  CaseRecord random;
  random.stratum = "grid";
  return {{{"a law", "cpu", Origin::corpus, 3}, of_corpus},
          {{"a law", "cpu", Origin::random, 3}, random}};
}

Result<CaseRecordSet> read_back(const json& array) {
  return cases::read_json(array.dump(), "cases", &cases::read_as<CaseRecordSet>);
}

TEST(CaseRecordJson, IsReadBack) {
  const json array = cases::json_of(two_cases());
  const json& first = array.at(0);
  EXPECT_EQ(first["source"], "0000000000000001");
  EXPECT_EQ(first["found"], "ffffffffffffffff");
  EXPECT_EQ(first["worst"]["smooth"]["sliver"]["actual"], "0x1.08p+4");
  EXPECT_FALSE(first["worst"]["smooth"]["sliver"].contains("case"));
  EXPECT_FALSE(first["worst"]["depth"]["near horizon"].contains("attribute"));
  EXPECT_EQ(read_back(array).value(), two_cases());
}

// Members that most cases do not have take no space.
TEST(CaseRecordJson, OmitsAbsentMembers) {
  const json second = cases::json_of(two_cases()).at(1);
  EXPECT_EQ(second.size(), 8U);
  for (const char* key : {"name", "mismatches", "worst"}) EXPECT_FALSE(second.contains(key)) << key;
}

TEST(CaseRecordJson, RefusesWhatCannotBe) {
  const json good = cases::json_of(two_cases());
  const auto reason_of = [&good](const auto& damage) {
    json array = good;
    damage(array);
    const Result<CaseRecordSet> read = read_back(array);
    return read ? "" : read.error().place + ": " + read.error().reason;
  };
  EXPECT_THAT(reason_of([](json& array) { array[1] = array[0]; }), HasSubstr("a second record"));
  for (const char* text : {"", "1", "000000000000000G", "000000000000000A", "+00000000000000a"}) {
    EXPECT_EQ(reason_of([text](json& array) { array[1]["found"] = text; }),
              "/1/found: must be 16 hexadecimal digits")
        << text;
  }
  EXPECT_THAT(reason_of([](json& array) { array[0]["outcome"] = "lost"; }),
              HasSubstr("/0/outcome: "));
  EXPECT_THAT(reason_of([](json& array) { array[0]["worst"]["smooth"]["steep"] = {}; }),
              HasSubstr("/0/worst/smooth"));
  EXPECT_THAT(reason_of([](json& array) { array[0].erase("source"); }), HasSubstr("source"));
}

}  // namespace
}  // namespace rastercheck::records::case_record_json_test
