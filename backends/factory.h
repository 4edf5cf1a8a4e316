#pragma once

// Makes backends from their specification, KIND or KIND:OPTIONS, such as `method:rational-linear`.
// Each kind of backend is one file that registers itself:
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

/// A backend that a user may ask for, and whether it can run here.
struct Listing {
  std::string specification;
  std::string summary;
  std::string unavailable_because = {};  ///< empty if the backend can run
};

/// How far the process of a foreign backend is limited.
struct ProcessRights {
  /// False if the user has asked for a process without limits on memory, files and networks.
  bool is_confined = true;
  /// True if the process starts programs, which may reserve much more memory than they use. Their
  /// processor time is not limited, as it adds up over all drawings.
  bool may_reserve_memory = false;
};

struct BackendKind {
  std::string_view kind;
  /// Fails if the options name no backend, or if the backend cannot run here.
  Result<std::unique_ptr<Backend>> (*make)(const std::string& options);
  /// The specifications that a user may ask for. Foreign kinds list theirs without checking that
  /// these backends can be made.
  std::vector<Listing> (*list)();
  /// True if the backend runs code from outside this project, which may do anything. Such a backend
  /// gets a process of its own (isolation.h).
  bool is_foreign = false;
  /// The rights of a foreign backend with these options; nullptr for the usual ones.
  ProcessRights (*rights)(const std::string& options) = nullptr;
};

struct BackendRegistration {
  explicit BackendRegistration(const BackendKind& kind);
};

/// A function that makes the backend of a specification.
using MakeBackend = std::function<Result<std::unique_ptr<Backend>>(const std::string&)>;

/// Makes backends of all kinds, local and foreign.
struct BackendFactory {
  /// Makes backends of foreign kinds (isolated_by() in isolation.h). If empty, these backends draw
  /// in this process.
  MakeBackend make_foreign = {};
  /// The terms that every backend is held to (Backend::hold_to()).
  std::optional<cases::ContractTerms> terms = std::nullopt;
  /// The preferred way of drawing for backends with several ways (Backend::prefer()).
  std::optional<cases::DrawBy> draw_by = std::nullopt;
  /// Replaces each new backend, for example by one that also records the cases that it draws. If
  /// empty, backends stay as they are.
  std::function<std::unique_ptr<Backend>(std::unique_ptr<Backend>)> wrap = {};

  /// Makes the backend of a specification. An error gives the specification as its file. The
  /// failure is `unavailable` if the backend exists but cannot run here.
  Result<std::unique_ptr<Backend>> make(const std::string& specification) const;

  /// Lists every specification that a user may ask for, sorted by kind. Makes each foreign backend
  /// to find out whether it can run here.
  std::vector<Listing> list() const;
};

/// True if a text begins like the specification of a backend, whether this backend exists or not:
/// "gl:typo", but not "unknown:llvmpipe".
bool names_a_kind(const std::string& specification);

/// The rights of the process that draws with the backend of a specification.
ProcessRights rights_of(const std::string& specification);

/// Makes a backend in this process, held to its own promise.
Result<std::unique_ptr<Backend>> make_backend(const std::string& specification);

}  // namespace rastercheck::backends
