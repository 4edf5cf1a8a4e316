#include "properties/campaign/trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "tests/properties/damaged_backend.h"
#include "tests/temporary_folder.h"

namespace rastercheck::properties::trial_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Outcome = Trial::Outcome;

constexpr const char* kCoverage = "coverage-obeys-the-contract";

/// Loses pixel (7, 7) of each triangle, in smaller cases too.
void lose_corner(const cases::Case& c, cases::Fragments& drawn) {
  for (std::uint32_t triangle = 0; triangle < c.triangles.size(); ++triangle) {
    if (find(drawn, triangle, 7, 7) < drawn.size()) drop(drawn, triangle, 7, 7);
  }
}

/// The law of coverage, with the square as its only random case.
Law law_of_squares() {
  Law law = *find_law(kCoverage);
  law.generate = [](Draw&) { return Generated{square(), "squares"}; };
  return law;
}

/// Draws every other case, and reports the cases in between as unsupported.
class LimitedBackend : public DamagedBackend {
 public:
  backends::About about() const override { return {.has_limits = true}; }
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    if (++asked_ % 2 == 1) return DamagedBackend::draw_fragments(c);
    return tl::unexpected(Error{"", "", "not of this kind", Failure::unsupported});
  }

 private:
  int asked_ = 0;
};

/// A backend that is lost before it draws anything.
class LostBackend : public DamagedBackend {
 public:
  std::optional<Error> is_lost() const override { return Error{"", "", "gone for good"}; }
};

/// Never draws, and gives a reason.
class FailingBackend : public DamagedBackend {
 public:
  Result<cases::Fragments> draw_fragments(const cases::Case& /*c*/) override {
    return tl::unexpected(Error{"", "", "out of memory"});
  }
};

MakeTried damaged(Damage damage) {
  return [damage = std::move(damage)] { return std::make_unique<DamagedBackend>(damage); };
}

TrialOptions few_cases() {
  TrialOptions options;
  options.seed = 7;
  options.cases = 3;
  return options;
}

/// Reads the case file at the end of a text.
cases::Case case_in(const std::string& text) {
  const std::size_t begin = text.find("\n{\n");
  return cases::parse_case(text.substr(begin == std::string::npos ? text.size() : begin), "text")
      .value_or(cases::Case());
}

