#pragma once

// Isolates foreign code: drivers and plugins draw in separate processes, so that a fault ends only
// one of these processes and not the whole campaign. A BackendFactory hands out stand-ins for them.
//
// If a process crashes or does not answer in time, its current drawing fails (Failure::crash or
// hang) with the last words of the process, and a new process starts for the next drawing. Cases
// and framebuffers travel through memory shared by both processes (internal/channel.h).
//
// Each process is limited in what it may do (cases/confinement.h). The limits keep broken code from
// doing harm; they do not stop malicious code.

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
  /// Program and arguments of a process that calls serve_backend(). Appended are `--seconds` and
  /// `--memory` with the limits below, `--`, and the backend's specification.
  std::vector<std::string> command;
  /// How long a process may stay silent after a question, until it answers or reports progress
  /// (Backend::tell_progress()). In the same interval, the process may use this much processor time
  /// per processor. The total time of all parts of a drawing is unlimited.
  std::chrono::duration<double> timeout{10};
  /// The most bytes that a process may allocate.
  std::uint64_t memory = std::uint64_t{4} << 30;
};

/// Makes a stand-in for the backend of a specification, foreign or not, which runs in another
/// process. The stand-in draws fragments and has the backend's contract, description and limits.
/// Use it only on the thread that makes it: its processes end with the thread that starts them, and
/// any question may start one. Fails like make_backend(), or if the process cannot be started.
Result<std::unique_ptr<Backend>> make_isolated_backend(const std::string& specification,
                                                       const Isolation& isolation);

/// Returns a function that makes such stand-ins, for a BackendFactory.
MakeBackend isolated_by(const Isolation& isolation);

/// The limits as they are passed to the process.
struct ServingLimits {
  double seconds = 0;
  std::uint64_t memory = 0;
};

/// The other end, in the process itself: applies the limits, makes the backend and answers until
/// the channel closes. Standard input and output are the channel, so printed text goes to standard
/// error. Fails if the process was not started by make_isolated_backend().
Result<void> serve_backend(const std::string& specification, const ServingLimits& limits);

}  // namespace rastercheck::backends
