#pragma once

// Makes every property a GoogleTest test for your own rasterizer (RasterCheck::testing,
// docs/using-in-googletest.md):
//
//   class MyRasterizer : public rastercheck::backends::Backend { … };
//   RASTERCHECK_GTEST_SUITE(MyRasterizer)
//
// The tests are MyRasterizer.property/whole_pixels_move_the_picture and so on. Environment
// variables set which cases are tried (trial_options in properties/campaign/trial.h).

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "properties/campaign/trial.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// The ids of all properties. GoogleTest calls this once main() runs, when all have registered. If
/// no property is linked, returns one entry, whose test fails.
inline std::vector<std::string> ids_of_laws() {
  std::vector<std::string> ids;
  for (const Law& law : laws()) ids.emplace_back(law.id);
  if (ids.empty()) ids.emplace_back("there are properties");
  return ids;
}

/// Returns a property's id in the characters that GoogleTest accepts: letters, digits and
/// underscores.
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

/// The body of a property's test; failures are reported at `file` and `line`.
inline void test_law(const std::string& law, const std::string& backend, const MakeTried& make,
                     const char* file, int line) {
  const Law* const known = find_law(law);
  if (known == nullptr) {
    ADD_FAILURE_AT(file, line) << "no property is linked; link the target RasterCheck::testing";
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

/// Defines a test for each property on backend class `Class` (unqualified name), which must be
/// default-constructible.
#define RASTERCHECK_GTEST_SUITE(Class) \
  RASTERCHECK_GTEST_SUITE_OF(Class, [] { return std::make_unique<Class>(); })

/// Defines a test for each property on the backend that a callable returns as std::unique_ptr;
/// `Name`, an identifier, names the suite. Each test makes a new backend.
#define RASTERCHECK_GTEST_SUITE_OF(Name, ...)                                                     \
  static std::unique_ptr<::rastercheck::backends::Backend> rastercheck_make_##Name() {            \
    return (__VA_ARGS__)();                                                                       \
  }                                                                                               \
  namespace rastercheck_suites { /* so that the suite can have the name of the class */           \
  class Name : public ::testing::TestWithParam<::std::string> {};                                 \
  TEST_P(Name, property) {                                                                        \
    ::rastercheck::properties::test_law(GetParam(), #Name, &rastercheck_make_##Name, __FILE__,    \
                                        __LINE__);                                                \
  }                                                                                               \
  INSTANTIATE_TEST_SUITE_P(, Name, ::testing::ValuesIn(::rastercheck::properties::ids_of_laws()), \
                           &::rastercheck::properties::law_test_name);                            \
  }
