// Checks every law on every variant of `cpu`. Laws about things that `cpu` does not promise are
// checked on a backend that promises them. Each law is one test, on the cases that a campaign with
// the same seed checks. As in RapidCheck's own tests, the environment variable RC_PARAMS sets the
// number of cases and the seed. Each textbook method is checked by all its laws on some of these
// cases.

#include <gtest/gtest.h>
#include <rapidcheck/detail/Configuration.h>

#include <array>
#include <cctype>
#include <cstdlib>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backends/factory.h"
#include "cases/case_writer.h"
#include "properties/campaign/check_case.h"
#include "properties/law.h"

namespace rastercheck::properties::laws_hold_test {
namespace {

constexpr std::array kBackends{"cpu", "cpu:precision=float32", "cpu:output=framebuffer,threads=3",
                               "cpu:conservative=outer", "cpu:conservative=inner"};
/// Backends for laws about things that `cpu` does not have.
constexpr std::array<const char*, 2> kOthers{"method:screen-linear", "method:scanline-linear"};

struct LawOfBackend {
  const Law* law = nullptr;
  std::string backend;
};

std::ostream& operator<<(std::ostream& out, const LawOfBackend& which) {
  return out << which.law->id << " of " << which.backend;
}

/// Each pair of a law and a backend that promises what the law is about.
std::vector<LawOfBackend> promised_laws() {
  std::vector<LawOfBackend> all;
  const auto add = [&all](const char* specification, const auto& is_wanted) {
    const auto backend = backends::make_backend(specification).value();
    for (const Law& law : laws()) {
      if (is_wanted(law) && is_promised(law, *backend)) all.push_back({&law, specification});
    }
  };
  for (const char* const specification : kBackends)
    add(specification, [](const Law&) { return true; });
  const auto cpu = backends::make_backend(kBackends[0]).value();
  for (const char* const specification : kOthers) {
    add(specification, [&cpu](const Law& law) { return !is_promised(law, *cpu); });
  }
  return all;
}

/// The textbook methods, as backends.
std::vector<std::string> methods() {
  std::vector<std::string> all;
  for (const backends::Listing& listing : backends::BackendFactory().list()) {
    if (listing.specification.starts_with("method:")) all.push_back(listing.specification);
  }
  return all;
}

/// The number of cases and the seed: 100 cases of seed 0, unless RC_PARAMS says otherwise, as in
/// "seed=7 max_success=1000". Throws if RapidCheck cannot parse it.
rc::detail::TestParams parameters_of_environment() {
  const char* const text = std::getenv("RC_PARAMS");
  return text == nullptr ? rc::detail::TestParams() : rc::detail::configFromString(text).testParams;
}

class LawTest : public testing::TestWithParam<LawOfBackend> {
 protected:
  /// Checks case `index`; returns false if it is the last.
  bool check_case(const Law& law, backends::Backend& backend, std::uint64_t index) {
    Draw draw = draw_of(law, parameters_.seed, index);
    if (draw.size() > parameters_.maxSize) return true;
    const Generated made = law.generate(draw);
    const Check check = check_or_note(law, made.source, backend, index);
    if (!check.is_applicable) {
      ++discarded_;
      return discarded_ <= std::int64_t{parameters_.maxDiscardRatio} * parameters_.maxSuccess;
    }
    ++checked_;
    for (const std::string& label : check.labels) ++labels_[label];
    if (check.judgement.errors.contains(records::AttributeKind::coverage)) {
      correct_ += check.judgement.errors.at(records::AttributeKind::coverage)
                      .classes[records::FragmentClass::correct];
    }
    EXPECT_FALSE(check.fault.has_value()) << *check.fault;
    EXPECT_EQ(check.violation_count, 0U)
        << verdict_of(check) << ": " << check.violations.front().note << "\ncase " << index
        << " of seed " << parameters_.seed << ", " << made.stratum << ":\n"
        << cases::to_json(made.source);
    return !HasFailure() && std::cmp_less(checked_, parameters_.maxSuccess);
  }

