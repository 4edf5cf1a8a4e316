#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "backends/plugin/guarded_array.h"
#include "cases/error.h"

namespace rastercheck::backends {

/// The bytes of the array that a plugin's function writes its message to.
inline constexpr std::size_t kMessageSize = 256;

/// A call of one of a plugin's functions.
struct ForeignCall {
  std::string path;                       ///< of the plugin
  const char* function = nullptr;         ///< its name in messages, "draw"
  const GuardedArray* message = nullptr;  ///< where the plugin writes why it fails

  /// Calls the function by `call()`, which returns its status, and then checks its arrays by
  /// `check()`. Fails if the function throws, changes the floating-point environment or returns
  /// another status than RASTERCHECK_OK, or if the check fails.
  Result<void> operator()(const std::function<std::uint32_t()>& call,
                          const std::function<Result<void>()>& check) const;

  tl::unexpected<Error> fail(const std::string& reason, Failure failure = Failure::refused) const {
    return tl::unexpected(Error{"plugin:" + path, "", reason, failure});
  }
};

}  // namespace rastercheck::backends