/// Environment variables that are unset when this object is destroyed.
class Environment {
 public:
  Environment() { clear(); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() { clear(); }

  void set(const char* variable, const std::string& value) { ::setenv(variable, value.c_str(), 1); }

 private:
  static void clear() {
    for (const char* variable :
         {"RASTERCHECK_SEED", "RASTERCHECK_CASES", "RASTERCHECK_CORPUS", "RASTERCHECK_OUTPUT"}) {
      ::unsetenv(variable);
    }
  }
};

// Kills: fewer cases than were asked for; the same case again and again.
TEST(TryLaw, ChecksTheRandomCasesOfACampaign) {
  const TemporaryFolder corpus;
  cases::Case first = square();
  first.name = "from the corpus";
  corpus.put("square.json", cases::to_json(first));
  std::vector<cases::Case> drawn;
  const Law& law = *find_law(kCoverage);
  TrialOptions options = few_cases();
  options.corpus = corpus.path();
  const Trial trial = try_law(
      law, "Mine",
      damaged([&drawn](const cases::Case& c, cases::Fragments&) { drawn.push_back(c); }), options);
  EXPECT_EQ(trial.outcome, Outcome::held) << trial.text;
  EXPECT_EQ(trial.text, "");
  ASSERT_EQ(drawn.size(), 4U);
  EXPECT_EQ(drawn[0], first);
  for (std::uint64_t i = 0; i < 3; ++i) {
    Draw draw = draw_of(*find_law(kCoverage), 7, i);
    EXPECT_EQ(drawn[i + 1].triangles, law.generate(draw).source.triangles) << i;
  }
}

// Kills: a message that does not name the place; the case as it was found instead of the smaller
// one.
TEST(TryLaw, TellsAStrangerWhatIsWrong) {
  const Trial trial = try_law(law_of_squares(), "Mine", damaged(&lose_corner), few_cases());
  EXPECT_EQ(trial.outcome, Outcome::failed);
  EXPECT_THAT(
      trial.text,
      AllOf(HasSubstr("Mine violates the property “coverage obeys the contract”: missing\n"),
            HasSubstr("Found in case 0 of seed 7, shrunk in"),
            HasSubstr("  pixel (7, 7), sample 0 of triangle 0, coverage\n"
                      "    exactly: required: inside\n"
                      "    drawn:   not drawn\n"),
            HasSubstr("[-]"), HasSubstr("rastercheck replay - --backend cpu")));
  const cases::Case smaller = case_in(trial.text);
  EXPECT_EQ(smaller.found,
            (cases::Found{kCoverage, "Mine", "missing", 7, 0, "coverage", "ordinary"}));
  EXPECT_THAT(smaller.triangles, ElementsAre(testing::_));
}

// Kills: a test for each property, and no word that they fail for one reason.
TEST(TryLaw, NamesOtherPropertiesThatTheCaseViolates) {
  const Trial wrong_places = try_law(law_of_squares(), "Mine", damaged(&lose_corner), few_cases());
  EXPECT_THAT(wrong_places.text,
              AllOf(HasSubstr("  Also violated by this case, probably for the same reason:\n"),
                    HasSubstr("    “vertex order changes nothing beyond the bound”\n"),
                    Not(HasSubstr("    “coverage obeys the contract”\n")),
                    Not(HasSubstr("    “values stay within the bound”\n"))));
}

TEST(TryLaw, GivesAHint) {
  const auto upside_down = [](const cases::Case& c, cases::Fragments& drawn) {
    for (auto& y : drawn.y) y = static_cast<std::uint16_t>(c.framebuffer.height - 1 - y);
  };
  Law law = law_of_squares();
  law.generate = [](Draw&) {
    cases::Case c = square();
    c.viewport.height /= 2;
    return Generated{c, "squares"};
  };
  const Trial trial = try_law(law, "Mine", damaged(upside_down), few_cases());
  EXPECT_THAT(trial.text, HasSubstr("  Hint: it draws as if the target is upside down.\n"));
}

TEST(TryLaw, NamesTheCaseOfTheCorpus) {
  const TemporaryFolder corpus;
  corpus.put("a.json", cases::to_json(square()));
  cases::Case other = square();
  other.name = "the other";
  corpus.put("b.json", cases::to_json(other));
  TrialOptions options = few_cases();
  options.corpus = corpus.path();
  options.cases = 0;
  options.shrinking.tries = 0;
  int drawn = 0;
  const Trial trial = try_law(*find_law(kCoverage), "Mine",
                              damaged([&drawn](const cases::Case& c, cases::Fragments& out) {
                                if (++drawn > 1) lose_corner(c, out);
                              }),
                              options);
  EXPECT_THAT(trial.text, HasSubstr("Found in case 1 of the corpus, “the other”, as found."));
}

TEST(TryLaw, SaysHowFarAValueIsOff) {
  Law law = *find_law("values-stay-within-the-bound");
  law.generate = [](Draw&) { return Generated{square(), "squares"}; };
  TrialOptions options = few_cases();
  options.shrinking.tries = 0;
  const auto damage = [](const cases::Case&, cases::Fragments& drawn) {
    // Other properties, tried on the same case, may draw it without this pixel or attribute.
    if (find(drawn, 0, 0, 0) == drawn.size() || drawn.attribute_count < 2) return;
    value(drawn, 0, 0, 0, 1) = 0x1.00001p+0F;  // attribute `one`: its scale ULP is 2^-23
  };
  const Trial trial = try_law(
      law, "Mine", [&damage] { return std::make_unique<DamagedBackend>(damage, "cpu"); }, options);
  EXPECT_THAT(trial.text,
              AllOf(HasSubstr("pixel (0, 0), sample 0 of triangle 0, attribute 1 ('one')\n"
                              "    exactly: 1\n"
                              "    drawn:   1.00000095 (0x1.00001p+0)\n"
                              "    off by   8 scale ULP, 0.51 allowed\n"),
                    HasSubstr("as found")));
}

TEST(TryLaw, SavesTheCaseWhereItIsTold) {
  const TemporaryFolder folder;
  TrialOptions options = few_cases();
  options.output = folder.path("new/output");
  const Trial trial = try_law(law_of_squares(), "Mine", damaged(&lose_corner), options);
  EXPECT_EQ(trial.outcome, Outcome::failed);
  EXPECT_THAT(folder.files("new/output"), ElementsAre("Mine-coverage-obeys-the-contract.json"));
  const std::string file = folder.path("new/output/Mine-coverage-obeys-the-contract.json");
  EXPECT_THAT(trial.text, AllOf(HasSubstr("rastercheck replay " + file + " --backend cpu\n"),
                                Not(HasSubstr("\n{\n"))));
  const auto saved = cases::read_case(file);
  ASSERT_TRUE(saved) << to_string(saved.error());
  EXPECT_EQ(saved->found,
            (cases::Found{kCoverage, "Mine", "missing", 7, 0, "coverage", "ordinary"}));
}

// Kills: a counterexample that is lost if the disk is full.
TEST(TryLaw, PrintsTheCaseWhereItCannotBeSaved) {
  const TemporaryFolder folder;
  TrialOptions options = few_cases();
  options.output = folder.put("file", "no folder");
  const Trial trial = try_law(law_of_squares(), "Mine", damaged(&lose_corner), options);
  EXPECT_THAT(trial.text, HasSubstr("The case could not be saved: " + options.output));
  EXPECT_TRUE(case_in(trial.text).found.has_value());
}

TEST(TryLaw, SkipsWhatIsNotPromised) {
  const Trial trial =
      try_law(*find_law("strips-and-fans-are-their-triangles"), "Mine", damaged({}), few_cases());
  EXPECT_EQ(trial.outcome, Outcome::skipped);
  EXPECT_THAT(trial.text,
              AllOf(HasSubstr("Mine does not promise “strips and fans are their triangles”: the "
                              "backend does not assemble strips and fans\n"),
                    HasSubstr("backends that assemble none")));
}

// Kills: "held" for a law that was not tried.
TEST(TryLaw, SkipsWhereNothingIsChecked) {
  TrialOptions options = few_cases();
  options.cases = 0;
  const Trial trial = try_law(law_of_squares(), "Mine", damaged({}), options);
  EXPECT_EQ(trial.outcome, Outcome::skipped);
  EXPECT_THAT(trial.text, HasSubstr("nothing was checked"));
}

// Kills: "applies to none of 3 cases", and no word why.
TEST(TryLaw, SaysWhyNothingWasChecked) {
  class Refusing : public DamagedBackend {
    Result<cases::Fragments> draw_fragments(const cases::Case& /*c*/) override {
      return tl::unexpected(Error{"", "", "no triangles yet", Failure::unsupported});
    }
  };
  TrialOptions options = few_cases();
  options.cases = 3;
  const Trial trial = try_law(
      law_of_squares(), "Mine", [] { return std::make_unique<Refusing>(); }, options);
  EXPECT_EQ(trial.outcome, Outcome::skipped);
  EXPECT_THAT(trial.text, AllOf(HasSubstr("applies to none of 3 cases\n"),
                                HasSubstr("  3 cases: no triangles yet\n")));
}

// Kills: "held" for a law although none of its cases is of the kind that the law is about.
TEST(TryLaw, FailsWhereTheLawWasHardlyTested) {
  TrialOptions options = few_cases();
  options.cases = 200;
  const Trial trial = try_law(law_of_squares(), "Mine", damaged({}), options);
  EXPECT_EQ(trial.outcome, Outcome::failed);
  EXPECT_THAT(trial.text, AllOf(HasSubstr("was hardly tested"),
                                HasSubstr("“clipped” was reached by 0 of 200 random cases"),
                                Not(HasSubstr("“drawn”"))));
}

// Kills: limits or promises taken from a registered backend that has the suite's name.
TEST(TryLaw, HoldsWhereLimitsKeepLabelsOutOfReach) {
  TrialOptions options = few_cases();
  options.cases = 200;
  for (const char* name : {"Mine", "cpu"}) {
    const Trial trial = try_law(
        law_of_squares(), name, [] { return std::make_unique<LimitedBackend>(); }, options);
    EXPECT_EQ(trial.outcome, Outcome::held) << name << ": " << trial.text;
  }
}

// Kills: a message with a sample and an exact answer although nothing was drawn.
TEST(TryLaw, TellsWhyThereIsNoDrawing) {
  const Trial trial = try_law(
      law_of_squares(), "Mine", [] { return std::make_unique<FailingBackend>(); }, few_cases());
  EXPECT_EQ(trial.outcome, Outcome::failed);
  EXPECT_THAT(trial.text,
              AllOf(HasSubstr("Mine violates the property “coverage obeys the contract”: failed\n"),
                    HasSubstr(" tries.\n  out of memory\n  What is right:"),
                    Not(HasSubstr("pixel")), Not(HasSubstr("exactly"))));
}

// Kills: shrinking without an end.
TEST(TryLaw, EndsShrinkingInTime) {
  TrialOptions options = few_cases();
  options.shrinking.seconds = 0;
  const Trial trial = try_law(law_of_squares(), "Mine", damaged(&lose_corner), options);
  EXPECT_THAT(trial.text, HasSubstr("Found in case 0 of seed 7, as found."));
}

TEST(TryLaw, FailsWhereItCannotBegin) {
  const Trial none = try_law(
      law_of_squares(), "Mine", [] { return nullptr; }, few_cases());
  EXPECT_EQ(none.outcome, Outcome::failed);
  EXPECT_EQ(none.text, "Mine could not be created");

  const TemporaryFolder folder;
  TrialOptions options = few_cases();
  options.corpus = folder.path();
  const std::string file = folder.put("broken.json", "{");
  const Trial broken = try_law(law_of_squares(), "Mine", damaged({}), options);
  EXPECT_EQ(broken.outcome, Outcome::failed);
  EXPECT_THAT(broken.text, HasSubstr(file));
}

// Kills: "held" for a backend that was not asked to draw anything.
TEST(TryLaw, FailsWhereTheBackendIsLost) {
  const Trial trial = try_law(
      law_of_squares(), "Mine", [] { return std::make_unique<LostBackend>(); }, few_cases());
  EXPECT_EQ(trial.outcome, Outcome::failed);
  EXPECT_EQ(trial.text, "“coverage obeys the contract” could not be checked: gone for good");
}

TEST(TryLaw, FailsWhereTheOracleDoes) {
  Law law = law_of_squares();
  law.check = [](const cases::ClipCase&, backends::Backend&, std::uint64_t) -> Result<Check> {
    Check check;
    check.fault = "two oracles disagree";
    return check;
  };
  const Trial trial = try_law(law, "Mine", damaged({}), few_cases());
  EXPECT_EQ(trial.outcome, Outcome::failed);
  EXPECT_EQ(trial.text, "“coverage obeys the contract” could not be checked: two oracles disagree");
}

TEST(TrialOptions, AreThoseOfTheEnvironment) {
  const TemporaryFolder folder;
  Environment environment;
  const auto usual = trial_options(folder.path());
  ASSERT_TRUE(usual) << to_string(usual.error());
  EXPECT_EQ(usual->seed, 1U);
  EXPECT_EQ(usual->cases, 100U);
  EXPECT_EQ(usual->corpus, folder.path());
  EXPECT_EQ(usual->output, "");
  EXPECT_EQ(trial_options(folder.path("none"))->corpus, "");

  environment.set("RASTERCHECK_SEED", "18446744073709551615");
  environment.set("RASTERCHECK_CASES", "5");
  environment.set("RASTERCHECK_CORPUS", "");
  environment.set("RASTERCHECK_OUTPUT", "out");
  const auto changed = trial_options(folder.path());
  ASSERT_TRUE(changed) << to_string(changed.error());
  EXPECT_EQ(changed->seed, 18446744073709551615U);
  EXPECT_EQ(changed->cases, 5U);
  EXPECT_EQ(changed->corpus, "");
  EXPECT_EQ(changed->output, "out");
}

TEST(TrialOptions, RefuseWhatIsNoNumber) {
  Environment environment;
  for (const char* text : {"", "many", "-1", "5 ", "0x5", "18446744073709551616"}) {
    environment.set("RASTERCHECK_CASES", text);
    const auto options = trial_options("");
    ASSERT_FALSE(options) << text;
    EXPECT_EQ(to_string(options.error()), "RASTERCHECK_CASES: '" + std::string(text) +
                                              "' is not an integer from 0 to 2^64 - 1");
  }
}

}  // namespace
}  // namespace rastercheck::properties::trial_test
