#pragma once

// Which sample of a drawing to look at.

#include <cstdint>
#include <optional>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"
#include "records/stage_trace.h"

namespace rastercheck::properties {

/// What is looked for: a sample, and of its values the one that matters.
struct Focus {
  cases::SamplePlace at;
  std::optional<std::uint32_t> attribute = std::nullopt;  ///< nothing: its coverage, or its depth
  bool operator==(const Focus&) const = default;
};

/// What is settled of a focus; the rest is open.
struct FocusRequest {
  std::optional<std::uint32_t> triangle = std::nullopt;
  std::optional<std::uint32_t> x = std::nullopt;
  std::optional<std::uint32_t> y = std::nullopt;
  std::optional<std::uint32_t> sample = std::nullopt;
  std::optional<std::uint32_t> attribute = std::nullopt;
  bool is_depth = false;  ///< no attribute is meant
};

/// Draws the case without its depth test, and finds of all samples that fit the request the first
/// that the backend's contract does not allow, or else the one whose value is the farthest off the
/// exact one, in scale ULP. Where nothing of the kind was drawn, what is open is 0. Fails where the
/// case cannot be drawn. Whether there is what is asked for, inspect() says.
Result<Focus> find_focus(const cases::Case& c, backends::Backend& backend,
                         const FocusRequest& request);

}  // namespace rastercheck::properties
