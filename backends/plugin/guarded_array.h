#pragma once

// Arrays that foreign code is handed, each between pages that cannot be touched, so that the first
// element too far ends the process; what is wrong is said on standard error before
// (report_wrong_accesses()).

#include <cstddef>
#include <span>

#include "cases/error.h"

namespace rastercheck::backends {

class GuardedArray {
 public:
  /// The name is for reports, and has to outlive the array.
  explicit GuardedArray(const char* name) : name_(name) {}
  GuardedArray(const GuardedArray&) = delete;
  GuardedArray& operator=(const GuardedArray&) = delete;
  ~GuardedArray();

  /// Memory of `size` bytes that may be written; what it had is gone. It ends where what may be
  /// touched ends, and is aligned to the largest power of two that divides `size`, up to a page.
  Result<void> resize(std::size_t size);
  /// The same with these bytes, which may only be read.
  Result<void> assign(std::span<const std::byte> bytes);

  /// nullptr where it has no bytes.
  std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }
  template <typename T>
  T* as() const {
    return reinterpret_cast<T*>(data_);
  }

  /// Whether nothing was written before its beginning, where less than a page may be touched, since
  /// its size was last set.
  bool is_front_whole() const;

 private:
  void release();
  Result<void> protect(int access) const;

  const char* name_;
  std::byte* pages_ = nullptr;  ///< what may be touched; a page that may not before and behind it
  std::size_t touchable_ = 0;   ///< bytes
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

/// From now on a process that ends because of a wrong access says which array it was at, if it was
/// near one. Of this whole process; it is for those that run foreign code.
void report_wrong_accesses();

}  // namespace rastercheck::backends
