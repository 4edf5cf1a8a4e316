#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>

#include "cli/output.h"

namespace rastercheck::cli {
namespace {

constexpr std::uint64_t kWidth = 40;  ///< characters

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool is_dumb_terminal() {
  const char* terminal = std::getenv("TERM");
  return terminal == nullptr || std::string_view(terminal) == "dumb";
}

}  // namespace

ProgressBar::ProgressBar(bool quiet)
    : is_shown_(!quiet && ::isatty(STDERR_FILENO) != 0 && !is_dumb_terminal() && !is_set("CI")) {}

ProgressBar::~ProgressBar() {
  if (has_drawn_) print_problem("\r\033[K");
}

void ProgressBar::show(std::uint64_t done, std::uint64_t all, const char* what) {
  if (!is_shown_ || all == 0) return;
  const std::scoped_lock lock(mutex_);
  const std::uint64_t filled = kWidth * done / all;
  print_problem(fmt::format("\r\033[K[{:#<{}}{:.<{}}] {} of {} {}", "", filled, "", kWidth - filled,
                            done, all, what));
  has_drawn_ = true;
}

}  // namespace rastercheck::cli
