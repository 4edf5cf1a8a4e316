// `rastercheck list [KIND]`: what there is, and whether it can run here.

#include <fmt/format.h>

#include <array>

#include "cases/names.h"
#include "cases/sample_pattern.h"
#include "cli/command.h"
#include "cli/output.h"

namespace rastercheck::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// One kind of thing that can be listed.
struct Kind {
  std::string_view name;
  std::vector<std::string> columns;
  Rows (*rows)();
};

Rows no_rows() { return {}; }

Rows rules_rows() {
  Rows rows;
  for (const auto& [name, rules] : cases::names<cases::Rules>()) {
    rows.push_back({std::string(name), std::string(name_of(cases::default_fill_rule(rules))),
                    std::string(name_of(cases::default_basis(rules)))});
  }
  return rows;
}

Rows pattern_rows() {
  Rows rows;
  for (const int samples : {1, 2, 4, 8, 16}) {
    std::string positions;
    for (const auto& p : cases::standard_pattern(samples)) {
      positions += fmt::format("{}({},{})", positions.empty() ? "" : " ", p.x, p.y);
    }
    rows.push_back({std::to_string(samples), positions});
  }
  return rows;
}

const std::array<Kind, 5>& kinds() {
  static const std::array<Kind, 5> all{{
      {"backends", {"name", "available", "why not"}, &no_rows},
      {"properties", {"name", "sentence"}, &no_rows},
      {"methods", {"name", "seed"}, &no_rows},
      {"rules", {"name", "fill_rule", "basis"}, &rules_rows},
      {"patterns", {"samples", "positions"}, &pattern_rows},
  }};
  return all;
}

std::string json_rows(const Kind& kind) {
  std::string text;
  for (const auto& row : kind.rows()) {
    std::string members;
    for (std::size_t i = 0; i < row.size(); ++i) {
      members += fmt::format("{}{}: {}", i == 0 ? "" : ", ", json_string(kind.columns[i]),
                             json_string(row[i]));
    }
    text += fmt::format("{}{{{}}}", text.empty() ? "" : ", ", members);
  }
  return fmt::format("{}: [{}]", json_string(kind.name), text);
}

void print_table(const Kind& kind, bool quiet) {
  Rows rows = kind.rows();
  if (!quiet) {
    fmt::print("{}:{}\n", kind.name, rows.empty() ? " none in this version" : "");
    if (!rows.empty()) rows.insert(rows.begin(), kind.columns);
  }
  fmt::print("{}", table(rows));
}

struct Options {
  std::string kind;
  bool json = false;
  bool quiet = false;
};

ExitCode run(const Options& options) {
  std::string members;
  for (const Kind& kind : kinds()) {
    if (!options.kind.empty() && options.kind != kind.name) continue;
    if (options.json) {
      members += (members.empty() ? "" : ", ") + json_rows(kind);
    } else {
      print_table(kind, options.quiet);
    }
  }
  if (options.json) fmt::print("{{{}}}\n", members);
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name);
  app.add_option("KIND", options->kind, "What to list; everything without it")
      ->check(CLI::IsMember(names));
  app.add_flag("--json", options->json, "As JSON");
  app.add_flag("-q,--quiet", options->quiet, "Rows only");
  return [options] { return run(*options); };
}

const Registration kRegistration("list", "Backends, properties, methods, rules, sample patterns",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli
