#include "cases/json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace rastercheck::cases::json_test {
namespace {

using nlohmann::json;
using namespace std::string_view_literals;
using ::testing::HasSubstr;
using ::testing::StartsWith;

json parsed(std::string_view text) {
  const Result<json> document = parse_json(text, "file.json");
  EXPECT_TRUE(document.has_value()) << text << ": " << to_string(document.error());
  return document.value_or(json());
}

/// The error of a text that must be refused. Also checks the error's file.
Error refused(std::string_view text) {
  const Result<json> document = parse_json(text, "file.json");
  EXPECT_FALSE(document.has_value()) << text;
  if (document) return {};
  EXPECT_EQ(document.error().file, "file.json");
  return document.error();
}

std::string nested(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

TEST(ParseJson, GivesTheDocument) {
  EXPECT_EQ(parsed(R"({"a": [1, -2, 0.5, "b", true, false, null], "c": {}})"),
            (json{{"a", {1, -2, 0.5, "b", true, false, nullptr}}, {"c", json::object()}}));
  EXPECT_EQ(parsed("\"text\""), "text");
  EXPECT_EQ(parsed(" [ ] "), json::array());
}

TEST(ParseJson, ADuplicateKeyIsRefusedAtItsPointer) {
  const Error error = refused(R"({"a": [0, {"b": 1, "c": 2, "b": 3}]})");
  EXPECT_EQ(error.place, "/a/1/b");
  EXPECT_THAT(error.reason, HasSubstr("duplicate key 'b'"));
  EXPECT_EQ(refused(R"({"x": 1, "x": 1})").place, "/x");
  EXPECT_EQ(refused(R"({"x": {"y": 1}, "x": 2})").place, "/x");
  EXPECT_EQ(refused(R"({"~/": 1, "~/": 1})").place, "/~0~1");
}

// Kills: comparing keys before their escapes are decoded.
TEST(ParseJson, ADuplicateKeyIsOneHoweverItIsEscaped) {
  EXPECT_EQ(refused(R"({"x": 1, "\u0078": 2})").place, "/x");
}

TEST(ParseJson, TheSameKeyInDifferentObjectsIsNoDuplicate) {
  EXPECT_EQ(parsed(R"({"x": {"x": 1}, "y": [{"x": 2}, {"x": 3}]})")["y"][1]["x"], 3);
}

TEST(ParseJson, MinusZeroKeepsItsSign) {
  for (const char* text : {"-0", "-0.0", "-0e7", "-0.000E-3"}) {
    const json zero = parsed(text);
    ASSERT_TRUE(zero.is_number_float()) << text;
    EXPECT_EQ(zero.get<double>(), 0) << text;
    EXPECT_TRUE(std::signbit(zero.get<double>())) << text;
  }
  EXPECT_FALSE(std::signbit(parsed("0").get<double>()));
  EXPECT_FALSE(std::signbit(parsed("0.0").get<double>()));
}

TEST(ParseJson, IntegersOfSixtyFourBitsAreExact) {
  EXPECT_EQ(parsed("18446744073709551615").get<std::uint64_t>(),
            std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(parsed("-9223372036854775808").get<std::int64_t>(),
            std::numeric_limits<std::int64_t>::min());
}

TEST(ParseJson, ANumberBeyondDoubleIsRefused) {
  for (const char* text : {"1e400", "-1e400", "[1, 1e999999]"}) {
    const Error error = refused(text);
    EXPECT_THAT(error.place, StartsWith("1:")) << text;
    EXPECT_THAT(error.reason, HasSubstr("not valid JSON")) << text;
  }
}

TEST(ParseJson, SixteenLevelsAreReadAndSeventeenRefused) {
  EXPECT_TRUE(parse_json(nested(kMaxJsonDepth), "f").has_value());
  const Error error = refused(nested(kMaxJsonDepth + 1));
  EXPECT_THAT(error.reason, HasSubstr("nested deeper than 16"));
  EXPECT_EQ(error.place, "/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0");
}

TEST(ParseJson, SiblingsDoNotAddToTheDepth) {
  const std::string deep = nested(kMaxJsonDepth - 1);
  EXPECT_TRUE(parse_json("[" + deep + "," + deep + "," + deep + "]", "f").has_value());
}

// Kills: recursion in the parser, or in the destructor of what the parser built.
TEST(ParseJson, AMillionLevelsAreRefusedLikeSeventeen) {
  EXPECT_THAT(refused(std::string(1'000'000, '[')).reason, HasSubstr("nested deeper than 16"));
}

TEST(ParseJson, ANulByteIsRefusedWhereItStands) {
  EXPECT_EQ(refused("[1]\0"sv).place, "1:4");
  EXPECT_EQ(refused("\0"sv).place, "1:1");
  EXPECT_EQ(refused("[1,\n\"a\0b\"]"sv).place, "2:3");
  EXPECT_THAT(refused("[1]\0"sv).reason, HasSubstr("NUL"));
}

TEST(ParseJson, OfAnEmptyFileItSaysThatItIs) {
  for (const char* text : {"", " ", "\r\n\t\n"}) {
    EXPECT_EQ(refused(text).reason, "not valid JSON: empty");
  }
}

TEST(ParseJson, InvalidUtf8IsRefusedWhereItStands) {
  EXPECT_THAT(refused("[\n\"\xff\"]").place, StartsWith("2:"));
  EXPECT_THAT(refused("\"\xc0\x80\"").place, StartsWith("1:"));      // overlong
  EXPECT_THAT(refused("\"\xed\xa0\x80\"").place, StartsWith("1:"));  // a surrogate
  EXPECT_THAT(refused("\"\xe2\x82\"").place, StartsWith("1:"));      // cut short
  EXPECT_EQ(parsed("\"\xe2\x82\xac\""), "\xe2\x82\xac");
}

TEST(ParseJson, ASyntaxErrorIsPlacedAtLineAndColumnFromOne) {
  EXPECT_EQ(refused("{\n  \"a\": 1,\n  b\n}").place, "3:3");
  EXPECT_EQ(refused("}").place, "1:1");
  EXPECT_EQ(refused("[1,\r\n2,\r\n  ?]").place, "3:3");
  EXPECT_EQ(refused("[]\n[]").place, "2:1");
}

TEST(ParseJson, TheReasonIsOneLineThatDoesNotRepeatThePlace) {
  const std::string reason = refused("[1,\n\n  nul\n]").reason;
  EXPECT_THAT(reason, StartsWith("not valid JSON: "));
  EXPECT_THAT(reason, ::testing::Not(HasSubstr("at line")));
  EXPECT_THAT(reason, ::testing::Not(HasSubstr("json.exception")));
  EXPECT_THAT(reason, ::testing::Not(HasSubstr("\n")));
}

TEST(ParseJson, WhatOthersAllowBeyondJsonIsRefused) {
  for (const char* text : {"", " ", "[1,]", "{\"a\":1,}", "// c\n1", "/* c */1", "'a'", "{a:1}",
                           "NaN", "Infinity", "+1", "01", ".5", "1.", "0x1", "[1 2]", "[1]]"}) {
    refused(text);
  }
}

TEST(ChildPointer, EscapesTildeAndSlashAsRfc6901) {
  EXPECT_EQ(child_pointer("", "a"), "/a");
  EXPECT_EQ(child_pointer("/a/0", "b c"), "/a/0/b c");
  EXPECT_EQ(child_pointer("", "a/b"), "/a~1b");
  EXPECT_EQ(child_pointer("", "m~n"), "/m~0n");
  EXPECT_EQ(child_pointer("", "~1"), "/~01");
  EXPECT_EQ(child_pointer("", ""), "/");
  EXPECT_EQ(child_pointer("",
                          "gr\xc3\xb6\xc3\x9f"
                          "e"),
            "/gr\xc3\xb6\xc3\x9f"
            "e");
}

TEST(ChildPointer, StaysOnOneLine) {
  EXPECT_EQ(child_pointer("", "a\nb"), "/a\\nb");
  EXPECT_EQ(child_pointer("", "\0"sv), "/\\u0000");
  EXPECT_EQ(child_pointer("", "\x1b[31m"), "/\\u001b[31m");
}

// Kills: leaving DEL unescaped, the only single-byte control character above 0x1f.
TEST(ChildPointer, HoldsNoDeleteCharacter) {
  EXPECT_THAT(child_pointer("", "\x7f"), ::testing::Not(HasSubstr("\x7f")));
}

TEST(Printable, EscapesControlCharactersOnly) {
  EXPECT_EQ(printable("plain"), "plain");
  EXPECT_EQ(printable("a\"b\\c"), "a\"b\\c");
  EXPECT_EQ(printable("\n\t\x01"), R"(\n\t\u0001)");
  EXPECT_EQ(printable("\0"sv), R"(\u0000)");
  EXPECT_EQ(printable("\xe2\x82\xac"), "\xe2\x82\xac");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, ReplacesInvalidUtf8) { EXPECT_EQ(printable("a\xff"), "a\xef\xbf\xbd"); }

TEST(Printable, HoldsNoDeleteCharacter) {
  EXPECT_THAT(printable("\x7f"), ::testing::Not(HasSubstr("\x7f")));
}

// Kills: escaping only ASCII's control characters. U+009B starts a terminal command.
TEST(OneLine, HoldsNoControlCharacterOfTwoBytes) {
  EXPECT_EQ(one_line("a\xc2\x9b"
                     "31m"),
            "a\\u009b31m");
  EXPECT_EQ(one_line("\xc2\x80\xc2\x85\xc2\x9f"), "\\u0080\\u0085\\u009f");
  EXPECT_EQ(printable("\xc2\x9b"), "\\u009b");
  EXPECT_EQ(child_pointer("", "\xc2\x9b"), "/\\u009b");
  EXPECT_EQ(one_line("\xc2\xa0\xc3\x80\xe2\x80\x9b"), "\xc2\xa0\xc3\x80\xe2\x80\x9b");
}

TEST(OneLine, IsAsLongAsItIsAndTwiceAsOnce) {
  const std::string text = "\n\"\\\x7f\xc2\x9b\xff" + std::string(1000, 'x');
  const std::string line = one_line(text);
  EXPECT_EQ(line, "\\n\"\\\\u007f\\u009b\xef\xbf\xbd" + std::string(1000, 'x'));
  EXPECT_EQ(one_line(line), line);
}

TEST(Printable, ShortensALongTextInTheMiddle) {
  const std::string shown = printable("begin" + std::string(100'000, 'x') + "end");
  EXPECT_LT(shown.size(), 300U);
  EXPECT_THAT(shown, StartsWith("begin"));
  EXPECT_THAT(shown, ::testing::EndsWith("end"));
  EXPECT_THAT(shown, HasSubstr(" ... "));
}

// Kills: cutting a character of several bytes in two and throwing.
TEST(Printable, ALongTextOfManyByteCharactersStaysUtf8) {
  for (std::size_t shift = 0; shift < 3; ++shift) {
    std::string text(shift, 'x');
    for (int i = 0; i < 200; ++i) text += "\xe2\x82\xac";
    EXPECT_TRUE(parse_json("\"" + printable(text) + "\"", "f").has_value()) << shift;
  }
}

TEST(ValidUtf8, ReplacesOnlyWhatIsNone) {
  EXPECT_EQ(valid_utf8("a\n\"\\\xe2\x82\xac"), "a\n\"\\\xe2\x82\xac");
  EXPECT_EQ(valid_utf8("\0"sv), "\0"sv);
  EXPECT_EQ(valid_utf8("a\xff"
                       "b\xc3"),
            "a\xef\xbf\xbd"
            "b\xef\xbf\xbd");
  EXPECT_EQ(valid_utf8(""), "");
}

// Kills: members left out below the document; a member left out with those after it; faults of
// syntax that pass because they are in a member left out.
TEST(Json, LeavesOutMembersOfTheDocument) {
  constexpr std::array<std::string_view, 2> kLeftOut{"b", "d"};
  const auto parsed = [&](std::string_view text) { return parse_json(text, "f", kLeftOut); };
  EXPECT_EQ(parsed(R"({"a": {"b": 1}, "b": [[], {"b": [2]}, {"a": 1}], "c": [], "d": 3, "e": 4})"),
            json::parse(R"({"a": {"b": 1}, "c": [], "e": 4})"));
  EXPECT_EQ(parsed(R"({"b": [1, ], "c": 2})").error().place, "1:11");
  EXPECT_FALSE(parsed(R"({"c": 1, "b": {"c": 1}, "c": 2})"));
}

}  // namespace
}  // namespace rastercheck::cases::json_test
