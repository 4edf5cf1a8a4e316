#pragma once

// Measures how a backend draws, using only drawings: cases whose pictures distinguish one way of
// drawing from another. docs/probing.md explains the results; each measure's file explains its
// pictures.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"
#include "records/probe.h"

namespace rastercheck::properties {

/// Settings that all cases of a probe ask for. For each setting left empty, the probe finds out
/// whether the backend honours the case's request.
struct AskedDrawing {
  std::optional<cases::Coverage> coverage;
  std::optional<cases::Basis> basis;
  std::optional<cases::TieRule> fill_rule;
};

struct ProbeOptions {
  std::uint64_t seed = 1;
  int cases = 20;  ///< random cases of each generator, at least 1
  AskedDrawing asked;
  /// Returns true once the probe has to end; empty: never. Asked between measures and within them.
  /// A measure that is cut short leaves no rows and no terms, and is listed in Probe::unmeasured.
  std::function<bool()> is_time_up = {};
};

/// Called before each measure: `done` of `all` measures are made, and `what` comes next.
using ProbeProgress =
    std::function<void(std::uint64_t done, std::uint64_t all, const std::string& what)>;

/// Measures the backend; `name` is its specification. Ends early if the backend has a common fault
/// (Probe::faults). Fails if the backend refuses to draw anything or is lost on the way
/// (Backend::is_lost).
Result<records::Probe> probe(const std::string& name, backends::Backend& backend,
                             const ProbeOptions& options, const ProbeProgress& progress);

}  // namespace rastercheck::properties
