#pragma once

#include <string>

namespace rastercheck::cli {

/// Returns the commit under test: `given` if set; else the CI server's commit (GITHUB_SHA,
/// CI_COMMIT_SHA); else git's commit for the working directory; else an empty string.
std::string commit_of(const std::string& given);

}  // namespace rastercheck::cli
