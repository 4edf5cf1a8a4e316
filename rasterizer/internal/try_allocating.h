#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Turns exhausted memory into an error value.

#include <new>
#include <optional>
#include <stdexcept>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Calls `call`; returns Error::out_of_memory if an allocation in it failed.
template <typename Call>
std::optional<Error> try_allocating(const Call& call) {
  try {
    call();
  } catch (const std::bad_alloc&) {
    return Error::out_of_memory;
  } catch (const std::length_error&) {  // more than a vector can hold
    return Error::out_of_memory;
  }
  return std::nullopt;
}

}  // namespace rastercheck::rasterizer
