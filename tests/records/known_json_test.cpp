#include "records/known_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace rastercheck::records::known_json_test {
namespace {

using nlohmann::json;
using testing::ElementsAre;

constexpr const char* kList = R"({
  "format": "rastercheck-known", "version": 1,
  "driver": {"name": "llvmpipe", "version": "Mesa 22.3.6"},
  "entries": [{"id": "llvmpipe-1", "reason": "Why.", "rule": "14.6.1", "finding": "llvmpipe-1",
    "properties": ["a law", "*edge*"], "verdicts": ["beyond bound", "crash"],
    "when": {"rules": ["vulkan"], "primitive": ["triangles", "lines"], "samples": [2, 4], "attribute_kind": ["depth"],
      "interpolation": ["noperspective"], "location": ["centroid"], "note": "lost",
      "nonpositive_w": true, "depth_clamp": false, "error_at_most": 1e6, "height_at_most": 1},
    "case": "known/llvmpipe-1.json"}]
})";

TEST(KnownJson, ReadsAllThereIs) {
  const KnownList list = parse_known(kList, "f").value();
  EXPECT_EQ(list.driver, (KnownDriver{"llvmpipe", "Mesa 22.3.6"}));
  ASSERT_EQ(list.entries.size(), 1U);
  const KnownEntry& entry = list.entries[0];
  EXPECT_EQ(entry.id, "llvmpipe-1");
  EXPECT_EQ(entry.reason, "Why.");
  EXPECT_EQ(entry.rule, "14.6.1");
  EXPECT_EQ(entry.finding, "llvmpipe-1");
  EXPECT_THAT(entry.laws, ElementsAre("a law", "*edge*"));
  EXPECT_THAT(entry.verdicts, ElementsAre(FragmentClass::beyond_bound, FragmentClass::crash));
  EXPECT_EQ(entry.case_file, "known/llvmpipe-1.json");
  EXPECT_EQ(entry.when,
            (KnownConditions{{cases::Rules::vulkan},
                             {cases::Primitive::triangles, cases::Primitive::lines},
                             {2, 4},
                             {AttributeKind::depth},
                             {cases::Interpolation::noperspective},
                             {cases::Location::centroid},
                             {{KnownFact::nonpositive_w, true}, {KnownFact::depth_clamp, false}},
                             {{KnownLimit::error_at_most, 1e6}, {KnownLimit::height_at_most, 1}},
                             "lost"}));
}

TEST(KnownJson, ComesBackAsItWas) {
  const KnownList list = parse_known(kList, "f").value();
  EXPECT_EQ(parse_known(cases::json_of(list).dump(), "f").value(), list);
}

TEST(KnownJson, TakesEveryFactAndLimitByItsName) {
  json document = json::parse(kList);
  json when = json::object();
  for (const auto name : names_of(KnownFact{})) when[std::string(name)] = true;
  for (const auto name : names_of(KnownLimit{})) when[std::string(name)] = 1;
  document["entries"][0]["when"] = when;
  const KnownConditions read = parse_known(document.dump(), "f").value().entries[0].when;
  EXPECT_EQ(read.facts.size(), names_of(KnownFact{}).size());
  EXPECT_EQ(read.limits.size(), names_of(KnownLimit{}).size());
}

constexpr const char* kWaivers = R"({
  "format": "rastercheck-known", "version": 1,
  "entries": [{"id": "mine-1", "reason": "Why.", "backends": ["plugin:libmine.so"],
    "verdicts": ["extra"], "when": {"tie": true}, "case": "known/mine-1.json",
    "until": "2027-02-28"}]
})";

TEST(KnownJson, OfNoDriverMayLackRulesAndLaws) {
  const KnownList list = parse_known(kWaivers, "f").value();
  EXPECT_EQ(list.driver, std::nullopt);
  const KnownEntry& entry = list.entries.at(0);
  EXPECT_THAT(entry.backends, ElementsAre("plugin:libmine.so"));
  EXPECT_TRUE(entry.laws.empty());
  EXPECT_EQ(entry.until, "2027-02-28");
  EXPECT_EQ(parse_known(cases::json_of(list).dump(), "f").value(), list);
}

