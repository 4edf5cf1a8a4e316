#pragma once

// Arrays to hand to foreign code. Each lies between inaccessible pages, so that accessing an
// element just outside ends the process, after a message on standard error
// (report_wrong_accesses()).

#include <cstddef>
#include <span>

#include "cases/error.h"

namespace rastercheck::backends {

class GuardedArray {
 public:
  /// The name is used in reports and must outlive the array.
  explicit GuardedArray(const char* name) : name_(name) {}
  GuardedArray(const GuardedArray&) = delete;
  GuardedArray& operator=(const GuardedArray&) = delete;
  ~GuardedArray();

  /// Allocates `size` writable bytes and discards the old content. The array ends where accessible
  /// memory ends. Its alignment is the largest power of two that divides `size`, up to a page.
  Result<void> resize(std::size_t size);
  /// Like resize(), but the array is filled with these bytes and read-only.
  Result<void> assign(std::span<const std::byte> bytes);

  /// Returns nullptr if the array has no bytes.
  std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }
  template <typename T>
  T* as() const {
    return reinterpret_cast<T*>(data_);
  }

  /// True if the accessible memory before the array's beginning, which is less than a page, has not
  /// been written to since the array's size was last set.
  bool is_front_whole() const;

 private:
  void release();
  Result<void> protect(int access) const;

  const char* name_;
  std::byte* pages_ = nullptr;  ///< accessible pages; an inaccessible one before and after
  std::size_t touchable_ = 0;   ///< bytes
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

/// From now on, a process that ends because of a wrong access first reports which array was
/// accessed, if any is near the address. Affects the whole process; meant for processes that run
/// foreign code.
void report_wrong_accesses();

}  // namespace rastercheck::backends
