#include "cases/json_node.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "cases/json.h"
#include "cases/names.h"

namespace rastercheck::cases::json_node_test {
namespace {

using nlohmann::json;

/// A document, and the error of reading it.
class Document {
 public:
  explicit Document(std::string_view text) : document_(parse_json(text, "f.json").value()) {}

  JsonNode root() { return JsonNode(reading_); }
  /// "place: reason"; empty as long as there is no error.
  std::string error() const {
    return reading_.error ? reading_.error->place + ": " + reading_.error->reason : "";
  }

 private:
  json document_;
  std::string file_ = "f.json";
  JsonNode::Reading reading_{document_, file_};
};

/// The error of reading a text with `read`.
template <typename Read>
std::string error_of(std::string_view text, const Read& read) {
  Document document(text);
  read(document.root());
  return document.error();
}

// Kills: an element's place given as its container's; the place of an equal value before it; a
// missing member's place given as the object's.
TEST(JsonNode, NamesThePlaceOfEveryValue) {
  constexpr std::string_view kText = R"({"a": [1, {"b/c": [1, 1]}], "z": {}})";
  const auto place_of = [&](const auto& find) {
    return error_of(kText, [&](const JsonNode& root) { find(root).refuse("."); });
  };
  const auto inner = [](const JsonNode& root) { return root["a"].elements()[1]; };
  EXPECT_EQ(place_of([](const JsonNode& root) { return root; }), "/: .");
  EXPECT_EQ(place_of(inner), "/a/1: .");
  EXPECT_EQ(place_of([&](const JsonNode& root) { return inner(root)["b/c"].elements()[1]; }),
            "/a/1/b~1c/1: .");
  EXPECT_EQ(
      place_of([&](const JsonNode& root) { return inner(root)["b/c"].two_elements("").first; }),
      "/a/1/b~1c/0: .");
  EXPECT_EQ(place_of([&](const JsonNode& root) { return inner(root)["d"]["e"]; }), "/a/1/d/e: .");
}

// Kills: keeping the last error instead of the first.
TEST(JsonNode, KeepsTheFirstError) {
  Document document(R"({"a": 1, "b": 2})");
  document.root()["b"].refuse("one");
  document.root()["a"].refuse("two");
  EXPECT_EQ(document.error(), "/b: one");
  EXPECT_TRUE(document.root().failed());
}

TEST(JsonNode, ObjectsHaveAllRequiredKeysAndNoOthers) {
  const auto expect = [](const JsonNode& node) { node.expect_object({"a"}, {"b"}); };
  EXPECT_EQ(error_of(R"({"a": 1})", expect), "");
  EXPECT_EQ(error_of(R"({"a": 1, "b": 1})", expect), "");
  EXPECT_EQ(error_of(R"({"b": 1})", expect), "/: missing key 'a'");
  EXPECT_EQ(error_of(R"({"a": 1, "c/d": 1})", expect), "/c~1d: unknown key 'c/d'");
  EXPECT_EQ(error_of("[]", expect), "/: must be an object");
}

TEST(JsonNode, MembersThatAreMissingAreNull) {
  Document document(R"({"a": {"b": "x"}})");
  EXPECT_TRUE(document.root().has("a"));
  EXPECT_FALSE(document.root().has("b"));
  EXPECT_EQ(document.root()["a"]["b"].text(), "x");
  EXPECT_EQ(document.root()["c"]["d"].text(), "");
  EXPECT_EQ(document.error(), "/c/d: must be a string");
}

TEST(JsonNode, ListsKeysAndElements) {
  Document document(R"({"b": [7, 8], "a": 1})");
  EXPECT_EQ(document.root().keys(), (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(document.root()["b"].elements().size(), 2U);
  EXPECT_EQ(document.root()["b"].elements()[1].count(), 8U);
  EXPECT_EQ(document.root()["b"].two_elements("this and that").second.count(), 8U);
  EXPECT_EQ(document.error(), "");
}

TEST(JsonNode, RefusesArraysOfAnotherSize) {
  const std::string_view text = R"({"a": [7, 8], "b": 1})";
  EXPECT_EQ(error_of(text, [](const JsonNode& node) { node.keys(); }), "");
  EXPECT_EQ(error_of("3", [](const JsonNode& node) { node.keys(); }), "/: must be an object");
  EXPECT_EQ(error_of(text, [](const JsonNode& node) { node["b"].elements(); }),
            "/b: must be an array");
  EXPECT_EQ(error_of(text, [](const JsonNode& node) { node["a"].elements(3, 3, "numbers"); }),
            "/a: must have 3 numbers, not 2");
  EXPECT_EQ(error_of(text, [](const JsonNode& node) { node["a"].elements(3, 4, "numbers"); }),
            "/a: must have 3 to 4 numbers, not 2");
  EXPECT_EQ(error_of("[1]", [](const JsonNode& node) { node.two_elements("this and that"); }),
            "/: must be an array of two: this and that");
  EXPECT_EQ(error_of("[1, -1]", [](const JsonNode& node) { node.elements()[1].count(); }),
            "/1: must be an integer from 0 to 18446744073709551615");
}

TEST(JsonNode, EnumeratorsHaveTheirNames) {
  Document document(R"(["d3d", "cw"])");
  EXPECT_EQ(document.root().elements()[0].enumerator<Rules>(), Rules::d3d);
  EXPECT_EQ(document.root().elements()[1].enumerator<FrontFace>(), FrontFace::cw);
  EXPECT_EQ(document.error(), "");
  const auto refusal = [](const auto& read) { return error_of(R"("three")", read); };
  EXPECT_EQ(refusal([](const JsonNode& node) { node.enumerator<Rules>(); }),
            "/: must be opengl, vulkan or d3d");
  EXPECT_EQ(refusal([](const JsonNode& node) { node.enumerator<FrontFace>(); }),
            "/: must be ccw or cw");
}

TEST(JsonNode, IntegersMayBeIntegralFloats) {
  Document document("[64.0, -3, 9007199254740992.0, 18446744073709551615]");
  const auto elements = document.root().elements();
  EXPECT_EQ(elements[0].integer(0, 64), 64);
  EXPECT_EQ(elements[1].integer(-3, 0), -3);
  EXPECT_EQ(elements[2].unsigned_integer(), std::uint64_t{1} << 53U);
  EXPECT_EQ(elements[3].unsigned_integer(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(document.error(), "");
  const auto small = [](const JsonNode& node) { node.integer(0, 9); };
  EXPECT_EQ(error_of("10", small), "/: out of range: must be an integer from 0 to 9");
  EXPECT_EQ(error_of("18446744073709551615", small),
            "/: out of range: must be an integer from 0 to 9");
  EXPECT_EQ(error_of("0.5", small), "/: must be an integer");
  EXPECT_EQ(error_of("true", small), "/: must be an integer");
  EXPECT_EQ(error_of("-1", [](const JsonNode& node) { node.unsigned_integer(); }),
            "/: out of range: must be an integer from 0 to 18446744073709551615");
}

// Kills: converting counts to doubles.
TEST(JsonNode, CountsAreWrittenAsIntegers) {
  Document document("[18446744073709551615, 7]");
  EXPECT_EQ(document.root().elements()[0].count(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(document.root().elements()[1].count<std::uint32_t>(7), 7U);
  EXPECT_EQ(document.error(), "");
  for (const char* text : {"7.0", "-0", "8", "\"7\"", "null"}) {
    EXPECT_EQ(error_of(text, [](const JsonNode& node) { node.count<std::uint32_t>(7); }),
              "/: must be an integer from 0 to 7")
        << text;
  }
  Document counts(R"({"a": 1, "b": 2})");
  EXPECT_EQ(counts.root().counts_by_name(),
            (std::map<std::string, std::uint64_t>{{"a", 1}, {"b", 2}}));
  EXPECT_EQ(error_of(R"({"a": 1.5})", [](const JsonNode& node) { node.counts_by_name(); }),
            "/a: must be an integer from 0 to 18446744073709551615");
}

TEST(JsonNode, FloatsAreExact) {
  Document document(R"([0.5, "0x1.8p-2", -0, 3])");
  const auto elements = document.root().elements();
  EXPECT_EQ(elements[0].float32(), 0.5F);
  EXPECT_EQ(elements[1].float32(), 0.375F);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(elements[2].float32()), 0x80000000U);
  EXPECT_EQ(elements[3].float32(0, 3), 3.0F);
  EXPECT_EQ(elements[1].hex_float32(), 0.375F);
  EXPECT_EQ(document.error(), "");
  const auto read = [](const JsonNode& node) { node.float32(0, 3); };
  EXPECT_EQ(error_of("0.1", read),
            "/: not exactly a float32: 0.1; the nearest is \"0x1.99999ap-4\"");
  EXPECT_EQ(error_of("1e39", read), "/: not exactly a float32: 1e+39");
  EXPECT_EQ(error_of("4", read), "/: out of range: must be from 0 to 3");
  EXPECT_EQ(error_of(R"("x")", read),
            "/: must be a number or a hex float such as \"0x1.8p-2\", not \"x\"");
  EXPECT_EQ(error_of(R"("0x1.0000001p0")", read), "/: not exactly a float32: 0x1.0000001p0");
  EXPECT_EQ(error_of("null", read), "/: must be a number or a hex-float string");
  EXPECT_EQ(error_of("0.5", [](const JsonNode& node) { node.hex_float32(); }),
            "/: must be a string");
}

// Kills: an integer rounded in the conversion to a double.
TEST(JsonNode, DoublesAreExactAndMayBeInfinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Document document(R"([0.1, "inf", "-inf", 9007199254740991, -3])");
  const auto elements = document.root().elements();
  EXPECT_EQ(elements[0].float64(), 0.1);
  EXPECT_EQ(elements[1].float64(), kInfinity);
  EXPECT_EQ(elements[2].float64(), -kInfinity);
  EXPECT_EQ(elements[3].float64(), 9007199254740991.0);
  EXPECT_EQ(elements[4].float64(), -3);
  EXPECT_EQ(document.error(), "");
  const auto read = [](const JsonNode& node) { node.float64(); };
  EXPECT_EQ(error_of("9007199254740993", read),
            "/: not exactly a double: write it with a decimal point or an exponent");
  EXPECT_EQ(error_of(R"("nan")", read), "/: must be a number, \"inf\" or \"-inf\"");
  for (const double value : {0.1, -0.0, kInfinity, -kInfinity, 0x1p-1074}) {
    Document again(float64_to_json(value).dump());
    EXPECT_EQ(std::bit_cast<std::uint64_t>(again.root().float64()),
              std::bit_cast<std::uint64_t>(value));
  }
}

TEST(JsonNode, TextsAndBooleans) {
  Document document(R"(["a", true])");
  const auto elements = document.root().elements();
  EXPECT_TRUE(elements[0].is_string());
  EXPECT_FALSE(elements[1].is_string());
  EXPECT_TRUE(elements[1].boolean());
  EXPECT_EQ(document.error(), "");
  EXPECT_EQ(error_of("1", [](const JsonNode& node) { node.boolean(); }),
            "/: must be true or false");
  EXPECT_EQ(error_of("1", [](const JsonNode& node) { node.text(); }), "/: must be a string");
}

}  // namespace
}  // namespace rastercheck::cases::json_node_test