  const rc::detail::TestParams parameters_ = parameters_of_environment();
  std::uint64_t checked_ = 0;
  std::int64_t discarded_ = 0;
  std::uint64_t correct_ = 0;
  std::map<std::string, std::uint64_t> labels_;
};

TEST_P(LawTest, Holds) {
  const Law& law = *GetParam().law;
  const auto backend = backends::make_backend(GetParam().backend);
  ASSERT_TRUE(backend) << to_string(backend.error());
  for (std::uint64_t index = 0; check_case(law, **backend, index); ++index) {
  }
  if (HasFailure()) return;
  EXPECT_GT(checked_, 0U) << "not checked: no case that it says anything of";
  EXPECT_GT(correct_, 0U) << "not checked: nothing drawn rightly in any case";
  const bool is_decided = draws_what_is_asked_for(**backend);
  // Conservative coverage permits pixels that need not be drawn; methods leave out some cases.
  ASSERT_TRUE(is_decided || GetParam().backend.starts_with("cpu:conservative=") ||
              GetParam().backend.starts_with("method:"));
  for (const Cover& cover : law.covers) {
    if (cover.is_decided && !is_decided) continue;
    EXPECT_GE(labels_[std::string(cover.label)], least_reached(cover, checked_))
        << "'" << cover.label << "', of " << checked_ << " cases";
  }
}

/// Replaces characters that GoogleTest does not allow: it takes letters, digits and underscores.
std::string as_test_name(std::string name) {
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

std::string test_name(const testing::TestParamInfo<LawOfBackend>& test) {
  return as_test_name(std::string(test.param.law->id) + "_of_" + test.param.backend);
}

// All laws have registered themselves by then: GoogleTest asks for the parameters when main() runs.
INSTANTIATE_TEST_SUITE_P(All, LawTest, testing::ValuesIn(promised_laws()), test_name);

// Kills: laws that no backend promises, so that nobody checks them. One law is about drivers, which
// draw in several ways: tests/backends/ways.h and the campaigns of drivers_test.cpp check it.
TEST(Laws, AreAllPromisedByOneOfThem) {
  std::set<std::string_view> promised{"every-way-of-drawing-draws-the-same-bits"};
  for (const LawOfBackend& which : promised_laws()) promised.insert(which.law->id);
  for (const Law& law : laws()) EXPECT_TRUE(promised.contains(law.id)) << law.id;
}

/// Checks a few cases of every law; a campaign with this backend checks many.
class MethodTest : public testing::TestWithParam<std::string> {
 protected:
  static constexpr std::uint64_t kCases = 40;
};

TEST_P(MethodTest, KeepsWhatItPromises) {
  const auto backend = backends::make_backend(GetParam()).value();
  const rc::detail::TestParams parameters = parameters_of_environment();
  std::uint64_t checked = 0;
  for (const Law& law : laws()) {
    if (!is_promised(law, *backend)) continue;
    for (std::uint64_t index = 0; index < kCases; ++index) {
      Draw draw = draw_of(law, parameters.seed, index);
      const Generated made = law.generate(draw);
      const Check check = check_or_note(law, made.source, *backend, index);
      checked += check.is_applicable ? 1 : 0;
      ASSERT_FALSE(check.fault.has_value()) << *check.fault;
      ASSERT_EQ(check.violation_count, 0U)
          << law.id << ": " << verdict_of(check) << "\ncase " << index << " of seed "
          << parameters.seed << ", " << made.stratum << ":\n"
          << cases::to_json(made.source);
    }
  }
  EXPECT_GT(checked, 10 * kCases);
}

INSTANTIATE_TEST_SUITE_P(All, MethodTest, testing::ValuesIn(methods()),
                         [](const testing::TestParamInfo<std::string>& test) {
                           return as_test_name(test.param);
                         });

}  // namespace
}  // namespace rastercheck::properties::laws_hold_test
