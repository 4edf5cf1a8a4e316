#include "reports/exporter.h"

#include <algorithm>
#include <vector>

namespace rastercheck::reports {
namespace {

std::vector<Exporter>& exporter_registry() {
  static std::vector<Exporter> all;
  return all;
}

}  // namespace

ExporterRegistration::ExporterRegistration(const Exporter& exporter) {
  std::vector<Exporter>& all = exporter_registry();
  const auto after = std::find_if(all.begin(), all.end(), [&exporter](const Exporter& other) {
    return other.name > exporter.name;
  });
  all.insert(after, exporter);
}

std::span<const Exporter> exporters() { return exporter_registry(); }

const Exporter* find_exporter(std::string_view name) {
  const auto& all = exporter_registry();
  const auto found = std::find_if(
      all.begin(), all.end(), [name](const Exporter& exporter) { return exporter.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace rastercheck::reports
