// `rastercheck export CASE --format F`: hands a finding on to people who do not have RasterCheck.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cases/case_reader.h"
#include "cases/files.h"
#include "cli/backend_failure.h"
#include "cli/case_check.h"
#include "cli/command.h"
#include "cli/contract_option.h"
#include "cli/isolation.h"
#include "cli/known_option.h"
#include "cli/output.h"
#include "properties/campaign/close_up.h"
#include "properties/drawing.h"
#include "properties/inspect/case_to_draw.h"
#include "properties/inspect/focus.h"
#include "properties/inspect/inspect.h"
#include "properties/inspect/judged_places.h"
#include "reports/commands.h"
#include "reports/exporter.h"

namespace rastercheck::cli::export_command {
namespace {

struct Options {
  std::string file;
  std::string format;
  std::string backend;
  KnownOption known;
  std::string contract;
  std::optional<cases::DriverPromise> promise;
  double timeout = kDefaultTimeout;
  std::string output = "-";
  bool quiet = false;
};

/// The law to speak of, and what it finds: the case's own law, or the first that is violated, or
/// the first that applies.
struct Checked {
  const properties::Law* law = nullptr;
  properties::Check check;
};

Result<Checked> check(const Options& options, const cases::Case& c, const Drawer& drawer) {
  auto laws = laws_for(c, options.file);
  if (!laws) return tl::unexpected(laws.error());
  Checked best;
  for (const properties::Law* law : *laws) {
    properties::Check one = check_again(*law, c, drawer);
    if (one.fault) return tl::unexpected(Error{options.file, "", *one.fault});
    if (!one.is_applicable) continue;
    const bool is_violated = one.violation_count > 0;
    if (best.law == nullptr || is_violated) best = {law, std::move(one)};
    if (is_violated) return best;
  }
  if (best.law == nullptr) {
    return tl::unexpected(Error{options.file, "", "no property applies to it"});
  }
  return best;
}

/// Adds the sample of the first violation, or else the worst one, with the pixels around, and what
/// may be drawn there.
void add_drawing(records::Exhibit& exhibit, const cases::ClipCase& clip, const Checked& checked,
                 const Options& options, const Drawer& drawer) {
  const Result<backends::Drawn> drawn = properties::draw(clip, *drawer.backend);
  if (!drawn) return;
  properties::FocusRequest request;
  const auto& violations = checked.check.violations;
  if (!violations.empty() && violations.front().has_place()) {
    const records::Violation& first = violations.front();
    request.triangle = first.place.triangle;
    request.x = first.place.x;
    request.y = first.place.y;
    request.sample = first.place.sample;
    request.attribute = first.attribute;
  }
  const properties::Focus focus = properties::find_focus(clip, *drawn, request);
  auto inspection = properties::inspect(clip, *drawn, focus,
                                        properties::trace_sample(clip, focus.at, *drawer.backend));
  if (!inspection) return;
  inspection->occasion = records::Occasion::asked_for;
  inspection->backend = options.backend;
  inspection->law = checked.law->id;
  exhibit.places = properties::judged_places(clip, *drawn, *inspection);
  if (const auto& snapping = drawn->contract.coverage)
    exhibit.subpixel_bits = snapping->subpixel_bits;
  exhibit.inspection = *std::move(inspection);
}

/// What the entries of known defects say that explain the check.
void add_known_entries(records::Exhibit& exhibit, const Checked& checked, const Drawer& drawer) {
  if (!drawer.known) return;
  for (const properties::KnownDefect& defect : drawer.known->defects) {
    const records::KnownEntry& entry = defect.entry;
    const auto& ids = checked.check.known;
    if (std::find(ids.begin(), ids.end(), entry.id) == ids.end()) continue;
    exhibit.known.push_back(fmt::format("{}: {}", entry.id, entry.reason));
    if (!entry.rule.empty()) exhibit.rules.push_back(entry.rule);
  }
}

/// The command that judges the exported case as it was judged here.
std::string replay_command(const Options& options) {
  std::vector<std::string> words{"rastercheck", "replay",        "case.json",
                                 "--backend",   options.backend, "--no-known"};
  if (!options.contract.empty()) words.insert(words.end(), {"--contract", options.contract});
  if (options.promise) {
    words.insert(words.end(), {"--promise", std::string(cases::name_of(*options.promise))});
  }
  return reports::command_line(words);
}

Result<records::Exhibit> exhibit_of(const Options& options, const cases::Case& c,
                                    const Drawer& drawer) {
  const auto checked = check(options, c, drawer);
  if (!checked) return tl::unexpected(checked.error());
  const auto clip = properties::case_to_draw(c);
  if (!clip) return tl::unexpected(Error{options.file, clip.error().place, clip.error().reason});
  records::Exhibit exhibit;
  exhibit.file = options.file;
  exhibit.source = *clip;
  // The layout of pictures and the way here matter to RasterCheck only.
  exhibit.source.found = c.found;
  exhibit.backend = options.backend;
  exhibit.description = drawer.backend->about().description;
  exhibit.property = checked->law->id;
  exhibit.sentence = checked->law->sentence;
  exhibit.found_with = "RasterCheck " RASTERCHECK_VERSION;
  exhibit.violation_count = checked->check.violation_count;
  exhibit.violations = checked->check.violations;
  add_drawing(exhibit, *clip, *checked, options, drawer);
  if (!exhibit.violations.empty()) {
    exhibit.pixels = properties::close_up(c, *drawer.backend, exhibit.violations.front());
  }
  add_known_entries(exhibit, *checked, drawer);
  exhibit.replay = replay_command(options);
  return exhibit;
}

Result<std::string> exported(Options options, const cases::Case& c,
                             const backends::BackendFactory& factory) {
  const auto drawer = make_drawer(factory, options.backend, options.known.sources());
  if (!drawer) return tl::unexpected(drawer.error());
  return exhibit_of(options, c, *drawer).and_then([&](const records::Exhibit& exhibit) {
    return reports::find_exporter(options.format)->write(exhibit);
  });
}

ExitCode run(Options options) {
  const auto terms = read_terms(options.contract, options.promise);
  if (!terms) return fail(terms.error());
  const Result<cases::Case> c = cases::read_case(options.file);
  if (!c) return fail(c.error());
  if (options.backend.empty()) options.backend = c->found ? c->found->backend : "cpu";
  const backends::BackendFactory factory = backend_factory(options.timeout, *terms);
  if (const ExitCode code = check_backends(factory, {options.backend}); code != ExitCode::ok) {
    return code;
  }
  const Result<std::string> text = exported(options, *c, factory);
  if (!text) return fail(text.error());
  if (options.output == "-") {
    fmt::print("{}", *text);
    return ExitCode::ok;
  }
  const Result<void> written = check_output_file(options.output, options.file).and_then([&] {
    return cases::write_file(options.output, *text);
  });
  return written ? ExitCode::ok : fail(written.error());
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("CASE", options->file, "Case file or counterexample; - reads standard input")
      ->type_name(kFile)
      ->required();
  std::vector<std::string> names;
  std::string formats = "Formats:\n";
  for (const reports::Exporter& exporter : reports::exporters()) {
    names.emplace_back(exporter.name);
    formats += fmt::format("  {:12} {}\n", exporter.name, exporter.summary);
  }
  app.add_option("--format", options->format, "What to write")
      ->type_name("NAME")
      ->check(CLI::IsMember(names))
      ->required();
  app.add_option("--backend", options->backend,
                 "Backend to draw with; default: that of a counterexample, else cpu")
      ->type_name(kBackend);
  add_known(app, options->known);
  add_contract(app, options->contract);
  add_promise(app, options->promise);
  add_timeout(app, options->timeout);
  app.add_option("--output", options->output, "File to write; - prints it")
      ->type_name(kFile)
      ->capture_default_str();
  app.add_flag("-q,--quiet", options->quiet, "Accepted for consistency; has no effect");
  app.footer(
      "A counterexample is shown as its property finds it now; any other case as the first "
      "property that it violates does.\n\n" +
      formats +
      "\nExamples:\n"
      "  rastercheck export backends/lavapipe/known/lavapipe-3.json --format bug\n"
      "  rastercheck export case.json --backend cpu --format svg --output case.svg");
  return [options] { return run(*options); };
}

const Registration kRegistration("export", "Hand a finding on as a report, a test or a figure",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::export_command
