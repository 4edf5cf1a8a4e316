#pragma once

// Exporters: a finding as something that works without RasterCheck. A file in reports/exporters/
// defines one and registers it:
//
//   const ExporterRegistration kRegistration({"svg", "a figure of the case …", &write});
//
// docs/adding-an-exporter.md walks through it.

#include <span>
#include <string>
#include <string_view>

#include "cases/error.h"
#include "records/exhibit.h"

namespace rastercheck::reports {

struct Exporter {
  std::string_view name;
  std::string_view summary;
  /// Returns the content of the whole file, in UTF-8. Depends only on the exhibit, whose texts may
  /// hold any bytes. Fails if the format cannot say it; the reason is one line.
  Result<std::string> (*write)(const records::Exhibit& exhibit);
};

/// All exporters, in the order of their names.
std::span<const Exporter> exporters();
/// The exporter with that name; nullptr if none.
const Exporter* find_exporter(std::string_view name);

struct ExporterRegistration {
  explicit ExporterRegistration(const Exporter& exporter);
};

}  // namespace rastercheck::reports
