#pragma once

// The one place that knows of threads.

#include <cstddef>
#include <functional>

namespace rastercheck::rasterizer {

/// How many threads `threads` asks for: as many as the machine has where it is 0.
std::size_t worker_count(unsigned threads);

/// Calls `drive`; its calls of for_each_index have up to so many threads, which are at hand until
/// it returns, as waking them takes as long as drawing a thousand triangles.
void with_workers(std::size_t workers, const std::function<void()>& drive);

/// Calls work(i, worker) for each i below `count`, in any order, on the threads of with_workers;
/// worker < workers, and no two calls with the same worker overlap. Throws what a call throws, with
/// the rest left out.
void for_each_index(std::size_t count, std::size_t workers,
                    const std::function<void(std::size_t i, std::size_t worker)>& work);

}  // namespace rastercheck::rasterizer
