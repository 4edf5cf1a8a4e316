#pragma once

// Foreign code kept apart: drivers and plugins draw in processes of their own, so that whatever
// they do ends a process and not a campaign. A BackendFactory hands out stand-ins for them.
//
// A process that crashes, or does not answer in time, fails the drawing that it was at (Failure::
// crash and hang), with what it said last, and is started anew for the next one. Cases and
// framebuffers travel through memory that both processes see (internal/channel.h).
//
// What such a process may do is limited (cases/confinement.h). This keeps broken code from doing
// harm; it is no wall against malice.

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/error.h"

namespace rastercheck::backends {

struct Isolation {
  /// Program and arguments of a process that calls serve_backend(); the backend's specification and
  /// `--seconds` and `--memory` with the limits below are added.
  std::vector<std::string> command;
  /// How long a process may be silent that is asked: until it answers, or says that it goes on
  /// (Backend::tell_progress()). Processor time is limited to as much on each processor. Nothing
  /// limits the time of all parts together.
  std::chrono::duration<double> timeout{10};
  /// Bytes that a process may take.
  std::uint64_t memory = std::uint64_t{4} << 30;
};

/// A stand-in for the backend of a specification, foreign or not, made in a process. It draws
/// fragments, and has the backend's contract, description and limits. It is for the thread that
/// makes it: its processes end with the thread that starts them, and any question may start one.
/// Fails as make_backend() does, and where the process cannot be started.
Result<std::unique_ptr<Backend>> make_isolated_backend(const std::string& specification,
                                                       const Isolation& isolation);

/// Makes such stand-ins, for a BackendFactory.
MakeBackend isolated_by(const Isolation& isolation);

/// The limits as the process is told them.
struct ServingLimits {
  double seconds = 0;
  std::uint64_t memory = 0;
};

/// The other end, in the process: limits it, makes the backend and answers until nobody asks any
/// more. Standard input and output are its channel; what is printed meanwhile goes to standard
/// error. Fails where it was not started by make_isolated_backend().
Result<void> serve_backend(const std::string& specification, const ServingLimits& limits);

}  // namespace rastercheck::backends
