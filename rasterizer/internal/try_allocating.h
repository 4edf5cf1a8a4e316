#pragma once

// Memory that runs out is an error value.

#include <new>
#include <optional>
#include <stdexcept>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Calls; Error::out_of_memory where an allocation failed on the way.
template <typename Call>
std::optional<Error> try_allocating(const Call& call) {
  try {
    call();
  } catch (const std::bad_alloc&) {
    return Error::out_of_memory;
  } catch (const std::length_error&) {  // more than a vector can ever hold
    return Error::out_of_memory;
  }
  return std::nullopt;
}

}  // namespace rastercheck::rasterizer
