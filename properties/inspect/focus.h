#pragma once

// Chooses the sample of a drawing to inspect.

#include <cstdint>
#include <optional>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"
#include "records/stage_trace.h"

namespace rastercheck::properties {

/// The sample in focus, and the value that matters.
struct Focus {
  cases::SamplePlace at;
  std::optional<std::uint32_t> attribute = std::nullopt;  ///< empty: coverage, or depth
  bool operator==(const Focus&) const = default;
};

/// The fixed members of a focus; the others are open.
struct FocusRequest {
  std::optional<std::uint32_t> triangle = std::nullopt;
  std::optional<std::uint32_t> x = std::nullopt;
  std::optional<std::uint32_t> y = std::nullopt;
  std::optional<std::uint32_t> sample = std::nullopt;
  std::optional<std::uint32_t> attribute = std::nullopt;
  bool is_depth = false;  ///< depth is meant, not an attribute
};

/// Draws the case without its depth test. Finds, among samples that match the request, the first
/// violation of the backend's contract, or else the sample with the largest error, in scale ULP.
/// Open members are 0 if no sample matches. Fails if the case cannot be drawn. Does not check that
/// the requested sample exists: inspect() does.
Result<Focus> find_focus(const cases::Case& c, backends::Backend& backend,
                         const FocusRequest& request);

}  // namespace rastercheck::properties
