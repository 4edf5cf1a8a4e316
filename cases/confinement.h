#pragma once

#include "cases/error.h"

namespace rastercheck::cases {

/// What this process cannot do from now on, nor any that it starts.
struct Confinement {
  bool has_no_files = false;    ///< no file made, changed or removed, but devices
  bool has_no_network = false;  ///< no socket but those within the machine
};

/// Takes from this process, which is to have one thread so far, what the system allows to be taken:
/// files by Landlock, networks by a filter of system calls. There is no way back. Fails where what
/// the system has does not work.
Result<Confinement> confine_this_process();

}  // namespace rastercheck::cases
