#include "rasterizer/internal/parallel.h"

#include <algorithm>
#include <cassert>
#include <thread>

#ifdef RASTERCHECK_STD_THREADS
#include <atomic>
#include <future>
#include <system_error>
#include <vector>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <optional>
#endif

namespace rastercheck::rasterizer {

std::size_t worker_count(unsigned threads) {
  return threads == 0 ? std::max(1U, std::thread::hardware_concurrency()) : threads;
}

void with_workers([[maybe_unused]] std::size_t workers, const std::function<void()>& drive) {
#ifndef RASTERCHECK_STD_THREADS
  if (workers > 1) {
    // Without this, oneTBB provides no more threads than the machine has cores, and complains on
    // standard error.
    std::optional<tbb::global_control> allowed;
    if (workers > worker_count(0)) {
      allowed.emplace(tbb::global_control::max_allowed_parallelism, workers);
    }
    tbb::task_arena arena(static_cast<int>(workers));
    arena.execute(drive);
    return;
  }
#endif
  drive();
}

void for_each_index(std::size_t count, std::size_t workers,
                    const std::function<void(std::size_t, std::size_t)>& work) {
  if (workers == 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) work(i, 0);
    return;
  }
#ifdef RASTERCHECK_STD_THREADS
  // ThreadSanitizer does not see oneTBB's internal synchronisation and reports races.
  std::atomic<std::size_t> next = 0;
  const auto run = [&](std::size_t worker) {
    for (std::size_t i = next++; i < count; i = next++) work(i, worker);
  };
  std::vector<std::future<void>> others;
  try {
    for (std::size_t worker = 1; worker < std::min(workers, count); ++worker) {
      others.push_back(std::async(std::launch::async, run, worker));
    }
  } catch (const std::system_error&) {
    // No more threads are available; the existing ones do the work.
  }
  run(0);
  for (std::future<void>& other : others) other.get();
#else
  assert(tbb::this_task_arena::max_concurrency() <= static_cast<int>(workers));
  tbb::parallel_for(
      std::size_t{0}, count,
      [&work](std::size_t i) {
        work(i, static_cast<std::size_t>(tbb::this_task_arena::current_thread_index()));
      },
      tbb::simple_partitioner());
#endif
}

}  // namespace rastercheck::rasterizer
