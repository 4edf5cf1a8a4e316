#pragma once

#include <cstddef>
#include <span>

#include "cases/fragments.h"

namespace rastercheck::cases {

/// The fragments of a drawing with the given indices, in that order, without derivatives.
Fragments some_fragments(const Fragments& drawn, std::span<const std::size_t> some);

/// About `count` fragments of a drawing, at regular intervals.
Fragments thinned(const Fragments& drawn, std::size_t count);

}  // namespace rastercheck::cases
