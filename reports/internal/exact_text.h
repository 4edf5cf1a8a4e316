#pragma once

#include <cstddef>
#include <string>

namespace rastercheck::reports {

/// An exact value, a fraction or a range of two, with decimals where they help to read it. It takes
/// at most `most` characters without these (elided); 0: as many as a message may.
std::string exact_text(const std::string& exact, std::size_t most = 0);

}  // namespace rastercheck::reports
