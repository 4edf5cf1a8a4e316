#pragma once

// What laws have in common that hold one picture to be another one, bit for bit.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "cases/case.h"
#include "cases/picture.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Holds `drawn` to have the depths and colours of `expected`, which has its size and channels, to
/// the bit; NaNs are alike. Both are of case `c`. Violations end with `note`, which says how
/// `drawn` came about. There are no labels.
Check compare_pictures(const cases::Case& c, const cases::Picture& expected,
                       const cases::Picture& drawn, const std::string& note);

/// What a channel is, or, of none, the depth: that of the attribute, or of a copy where it has
/// none.
records::AttributeKind kind_of_channel(const cases::Case& c, std::optional<std::uint32_t> channel);

/// What a number of a picture is that should be another, as a violation at the sample of index
/// `at`; `channel` is nothing where it is the depth.
records::Violation picture_violation(const cases::Case& c, const cases::Picture& picture,
                                     std::size_t at, std::optional<std::uint32_t> channel,
                                     float expected, const std::string& note);

}  // namespace rastercheck::properties
