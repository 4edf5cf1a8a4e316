#include "backends/factory.h"

#include <algorithm>
#include <utility>

#include "cases/suggestion.h"

namespace rastercheck::backends {
namespace {

std::vector<BackendKind>& registry() {
  static std::vector<BackendKind> kinds;
  return kinds;
}

/// The text before the colon of a specification.
std::string kind_of(const std::string& specification) {
  return specification.substr(0, specification.find(':'));
}

/// Returns the kind with this name; nullptr if there is none.
const BackendKind* find_kind(const std::string& name) {
  const auto found = std::find_if(registry().begin(), registry().end(),
                                  [&name](const BackendKind& other) { return other.kind == name; });
  return found == registry().end() ? nullptr : &*found;
}

/// The text after the colon of a specification.
std::string options_of(const std::string& specification) {
  const std::size_t colon = specification.find(':');
  return colon == std::string::npos ? "" : specification.substr(colon + 1);
}

tl::unexpected<Error> no_such_kind(const std::string& specification, const std::string& kind) {
  std::string known;
  std::vector<std::string> kinds;
  for (const BackendKind& other : registry()) {
    kinds.emplace_back(other.kind);
    known += (known.empty() ? "" : ", ") + kinds.back();
  }
  return tl::unexpected(Error{
      specification, "", "unknown backend; backends: " + known + cases::did_you_mean(kind, kinds)});
}

}  // namespace

BackendRegistration::BackendRegistration(const BackendKind& kind) {
  // Files register in the order of linking; the list is kept sorted by kind.
  const auto after =
      std::find_if(registry().begin(), registry().end(),
                   [&kind](const BackendKind& other) { return other.kind > kind.kind; });
  registry().insert(after, kind);
}

Result<std::unique_ptr<Backend>> BackendFactory::make(const std::string& specification) const {
  const std::string kind = kind_of(specification);
  const BackendKind* found = find_kind(kind);
  if (found == nullptr) return no_such_kind(specification, kind);
  Result<std::unique_ptr<Backend>> backend = found->is_foreign && make_foreign
                                                 ? make_foreign(specification)
                                                 : found->make(options_of(specification));
  if (backend) {
    if (wrap) backend = wrap(*std::move(backend));
    (*backend)->hold_to(terms);
    (*backend)->prefer(draw_by);
  }
  return backend;
}

std::vector<Listing> BackendFactory::list() const {
  std::vector<Listing> all;
  for (const BackendKind& kind : registry()) {
    for (Listing& listing : kind.list()) {
      if (kind.is_foreign && listing.unavailable_because.empty()) {
        const Result<std::unique_ptr<Backend>> backend = make(listing.specification);
        if (backend) listing.summary = (*backend)->about().description;
        if (!backend) listing.unavailable_because = backend.error().reason;
      }
      all.push_back(std::move(listing));
    }
  }
  return all;
}

bool names_a_kind(const std::string& specification) {
  return find_kind(kind_of(specification)) != nullptr;
}

ProcessRights rights_of(const std::string& specification) {
  const BackendKind* const found = find_kind(kind_of(specification));
  if (found == nullptr || found->rights == nullptr) return {};
  return found->rights(options_of(specification));
}

Result<std::unique_ptr<Backend>> make_backend(const std::string& specification) {
  return BackendFactory().make(specification);
}

}  // namespace rastercheck::backends
