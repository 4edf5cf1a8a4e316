#pragma once

// Chooses the sample of a drawing to inspect.

#include <cstdint>
#include <optional>

#include "backends/backend.h"
#include "cases/clip_case.h"
#include "cases/sample_place.h"

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

/// Finds, among samples that match the request, the first violation of the drawing's contract, or
/// else the sample with the largest error, in scale ULP. Open members are 0 if no sample matches.
/// Does not check that the requested sample exists: inspect() does.
Focus find_focus(const cases::ClipCase& c, const backends::Drawn& drawn,
                 const FocusRequest& request);

}  // namespace rastercheck::properties
