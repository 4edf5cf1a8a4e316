#include "oracle/internal/turns.h"

#include <algorithm>
#include <future>
#include <system_error>
#include <vector>

namespace rastercheck::oracle {

void Turns::run(const std::function<void(std::size_t)>& work) {
  std::vector<std::future<void>> others;
  try {
    for (std::size_t i = 1; i < std::min<std::size_t>(jobs_, pieces_); ++i) {
      others.push_back(std::async(std::launch::async, [&] { do_pieces(work); }));
    }
  } catch (const std::system_error&) {
    // No more threads are available: continue with those started.
  }
  do_pieces(work);
  for (const std::future<void>& other : others) other.wait();
  if (failure_) std::rethrow_exception(failure_);
}

void Turns::wait_for(std::size_t piece) {
  std::unique_lock lock(mutex_);
  turn_.wait(lock, [&] { return over_ == piece || failure_; });
  if (failure_) std::rethrow_exception(failure_);
}

void Turns::do_pieces(const std::function<void(std::size_t)>& work) {
  try {
    std::size_t piece = 0;
    while (take(piece)) {
      work(piece);
      wait_for(piece);
      const std::lock_guard lock(mutex_);
      ++over_;
      turn_.notify_all();
    }
  } catch (...) {
    fail(std::current_exception());
  }
}

bool Turns::take(std::size_t& piece) {
  const std::lock_guard lock(mutex_);
  if (taken_ == pieces_ || failure_) return false;
  piece = taken_++;
  return true;
}

/// Cancels the turns of all later pieces, and keeps the first failure.
void Turns::fail(const std::exception_ptr& failure) {
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = failure;
  turn_.notify_all();
}

}  // namespace rastercheck::oracle