// Kills: a waiver that never ends, because its last day does not exist.
TEST(KnownJson, RefusesInvalidDates) {
  for (const char* const day : {"2027-02-29", "2027-13-01", "27-01-01", "2027-1-1", "2027-01-0x"}) {
    json document = json::parse(kWaivers);
    document["entries"][0]["until"] = day;
    const Result<KnownList> read = parse_known(document.dump(), "f");
    ASSERT_FALSE(read) << day;
    EXPECT_EQ(to_string(read.error()),
              "f: /entries/0/until: must be a date such as \"2027-01-31\"");
  }
}

// Kills: an expectation that hides more than its law.
TEST(KnownJson, ExpectationsNameLawsAndNothingElse) {
  json document = json::parse(kWaivers);
  document["entries"][0] = {
      {"id", "a"}, {"reason", "b"}, {"properties", {"a"}}, {"expected", "fail"}};
  EXPECT_TRUE(parse_known(document.dump(), "f"));
  document["entries"][0].erase("properties");
  EXPECT_FALSE(parse_known(document.dump(), "f"));
  document["entries"][0]["properties"] = {"a"};
  document["entries"][0]["verdicts"] = {"extra"};
  EXPECT_FALSE(parse_known(document.dump(), "f"));
}

/// The error of the list after the value at a pointer is replaced, or removed if `value` is empty.
std::string refusal(const char* pointer, const std::optional<json>& value) {
  const json::json_pointer place(pointer);
  json document = json::parse(kList);
  if (value) {
    document[place] = *value;
  } else {
    document[place.parent_pointer()].erase(place.back());
  }
  const Result<KnownList> read = parse_known(document.dump(), "f");
  return read ? "was read" : to_string(read.error());
}

TEST(KnownJson, IsRefusedWhereItIsNot) {
  EXPECT_EQ(refusal("/format", "rastercheck-case"),
            "f: /format: must be \"rastercheck-known\", not \"rastercheck-case\"");
  EXPECT_EQ(refusal("/version", 2), "f: /version: version must be 1");
  EXPECT_EQ(refusal("/driver/name", ""), "f: /driver/name: must not be empty");
  EXPECT_EQ(refusal("/entries/0/reason", "a\nb"), "f: /entries/0/reason: must be one line");
  EXPECT_EQ(refusal("/entries/0/verdicts/0", "correct"),
            "f: /entries/0/verdicts: must not contain \"correct\"");
  EXPECT_EQ(refusal("/entries/0/when", json::object()),
            "f: /entries/0/when: must have a condition: without one it would hide every "
            "new fault that these properties find");
  for (const char* outside : {"/etc/passwd", "../case.json", "known/../../case.json"}) {
    EXPECT_EQ(refusal("/entries/0/case", outside),
              "f: /entries/0/case: must be a file in the folder of the list");
  }
  json twice = json::parse(kList)["entries"];
  twice.push_back(twice[0]);
  EXPECT_EQ(refusal("/entries", twice), "f: /entries/1/id: is also the id of another entry");
}

TEST(KnownJson, IsRefusedWithAnythingMissingOrUnknown) {
  for (const char* key :
       {"id", "reason", "rule", "finding", "properties", "verdicts", "when", "case"}) {
    EXPECT_NE(refusal((std::string("/entries/0/") + key).c_str(), std::nullopt), "was read") << key;
  }
  for (const char* place : {"/more", "/driver/more", "/entries/0/more", "/entries/0/when/more"}) {
    EXPECT_NE(refusal(place, 1), "was read") << place;
  }
  for (const char* place : {"/entries/0/properties", "/entries/0/verdicts", "/entries/0/when/rules",
                            "/entries/0/when/samples", "/entries/0/when/location"}) {
    EXPECT_NE(refusal(place, json::array()), "was read") << place;
  }
}

TEST(KnownJson, OfARunComesBackAsItWas) {
  const KnownOfBackend known{
      "gl:llvmpipe", "known.json", "Mesa 23", parse_known(kList, "f").value(), {"llvmpipe-1"}};
  EXPECT_EQ(
      cases::read_json(cases::json_of(known).dump(), "f", &cases::read_as<KnownOfBackend>).value(),
      known);
  const UnexpectedPass pass{"gl:llvmpipe", "llvmpipe-1", "a law", Staleness::other_version};
  EXPECT_EQ(
      cases::read_json(cases::json_of(pass).dump(), "f", &cases::read_as<UnexpectedPass>).value(),
      pass);
}

}  // namespace
}  // namespace rastercheck::records::known_json_test
