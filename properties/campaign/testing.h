#pragma once

// Every law as a test of GoogleTest, for a rasterizer of somebody's own (RasterCheck::testing,
// docs/using-in-googletest.md):
//
//   class MyRasterizer : public rastercheck::backends::Backend { … };
//   RASTERCHECK_GTEST_SUITE(MyRasterizer)
//
// The tests are MyRasterizer.law/whole_pixels_move_the_picture and so on. What is tried, the
// environment may change (trial_options in properties/campaign/trial.h).

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "properties/campaign/trial.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// The ids of all laws. GoogleTest asks for it when main() runs: until then not all laws have
/// registered themselves. Where none is linked there is a test all the same, which fails.
inline std::vector<std::string> ids_of_laws() {
  std::vector<std::string> ids;
  for (const Law& law : laws()) ids.emplace_back(law.id);
  if (ids.empty()) ids.emplace_back("there are laws");
  return ids;
}

/// A law's id in the letters, digits and underscores that GoogleTest takes.
inline std::string law_test_name(const testing::TestParamInfo<std::string>& test) {
  std::string name;
  for (const char c : test.param) {
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (is_plain) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  return name;
}

/// The body of such a test; `file` and `line` are where it fails.
inline void test_law(const std::string& law, const std::string& backend, const MakeTried& make,
                     const char* file, int line) {
  const Law* const known = find_law(law);
  if (known == nullptr) {
    ADD_FAILURE_AT(file, line)
        << "no law is linked, as the target RasterCheck::testing has them be";
    return;
  }
  const Result<TrialOptions> options = trial_options(RASTERCHECK_CORPUS_FOLDER);
  if (!options) {
    ADD_FAILURE_AT(file, line) << to_string(options.error());
    return;
  }
  const Trial trial = try_law(*known, backend, make, *options);
  if (trial.outcome == Trial::Outcome::skipped) GTEST_SKIP() << trial.text;
  if (trial.outcome == Trial::Outcome::failed) ADD_FAILURE_AT(file, line) << trial.text;
}

}  // namespace rastercheck::properties

/// A test for each law, of a class of backends that has a constructor without arguments. `Class` is
/// its unqualified name.
#define RASTERCHECK_GTEST_SUITE(Class) \
  RASTERCHECK_GTEST_SUITE_OF(Class, [] { return std::make_unique<Class>(); })

/// The same of what a callable makes, a std::unique_ptr to a backend; `Name`, an identifier, is
/// what the suite is called. The backend is made anew for each test.
#define RASTERCHECK_GTEST_SUITE_OF(Name, ...)                                                     \
  static std::unique_ptr<::rastercheck::backends::Backend> rastercheck_make_##Name() {            \
    return (__VA_ARGS__)();                                                                       \
  }                                                                                               \
  namespace rastercheck_suites { /* where the suite may have the name of the class */             \
  class Name : public ::testing::TestWithParam<::std::string> {};                                 \
  TEST_P(Name, law) {                                                                             \
    ::rastercheck::properties::test_law(GetParam(), #Name, &rastercheck_make_##Name, __FILE__,    \
                                        __LINE__);                                                \
  }                                                                                               \
  INSTANTIATE_TEST_SUITE_P(, Name, ::testing::ValuesIn(::rastercheck::properties::ids_of_laws()), \
                           &::rastercheck::properties::law_test_name);                            \
  }
