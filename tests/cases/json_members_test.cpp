#include "cases/json_members.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "cases/json_document.h"

namespace rastercheck::cases::json_members_test {

using nlohmann::json;
using testing::HasSubstr;

struct Point {
  double x = 0;
  bool operator==(const Point&) const = default;
};

/// One member of each form.
struct Box {
  std::uint32_t number = 7;
  std::string name = "a\nb";
  Basis basis = Basis::snapped;
  float weight = std::numeric_limits<float>::infinity();
  std::optional<bool> is_set;
  std::vector<Point> points{{1}, {0.5}};
  std::array<int, 2> pair{-1, 2};
  std::map<Basis, std::uint64_t> counts{{Basis::ideal, 3}};
  std::map<std::string, std::string> texts{{"k", "v"}};
  std::map<std::uint64_t, Point> listed{{4, {2}}};
  std::optional<Point> first = Point{3};
  Point last;
  std::string left = "in";
  std::uint8_t least = 3;
  int later = 5;
  bool operator==(const Box&) const = default;
};

template <typename Archive, Either<Point> T>
void members(Archive& archive, T& point) {
  archive.required("x", point.x);
}

template <typename Archive, Either<std::uint64_t> Key, Either<Point> T>
void members(Archive& archive, Key& key, T& point) {
  archive.required("key", key);
  members(archive, point);
}

template <typename Archive, Either<Box> T>
void members(Archive& archive, T& box) {
  archive.format("box", 3);
  archive.required("number", box.number);
  archive.required("name", box.name);
  archive.optional("basis", box.basis, Basis::snapped);
  archive.required("weight", box.weight);
  archive.optional("is_set", box.is_set);
  archive.required("points", box.points);
  archive.required("pair", box.pair);
  archive.required("counts", box.counts);
  archive.required("texts", box.texts);
  archive.optional_object("first", box.first,
                          [](auto& inner, auto& first) { inner.required("at", first.x); });
  archive.optional_object("last", box.last,
                          [](auto& inner, auto& last) { inner.required("at", last.x); });
  archive.object("inner", [&](auto& inner) { inner.required("left", box.left); });
  archive.list("listed", box.listed, "point of the same key");
  archive.required("least", UpTo{box.least, 9});
  archive.added("later", box.later, -1);
  archive.check([&](const JsonNode& node) {
    if (box.number == 13) node["number"].refuse("is unlucky");
  });
}

namespace {

constexpr const char* kDocument = R"({
"format": "box",
"version": 3,
"number": 7,
"name": "a\nb",
"weight": "inf",
"points": [
{"x":1.0},
{"x":0.5}
],
"pair": [-1,2],
"counts": {"ideal":3},
"texts": {"k":"v"},
"first": {"at":3.0},
"inner": {"left":"in"},
"listed": [
{"key":4,"x":2.0}
],
"least": 3,
"later": 5
})";

std::string refusal(const char* pointer, const json& value) {
  json document = json::parse(kDocument);
  document[json::json_pointer(pointer)] = value;
  const Result<Box> read = read_json(document.dump(), "f", &read_as<Box>);
  return read ? "was read" : to_string(read.error());
}

// Kills: writing members in another order than that of the list of members.
TEST(JsonDocument, HasALineForEachMemberAndElement) { EXPECT_EQ(document_of(Box()), kDocument); }

TEST(JsonMembers, ComeBackAsTheyWere) {
  Box box;
  box.number = 9;
  box.is_set = false;
  box.last.x = 4;
  box.weight = -0x1.8p-3F;
  const json written = json_of(box);
  EXPECT_EQ(written["last"], json::parse(R"({"at": 4})"));
  EXPECT_EQ(read_json(written.dump(), "f", &read_as<Box>).value(), box);
  EXPECT_EQ(read_json(document_of(box), "f", &read_as<Box>).value(), box);
  EXPECT_EQ(read_json(kDocument, "f", &read_as<Box>).value(), Box());
  json old = json::parse(kDocument);
  old.erase("later");
  EXPECT_EQ(read_json(old.dump(), "f", &read_as<Box>).value().later, -1);
}

TEST(JsonMembers, AreRefusedWhereTheyAreNot) {
  EXPECT_EQ(refusal("/number", 8), "was read");
  EXPECT_EQ(refusal("/number", 13), "f: /number: is unlucky");
  EXPECT_EQ(refusal("/version", 2), "f: /version: version must be 3");
  EXPECT_EQ(refusal("/more", 1), "f: /more: unknown key 'more'");
  EXPECT_EQ(refusal("/points/0/more", 1), "f: /points/0/more: unknown key 'more'");
  EXPECT_EQ(refusal("/pair", {1}), "f: /pair: must have 2 elements, not 1");
  EXPECT_EQ(refusal("/least", 10), "f: /least: must be an integer from 0 to 9");
  EXPECT_EQ(refusal("/counts/real", 1), "f: /counts/real: unknown key 'real'");
  EXPECT_EQ(refusal("/listed/1", {{"key", 4}, {"x", 1.5}}),
            "f: /listed/1: a second point of the same key");
  EXPECT_THAT(refusal("/weight", "heavy"), HasSubstr("must be the hex float"));
}

}  // namespace
}  // namespace rastercheck::cases::json_members_test
