#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <string>

#include "cli/output.h"
#include "cli/terminal.h"

namespace rastercheck::cli {
namespace {

constexpr std::uint64_t kWidth = 40;  ///< characters

}  // namespace

ProgressBar::ProgressBar(bool quiet)
    : is_shown_(!quiet && is_capable_terminal(STDERR_FILENO) && !is_set("CI")) {}

ProgressBar::~ProgressBar() { erase(); }

void ProgressBar::erase() {
  const std::scoped_lock lock(mutex_);
  if (has_drawn_) print_problem("\r\033[K");
  has_drawn_ = false;
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
