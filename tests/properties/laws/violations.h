#pragma once

// Shared checks of violations for the tests of laws.

#include <gtest/gtest.h>

#include <cstdint>

#include "properties/law.h"

namespace rastercheck::properties {

/// The only violation that the law found.
inline records::Violation only(const Check& check) {
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 1U);
  return check.violations.empty() ? records::Violation{} : check.violations.front();
}

inline void expect_at(const records::Violation& violation, records::FragmentClass fragment_class,
                      records::AttributeKind kind, std::uint32_t triangle, std::uint32_t x,
                      std::uint32_t y) {
  EXPECT_EQ(violation.fragment_class, fragment_class);
  EXPECT_EQ(violation.kind, kind);
  EXPECT_EQ(violation.place.triangle, triangle);
  EXPECT_EQ(violation.place.x, x);
  EXPECT_EQ(violation.place.y, y);
  EXPECT_EQ(violation.place.sample, 0U);
}

}  // namespace rastercheck::properties
