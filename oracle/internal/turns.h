#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

namespace rastercheck::oracle {

/// Work in pieces that several threads do at a time, and whose results come out in the pieces'
/// order, the same for any number of threads.
class Turns {
 public:
  Turns(std::size_t pieces, unsigned jobs) : pieces_(pieces), jobs_(jobs) {}

  /// Calls work(0), …, work(pieces − 1), begun in that order; throws the first thing that one of
  /// them throws. A piece's turn is over when its call returns.
  void run(const std::function<void(std::size_t)>& work);

  /// Waits until the turns of all pieces before this one are over; throws where one of them failed.
  /// What is done after it in the same call no other piece does at the same time.
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
