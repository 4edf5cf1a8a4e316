#include <algorithm>
#include <utility>
#include <vector>

#include "backends/backend.h"
#include "cases/suggestion.h"

namespace rastercheck::backends {
namespace {

std::vector<BackendKind>& registry() {
  static std::vector<BackendKind> kinds;
  return kinds;
}

/// Empty: foreign backends are made in this process.
MakeForeign& make_foreign() {
  static MakeForeign make;
  return make;
}

/// Empty: backends are handed out as they are made.
Wrap& wrap() {
  static Wrap wrap;
  return wrap;
}

Result<std::unique_ptr<Backend>> wrapped(Result<std::unique_ptr<Backend>> made) {
  if (made && wrap()) return wrap()(*std::move(made));
  return made;
}

}  // namespace

void make_foreign_with(MakeForeign make) { make_foreign() = std::move(make); }
void wrap_backends_with(Wrap with) { wrap() = std::move(with); }

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
  std::vector<std::string> kinds;
  for (const BackendKind& candidate : registry()) {
    if (candidate.kind == kind) {
      const bool is_apart = candidate.is_foreign && make_foreign();
      return wrapped(is_apart ? make_foreign()(specification) : candidate.make(options));
    }
    kinds.emplace_back(candidate.kind);
    known += (known.empty() ? "" : ", ") + kinds.back();
  }
  return tl::unexpected(
      Error{specification, "",
            "no backend of that name; there are: " + known + cases::did_you_mean(kind, kinds)});
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
