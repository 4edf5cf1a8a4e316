#pragma once

// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// Runs work on several threads. No other file of the rasterizer starts threads.

#include <cstddef>
#include <functional>

namespace rastercheck::rasterizer {

/// Returns the number of threads that `threads` asks for; 0 asks for as many as the machine has.
std::size_t worker_count(unsigned threads);

/// Calls `drive`. Calls of for_each_index() within `drive` use up to `workers` threads. These
/// threads are kept awake until `drive` returns, because waking them takes as long as drawing a
/// thousand triangles.
void with_workers(std::size_t workers, const std::function<void()>& drive);

/// Calls work(i, worker) for each i below `count`, in any order, on the threads of with_workers().
/// `worker` is below `workers`, and calls with the same `worker` never overlap. If a call throws,
/// rethrows its exception; remaining calls may then be skipped.
void for_each_index(std::size_t count, std::size_t workers,
                    const std::function<void(std::size_t i, std::size_t worker)>& work);

}  // namespace rastercheck::rasterizer
