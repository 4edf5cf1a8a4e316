#pragma once

// Shared by laws about strips, fans and lists of indices.

#include <cstdint>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "cases/picture.h"
#include "properties/judged_law.h"

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

struct Indexed {
  cases::Topology topology = cases::Topology::strip;
  std::vector<std::uint32_t> indices;
};

/// "list", "strip" or "fan".
std::string_view word(cases::Topology topology);

/// Draws the indices in place of the case's primitives, which must be those that the rules make of
/// them, and judges the drawing. Labels the topology, and restarts; begins the note of each
/// violation with what was drawn.
Result<Check> check_assembled(const cases::ClipCase& expanded, const Indexed& indexed,
                              backends::Backend& backend, std::uint64_t index);

}  // namespace rastercheck::properties
