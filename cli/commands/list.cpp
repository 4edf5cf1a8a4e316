// `rastercheck list [KIND]`: lists what exists, and whether it can run here.

#include <fmt/format.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/json.h"
#include "cases/names.h"
#include "cases/sample_pattern.h"
#include "cli/command.h"
#include "cli/isolation.h"
#include "cli/known_option.h"
#include "cli/terminal.h"
#include "properties/campaign/known_defects.h"
#include "properties/generator.h"
#include "properties/law.h"
#include "rasterizer/methods/method.h"
#include "reports/text_table.h"

namespace rastercheck::cli::list_command {
namespace {

using nlohmann::ordered_json;

/// Which backends and known defects to list.
struct Asked {
  std::vector<std::string> backends;  ///< specifications; empty: all
  std::vector<records::KnownList> known;
  backends::BackendFactory factory = {};
};

/// One kind of thing that can be listed: rows are objects with the same keys.
struct ListedKind {
  std::string_view name;
  std::vector<ordered_json> (*rows)(const Asked& asked);
  std::size_t columns = 4;  ///< a table shows at most these; JSON has all
};

/// Returns the row of a backend given by its specification.
ordered_json row_of(const backends::BackendFactory& factory, const std::string& specification) {
  const auto backend = factory.make(specification);
  return {{"name", specification},
          {"available", backend.has_value()},
          {"summary", backend ? cases::one_line((*backend)->about().description) : ""},
          {"why not", backend ? "" : cases::printable(to_string(backend.error()))}};
}

std::vector<ordered_json> backend_rows(const Asked& asked) {
  const std::vector<std::string>& asked_for = asked.backends;
  std::vector<ordered_json> rows;
  rows.reserve(asked_for.size());
  for (const std::string& specification : asked_for) {
    rows.push_back(row_of(asked.factory, specification));
  }
  if (!rows.empty()) return rows;
  for (const backends::Listing& listing : asked.factory.list()) {
    rows.push_back({{"name", listing.specification},
                    {"available", listing.unavailable_because.empty()},
                    {"summary", cases::one_line(listing.summary)},
                    {"why not", cases::one_line(listing.unavailable_because)}});
  }
  return rows;
}

std::vector<ordered_json> property_rows(const Asked& /*asked*/) {
  std::vector<ordered_json> rows;
  for (const properties::Law& law : properties::laws()) {
    ordered_json labels = ordered_json::object();
    for (const properties::Cover& cover : law.covers) {
      labels[std::string(cover.label)] = cover.percent;
    }
    rows.push_back({{"id", law.id},
                    {"sentence", law.sentence},
                    {"reason", law.reason},
                    {"not of", law.exceptions},
                    {"labels", std::move(labels)}});
  }
  return rows;
}

std::vector<ordered_json> generator_rows(const Asked& /*asked*/) {
  std::vector<ordered_json> rows;
  for (const properties::Generator& generator : properties::generators()) {
    rows.push_back({{"name", generator.name}, {"summary", generator.summary}});
  }
  return rows;
}

ordered_json to_json(const rasterizer::Operations& operations) {
  return {{"additions", operations.additions},
          {"multiplications", operations.multiplications},
          {"divisions", operations.divisions}};
}

std::vector<ordered_json> method_rows(const Asked& /*asked*/) {
  std::vector<ordered_json> rows;
  for (const rasterizer::Method& method : rasterizer::methods()) {
    const rasterizer::OperationCounts counts = method.operations();
    rows.push_back({{"name", method.name},
                    {"source", method.source},
                    {"fails", method.fails},
                    {"operations",
                     {{"pixel", to_json(counts.per_pixel)},
                      {"row", to_json(counts.per_row)},
                      {"vertex", to_json(counts.per_vertex)},
                      {"polygon", to_json(counts.per_polygon)}}}});
  }
  return rows;
}

std::vector<ordered_json> rules_rows(const Asked& /*asked*/) {
  std::vector<ordered_json> rows;
  for (const cases::Rules rules : {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
    rows.push_back({{"name", name_of(rules)},
                    {"fill_rule", name_of(cases::default_fill_rule(rules))},
                    {"basis", name_of(cases::default_basis(rules))}});
  }
  return rows;
}

std::vector<ordered_json> pattern_rows(const Asked& /*asked*/) {
  std::vector<ordered_json> rows;
  for (const int samples : {1, 2, 4, 8, 16}) {
    ordered_json positions = ordered_json::array();
    for (const auto& p : cases::standard_pattern(samples)) positions.push_back({p.x, p.y});
    rows.push_back({{"samples", samples}, {"positions", positions}});
  }
  return rows;
}

std::vector<ordered_json> known_rows(const Asked& asked) {
  std::vector<ordered_json> rows;
  for (const records::KnownList& list : asked.known) {
    for (const records::KnownEntry& entry : list.entries) {
      rows.push_back({{"name", entry.id},
                      {"driver", list.driver ? list.driver->name : ""},
                      {"version", list.driver ? list.driver->version : ""},
                      {"reason", entry.reason},
                      {"rule", entry.rule},
                      {"finding", entry.finding},
                      {"properties", entry.laws}});
    }
  }
  return rows;
}

constexpr std::array<ListedKind, 7> kKinds{{{"backends", &backend_rows},
                                            {"properties", &property_rows, 2},
                                            {"generators", &generator_rows},
                                            {"methods", &method_rows, 3},
                                            {"rules", &rules_rows},
                                            {"patterns", &pattern_rows},
                                            {"known", &known_rows}}};

std::string cell(const ordered_json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void print_table(const ListedKind& kind, const std::vector<ordered_json>& rows, bool quiet) {
  std::vector<std::vector<std::string>> cells;
  for (const ordered_json& row : rows) {
    std::vector<std::string> names;
    std::vector<std::string> values;
    for (const auto& member : row.items()) {
      if (names.size() == kind.columns) break;
      names.push_back(member.key());
      values.push_back(cell(member.value()));
    }
    if (cells.empty() && !quiet) cells.push_back(std::move(names));
    cells.push_back(std::move(values));
  }
  if (!quiet) fmt::print("{}:{}\n", kind.name, cells.empty() ? " none in this version" : "");
  fmt::print("{}", reports::text_table(cells, quiet ? std::nullopt : terminal_columns()));
}

struct Options {
  std::string kind;
  std::vector<std::string> backends;
  KnownOption known;
  bool json = false;
  bool quiet = false;
};

ExitCode run(const Options& options) {
  std::string chosen = options.kind;
  if (!options.backends.empty()) {
    if (chosen.empty()) chosen = "backends";
    if (chosen != "backends") {
      return fail({"--backend", "",
                   fmt::format("works with `list backends` only, not with `list {}`", chosen)});
    }
  }
  Asked asked{options.backends, {}, backend_factory(kDefaultTimeout)};
  if (chosen.empty() || chosen == "known") {
    Result<std::vector<records::KnownList>> known =
        properties::read_known_lists(options.known.sources());
    if (!known) return fail(known.error());
    asked.known = *std::move(known);
  }
  ordered_json document = ordered_json::object();
  for (const ListedKind& kind : kKinds) {
    if (!chosen.empty() && chosen != kind.name) continue;
    if (options.json) {
      document[std::string(kind.name)] = kind.rows(asked);
    } else {
      print_table(kind, kind.rows(asked), options.quiet);
    }
  }
  if (options.json) fmt::print("{}\n", document.dump());
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  std::vector<std::string> names;
  names.reserve(kKinds.size());
  for (const ListedKind& kind : kKinds) names.emplace_back(kind.name);
  app.add_option("KIND", options->kind, "What to list; default: everything")
      ->check(CLI::IsMember(names));
  app.add_option(
         "--backend", options->backends,
         "List this backend, such as plugin:PATH.so, with its own description; may be repeated")
      ->type_name(kBackend);
  add_known(app, options->known);
  app.add_flag("--json", options->json, "Print the list as JSON");
  app.add_flag("-q,--quiet", options->quiet, "Print only the rows");
  app.footer(
      "Examples:\n"
      "  rastercheck list backends       what can run here, and why the others cannot\n"
      "  rastercheck list properties     every property that is checked\n"
      "  rastercheck list known          known defects of drivers");
  return [options] { return run(*options); };
}

const Registration kRegistration("list", "List backends, properties, known defects and more",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::list_command
