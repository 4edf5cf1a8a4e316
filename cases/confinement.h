#pragma once

#include "cases/error.h"

namespace rastercheck::cases {

/// The rights that this process, and any process it starts, no longer has.
struct Confinement {
  bool has_no_files = false;    ///< it cannot create, change or remove files, except devices
  bool has_no_network = false;  ///< it can use only sockets within the machine
};

/// Irrevocably drops this process's rights as far as the system supports it: to files by Landlock,
/// to networks by a filter of system calls. The process must have only one thread so far. Fails if
/// a mechanism that the system has does not work.
Result<Confinement> confine_this_process();

}  // namespace rastercheck::cases
