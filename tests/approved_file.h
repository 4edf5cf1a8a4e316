#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace rastercheck {

/// True if `text` equals the content of a file of the source tree, byte for byte. If the
/// environment variable UPDATE_APPROVED is set, the text is written to the file first; review the
/// file to approve it.
inline testing::AssertionResult is_approved(const std::string& text, const std::string& file) {
  if (std::getenv("UPDATE_APPROVED") != nullptr) std::ofstream(file, std::ios::binary) << text;
  std::ifstream stream(file, std::ios::binary);
  const std::string approved(std::istreambuf_iterator<char>(stream), {});
  if (text == approved) return testing::AssertionSuccess();
  // Shows the first place where the two differ, which says more than a diff of whole files.
  const auto at = std::mismatch(text.begin(), text.end(), approved.begin(), approved.end()).first;
  const auto offset = static_cast<std::size_t>(at - text.begin());
  constexpr std::size_t kShown = 300;
  return testing::AssertionFailure() << file << " differs from byte " << offset << ":\n"
                                     << text.substr(offset, kShown) << "\ninstead of\n"
                                     << approved.substr(std::min(offset, approved.size()), kShown);
}

}  // namespace rastercheck
