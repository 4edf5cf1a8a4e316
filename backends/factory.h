#pragma once

// Backends by their specification, KIND or KIND:OPTIONS, as `method:rational-linear`. A kind of
// backend is one file that registers itself:
//
//   const BackendRegistration kRegistration({"name", &make, &list});

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backends/backend.h"
#include "cases/contract_terms.h"
#include "cases/draw_by.h"
#include "cases/error.h"

namespace rastercheck::backends {

/// A backend that could be asked for, and whether it can run here.
struct Listing {
  std::string specification;
  std::string summary;
  std::string unavailable_because = {};  ///< empty where it can run
};

struct BackendKind {
  std::string_view kind;
  /// Fails where the options name nothing, or where it cannot run here.
  Result<std::unique_ptr<Backend>> (*make)(const std::string& options);
  /// What could be asked for. Of a foreign kind nobody has tried to make these yet.
  std::vector<Listing> (*list)();
  /// Whether it runs code that this project did not write, which may do anything: it gets a process
  /// of its own (isolation.h).
  bool is_foreign = false;
};

struct BackendRegistration {
  explicit BackendRegistration(const BackendKind& kind);
};

/// Makes the backend of a specification.
using MakeBackend = std::function<Result<std::unique_ptr<Backend>>(const std::string&)>;

/// Makes backends.
struct BackendFactory {
  /// Makes those of foreign kinds (isolated_by() in isolation.h); without it they draw in this
  /// process.
  MakeBackend make_foreign = {};
  /// What all are held to (Backend::hold_to()).
  std::optional<cases::ContractTerms> terms = std::nullopt;
  /// How those that have several ways draw (Backend::prefer()).
  std::optional<cases::DrawBy> draw_by = std::nullopt;

  /// Makes the backend of a specification. The error's file is the specification; its failure is
  /// `unavailable` where the backend is one that there is, and that cannot run here.
  Result<std::unique_ptr<Backend>> make(const std::string& specification) const;

  /// Everything that could be asked for, by kind; foreign ones are made, to see whether they can
  /// run here.
  std::vector<Listing> list() const;
};

/// Makes a backend in this process, whose promise nothing overrides.
Result<std::unique_ptr<Backend>> make_backend(const std::string& specification);

}  // namespace rastercheck::backends
