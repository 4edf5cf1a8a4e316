#include "records/share.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>

namespace rastercheck::records::share_test {
namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();

TEST(ShareText, IsInPercent) {
  EXPECT_EQ(share_text(0, 0), "–");
  EXPECT_EQ(share_text(0, 7), "0%");
  EXPECT_EQ(share_text(7, 7), "100%");
  EXPECT_EQ(share_text(1, 2), "50%");
  EXPECT_EQ(share_text(1, 3), "33.3%");
  EXPECT_EQ(share_text(2, 3), "66.7%");
  EXPECT_EQ(share_text(1, 100), "1%");
  EXPECT_EQ(share_text(3, 1000), "0.3%");
  EXPECT_EQ(share_text(9999, 10000), "99.99%");
  EXPECT_EQ(share_text(1234, 10000000), "0.012%");
  EXPECT_EQ(share_text(4, 10000000), "0.00004%");
}

// Kills: "0%" of something that exists; "100%" of something that is not everything.
TEST(ShareText, IsExactly0Or100PercentOnlyForNoneOrAll) {
  EXPECT_EQ(share_text(1, kMost), "0.0000000000000000054%");
  EXPECT_EQ(share_text(kMost - 1, kMost), "99.9999999999999999946%");
  EXPECT_EQ(share_text(1, 201), "0.5%");
  EXPECT_EQ(share_text(199999, 200000), "99.9995%");
  EXPECT_EQ(share_text(kMost / 2, kMost), "50%");
}

/// The percentage that a text gives, to double precision.
double in_percent(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

// Kills: rounding the rest separately; one digit too few.
RC_GTEST_PROP(ShareText, IsCloseToTheShareAndItsRestToTheRest, ()) {
  const auto whole = *rc::gen::inRange<std::uint64_t>(1, 1ULL << 40);
  const auto part = *rc::gen::inRange<std::uint64_t>(0, whole + 1) >> *rc::gen::inRange(0, 40);
  const std::string text = share_text(part, whole);
  RC_ASSERT((text == "0%") == (part == 0));
  RC_ASSERT((text == "100%") == (part == whole));
  const double exact = 100 * static_cast<double>(part) / static_cast<double>(whole);
  // Half a unit in the second digit of 1.0 is 1/20 of the number.
  if (2 * part <= whole) RC_ASSERT(std::abs(in_percent(text) - exact) <= exact * 0.0501);
  // Percentages of 0.01 and more are exact to far more digits as doubles than the texts show.
  const double rest = in_percent(share_text(whole - part, whole));
  RC_ASSERT(std::abs(in_percent(text) + rest - 100) <= 1e-13);
}

TEST(LevelsText, NamesEveryLevel) {
  EXPECT_EQ(
      levels_text({99990000 - 40, 10000, 40}, 0),
      "99.99% by fast arithmetic, 0.01% by interval arithmetic, 0.00004% by exact arithmetic");
  EXPECT_EQ(levels_text({5, 0, 0}, 0),
            "100% by fast arithmetic, 0% by interval arithmetic, 0% by exact arithmetic");
  EXPECT_EQ(levels_text({}, 0), "");
}

// Kills: "100%" of the questions that were answered, instead of all questions.
TEST(LevelsText, CountsTheUndecidedAsAsked) {
  EXPECT_EQ(levels_text({3, 0, 0}, 1),
            "75% by fast arithmetic, 0% by interval arithmetic, 0% by exact arithmetic");
}

TEST(DecidedSentence, SaysWhatIsKnown) {
  EXPECT_EQ(decided_sentence({}, 7), "");
  EXPECT_EQ(decided_sentence({{1, 1, 0}, {}}, 0),
            "Samples decided: 50% by fast arithmetic, 50% by interval arithmetic, 0% by exact "
            "arithmetic; 0 undecided.");
  EXPECT_EQ(decided_sentence({{}, {0, 0, 2}}, 0),
            "Values decided: 0% by fast arithmetic, 0% by interval arithmetic, 100% by exact "
            "arithmetic.");
  EXPECT_EQ(decided_sentence({{3, 0, 0}, {2, 0, 0}}, 1),
            "Samples decided: 75% by fast arithmetic, 0% by interval arithmetic, 0% by exact "
            "arithmetic; 1 undecided. Values decided: 100% by fast arithmetic, 0% by interval "
            "arithmetic, 0% by exact arithmetic.");
}

}  // namespace
}  // namespace rastercheck::records::share_test
