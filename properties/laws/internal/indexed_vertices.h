#pragma once

// Shared by laws about strips and fans.

#include <cstdint>
#include <string>
#include <vector>

#include "cases/case.h"

namespace rastercheck::properties {

/// Choices made from the positions alone (64-bit FNV-1a of their bits, then further steps of the
/// hash). The primitives of generated cases follow from these choices, so the choices must not
/// depend on the primitives, as those of choices_of() do.
class PositionChoices {
 public:
  explicit PositionChoices(const cases::Case& c);
  bool one_in(std::uint64_t n);

 private:
  void take(std::uint64_t bits) { state_ = (state_ ^ bits) * 0x100000001b3U; }
  std::uint64_t state_ = 0xcbf29ce484222325U;
};

/// The first vertices of a case in turn, with occasional repeats and restarts.
std::vector<std::uint32_t> indices_with_restarts(const cases::Case& c, PositionChoices& choices);

/// The indices as text, "0 1 R 2 3", with R for a restart.
std::string index_text(const std::vector<std::uint32_t>& indices);

}  // namespace rastercheck::properties
