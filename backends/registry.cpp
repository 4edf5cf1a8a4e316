#include <algorithm>

#include "backends/backend.h"
#include "backends/isolation.h"

namespace rastercheck::backends {
namespace {

std::vector<BackendKind>& registry() {
  static std::vector<BackendKind> kinds;
  return kinds;
}

/// Nothing: foreign backends are made in this process.
std::optional<Isolation>& isolation_of_foreign() {
  static std::optional<Isolation> isolation;
  return isolation;
}

}  // namespace

void isolate_foreign_backends(const Isolation& isolation) { isolation_of_foreign() = isolation; }

BackendRegistration::BackendRegistration(const BackendKind& kind) {
  // The order in which files register is the linker's; lists have one of their own.
  const auto after =
      std::find_if(registry().begin(), registry().end(),
                   [&kind](const BackendKind& other) { return other.kind > kind.kind; });
  registry().insert(after, kind);
}

Result<std::unique_ptr<Backend>> make_backend(const std::string& specification) {
  const std::size_t colon = specification.find(':');
  const std::string kind = specification.substr(0, colon);
  const std::string options =
      colon == std::string::npos ? std::string() : specification.substr(colon + 1);
  std::string known;
  for (const BackendKind& candidate : registry()) {
    if (candidate.kind == kind) {
      const std::optional<Isolation>& isolation = isolation_of_foreign();
      return candidate.is_foreign && isolation ? make_isolated_backend(specification, *isolation)
                                               : candidate.make(options);
    }
    known += (known.empty() ? "" : ", ") + std::string(candidate.kind);
  }
  return tl::unexpected(Error{specification, "", "no backend of that name; there are: " + known});
}

std::vector<Listing> list_backends() {
  std::vector<Listing> all;
  for (const BackendKind& kind : registry()) {
    const std::vector<Listing> some = kind.list();
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace rastercheck::backends
