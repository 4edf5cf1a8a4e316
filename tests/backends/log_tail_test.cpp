#include "backends/internal/log_tail.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <string>

namespace rastercheck::backends::log_tail_test {
namespace {

/// The last lines that are kept of a text that a process wrote.
std::string heard(const std::string& text) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK), 0);
  LogTail log{cases::Descriptor(ends[0])};
  EXPECT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(ends[1]);
  log.read();
  EXPECT_LT(log.pipe(), 0) << "nobody can say anything any more";
  return log.last_lines();
}

TEST(LogTail, KeepsTheLastLines) {
  EXPECT_EQ(heard(""), "");
  EXPECT_EQ(heard("one"), "one");
  EXPECT_EQ(heard("one\ntwo\n\nthree\n"), "one / two / three");
  EXPECT_EQ(heard("1\n2\n3\n4\n5\n6\n7\n"), "3 / 4 / 5 / 6 / 7");
  EXPECT_EQ(heard(std::string(5000, 'x') + "\nend"), std::string(1020, 'x') + " / end");
}

TEST(LogTail, HasNothingThatATerminalWouldObey) {
  EXPECT_EQ(heard("\x1b[2J\xff"), "\\u001b[2J\xef\xbf\xbd");
}

}  // namespace
}  // namespace rastercheck::backends::log_tail_test
