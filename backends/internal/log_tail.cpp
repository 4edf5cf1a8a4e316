#include "backends/internal/log_tail.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <vector>

#include "cases/json.h"

namespace rastercheck::backends {
namespace {

/// The number of bytes that are kept, and of lines that are shown.
constexpr std::size_t kMostKept = 1024;
constexpr std::size_t kMostLines = 5;
/// The most reads per call. Without a limit, a process that writes fast could keep this one
/// reading.
constexpr int kMostParts = 16;

}  // namespace

void LogTail::read() {
  std::array<char, 4096> part{};
  for (int i = 0; i < kMostParts && pipe_.is_open(); ++i) {
    const ssize_t count = ::read(pipe_.number(), part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return;
    if (count <= 0) return pipe_.close();
    text_.append(part.data(), static_cast<std::size_t>(count));
    if (text_.size() > kMostKept) text_.erase(0, text_.size() - kMostKept);
  }
}

std::string LogTail::last_lines() const {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text_.size();) {
    const std::size_t end = std::min(text_.find('\n', begin), text_.size());
    if (end > begin) lines.push_back(text_.substr(begin, end - begin));
    begin = end + 1;
  }
  std::string joined;
  const std::size_t first = lines.size() - std::min(lines.size(), kMostLines);
  for (std::size_t i = first; i < lines.size(); ++i) {
    joined += (joined.empty() ? "" : " / ") + lines[i];
  }
  return cases::one_line(joined);
}

}  // namespace rastercheck::backends
