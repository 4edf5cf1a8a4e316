#include "cases/importer.h"

#include <algorithm>

namespace rastercheck::cases {
namespace {

std::vector<Importer>& importer_registry() {
  static std::vector<Importer> all;
  return all;
}

template <typename Predicate>
const Importer* first_importer(const Predicate& predicate) {
  const auto found =
      std::find_if(importer_registry().begin(), importer_registry().end(), predicate);
  return found == importer_registry().end() ? nullptr : &*found;
}

}  // namespace

ImporterRegistration::ImporterRegistration(const Importer& importer) {
  std::vector<Importer>& all = importer_registry();
  const auto after = std::find_if(all.begin(), all.end(), [&importer](const Importer& other) {
    return other.name > importer.name;
  });
  all.insert(after, importer);
}

std::span<const Importer> importers() { return importer_registry(); }

const Importer* find_importer(std::string_view name) {
  return first_importer([name](const Importer& importer) { return importer.name == name; });
}

const Importer* importer_of(std::string_view text) {
  return first_importer([text](const Importer& importer) { return importer.recognises(text); });
}

}  // namespace rastercheck::cases
