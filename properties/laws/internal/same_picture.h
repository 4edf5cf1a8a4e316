#pragma once

// For laws that expect one picture to equal another bit for bit.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "cases/case.h"
#include "cases/picture.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Checks that `drawn` has the depths and colours of `expected`, to the bit; any two NaNs are the
/// same. Both pictures are of case `c` and have the same size and channels. Violations end with
/// `note`, which says how `drawn` was made. Adds no labels.
Check compare_pictures(const cases::Case& c, const cases::Picture& expected,
                       const cases::Picture& drawn, const std::string& note);

/// The kind of a channel's attribute; `flat` if the channel is not an attribute. If `channel` is
/// empty, the kind of the depth.
records::AttributeKind kind_of_channel(const cases::Case& c, std::optional<std::uint32_t> channel);

/// A violation at the sample of index `at`, where a number of the picture should be `expected`.
/// `channel` is empty for the depth.
records::Violation picture_violation(const cases::Case& c, const cases::Picture& picture,
                                     std::size_t at, std::optional<std::uint32_t> channel,
                                     float expected, const std::string& note);

}  // namespace rastercheck::properties
