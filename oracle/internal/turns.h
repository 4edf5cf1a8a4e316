#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

namespace rastercheck::oracle {

/// Runs pieces of work on several threads and emits their results in the order of the pieces, which
/// is the same for any number of threads.
class Turns {
 public:
  Turns(std::size_t pieces, unsigned jobs) : pieces_(pieces), jobs_(jobs) {}

  /// Calls work(0), …, work(pieces − 1), begun in that order; rethrows the first exception thrown.
  /// A piece's turn ends when its call returns.
  void run(const std::function<void(std::size_t)>& work);

  /// Waits until the turns of all earlier pieces are over; throws if one of them failed. Code after
  /// this call, in the same piece, runs while no other piece is in its turn.
  void wait_for(std::size_t piece);

 private:
  void do_pieces(const std::function<void(std::size_t)>& work);
  bool take(std::size_t& piece);
  void fail(const std::exception_ptr& failure);

  std::size_t pieces_;
  unsigned jobs_;
  std::mutex mutex_;
  std::condition_variable turn_;
  std::size_t taken_ = 0;
  std::size_t over_ = 0;
  std::exception_ptr failure_;
};

}  // namespace rastercheck::oracle
