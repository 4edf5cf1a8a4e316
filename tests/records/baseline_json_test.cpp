#include "records/baseline_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/records/sample_look.h"
#include "tests/records/sample_sections.h"

namespace rastercheck::records::baseline_json_test {
namespace {

using testing::HasSubstr;

Baseline sample_baseline() {
  BaselineSection specific = sample_section();
  specific.specimens = {sample_specimen()};
  specific.key.instruction_set = "avx2";
  specific.key.compiler = "GNU 12.2.0";
  specific.plan.contract.emplace().file = "lax.json";
  specific.plan.contract->terms.keeps_constants = false;
  specific.approvals = {{"because \"so\"", "0.1.0", "c0ffee", {"a: worst 0.5 → 0.6 ULP", "b"}}};
  specific.entries[kSampleCoverage].cases = {20, 3, 2, 1};
  specific.entries[kSampleCoverage].classes[FragmentClass::missing] = 2;
  specific.laws[kSampleLaw].cases[kSampleCase].mismatches = 4;
  specific.laws[kSampleLaw].cases[kSampleCase].outcome = CaseOutcome::violated;
  WorstError corpus = sample_error(0.5);
  corpus.case_index = 0;
  corpus.case_name = specific.corpus.at(0);
  specific.laws[kSampleLaw].cases[{Origin::corpus, 0}].worst[AttributeKind::depth]
                                                            [Stratum::clipped] = corpus;
  return {{sample_section(), specific}};
}

/// Replaces one part of the sample's text, reads it again, and returns the error.
std::string refusal(const std::string& part, const std::string& by) {
  std::string text = to_json(sample_baseline());
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  if (at == std::string::npos) return "";
  text.replace(at, part.size(), by);
  const Result<Baseline> read = parse_baseline(text, "b.json");
  return read ? "accepted" : to_string(read.error());
}

TEST(BaselineJson, ReadsBackAsItWas) {
  const Baseline baseline = sample_baseline();
  const std::string text = to_json(baseline);
  const Result<Baseline> read = parse_baseline(text, "b.json");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(*read, baseline);
  EXPECT_EQ(to_json(*read), text);
}

// The data that people read has lines of its own, before the data that is only compared.
TEST(BaselineJson, HasAnEntryALine) {
  const std::string text = to_json(sample_baseline());
  EXPECT_THAT(text,
              HasSubstr("\n{\"property\":\"values are <within> bounds\",\"kind\":\"coverage\","
                        "\"cases\":{\"checked\":20,\"not_applicable\":3},"
                        "\"power\":{\"drawings\":7,\"noticed\":6},"
                        "\"classes\":{\"correct\":4}},\n"));
  EXPECT_THAT(text, HasSubstr("\n{\"corpus\":0,\"found\":\"0000000000000009\"},\n{\"random\":12,"));
  EXPECT_LT(text.find("\"entries\": ["), text.find("\"cases\": ["));
  EXPECT_TRUE(text.starts_with("{\n\"format\": \"rastercheck-baseline\",\n\"version\": 3,\n"));
}

TEST(BaselineJson, NamesAPluginByItsPathHoweverWritten) {
  Baseline baseline = sample_baseline();
  baseline.sections.resize(1);
  baseline.sections[0].key.backend = "plugin:./p.so";
  const Result<Baseline> read = parse_baseline(to_json(baseline), "b.json");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->sections[0].key.backend, "plugin:p.so");
}

TEST(BaselineJson, ReadsAnEmptyBaseline) {
  const Result<Baseline> read = parse_baseline(to_json({}), "b.json");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, Baseline());
}

TEST(BaselineJson, RefusesWhatItCannotMean) {
  EXPECT_EQ(refusal("\"version\": 3", "\"version\": 2"), "b.json: /version: version must be 3");
  EXPECT_THAT(refusal("rastercheck-baseline", "rastercheck-run"),
              HasSubstr("/format: must be \"rastercheck-baseline\""));
  EXPECT_THAT(refusal("\"seed\":1", "\"sead\":1"), HasSubstr("b.json: /sections/0"));
  EXPECT_THAT(refusal("\"instruction_set\": \"avx2\",\n\"compiler\": \"GNU 12.2.0\",\n", ""),
              HasSubstr("a second section with the same key"));
  EXPECT_THAT(refusal("\"stratum\":\"sliver\",", ""),
              HasSubstr("a second entry with the same property, kind and stratum"));
  EXPECT_THAT(refusal("\"worst\":[0.625,", "\"worst\":[-0.625,"), HasSubstr("magnitude"));
  EXPECT_THAT(refusal("{\"random\":12,", "{\"corpus\":0,"),
              HasSubstr("a second case with the same number"));
  EXPECT_THAT(refusal("{\"random\":12,", "{\"saved\":12,"), HasSubstr("/cases/"));
  EXPECT_THAT(refusal("\"cases\": [\n{\"property\": \"values",
                      "\"cases\": [\n{\"property\": \"other values"),
              HasSubstr("/property: is not in"));
  EXPECT_THAT(refusal("\"reason\":\"because \\\"so\\\"\"", "\"reason\":\"\""),
              HasSubstr("/reason: must not be empty"));
  EXPECT_THAT(refusal("\"digest\":\"0123456789abcdef\"", "\"digest\":\"123\""),
              HasSubstr("16 hexadecimal digits"));
  EXPECT_THAT(refusal("\"outcome\":\"violated\"", "\"outcome\":\"not applicable\""),
              HasSubstr("/outcome: must be the outcome of a case to which the property applies"));
  EXPECT_THAT(refusal("\"file\":\"lax.json\"", "\"file\":\"\""),
              HasSubstr("/plan/contract/file: must be a file"));
}

}  // namespace
}  // namespace rastercheck::records::baseline_json_test
