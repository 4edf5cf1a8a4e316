#pragma once

#include <string>

namespace rastercheck::cli {

/// The commit that is checked: as it was given; else as a CI server says (GITHUB_SHA,
/// CI_COMMIT_SHA); else what git says of the working directory; else empty.
std::string commit_of(const std::string& given);

}  // namespace rastercheck::cli
