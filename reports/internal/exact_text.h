#pragma once

#include <cstddef>
#include <string>

namespace rastercheck::reports {

/// Formats an exact value, which is a fraction or a range between two, and adds decimals if they
/// help. Takes at most `most` characters, not counting the decimals, by eliding. If `most` is 0,
/// takes as many as a message may have.
std::string exact_text(const std::string& exact, std::size_t most = 0);

}  // namespace rastercheck::reports
