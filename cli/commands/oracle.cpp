// `rastercheck oracle CASE`: the exact answer of a case.

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <memory>

#include "cases/case_reader.h"
#include "cases/json.h"
#include "cases/mesh_reader.h"
#include "cases/names.h"
#include "cli/command.h"
#include "cli/sample_limit.h"
#include "oracle/fragment_json.h"
#include "oracle/fragments.h"
#include "oracle/self_check.h"
#include "oracle/transform.h"

namespace rastercheck::cli::oracle_command {
namespace {

using oracle::Fragment;
using oracle::TriangleTruth;
using oracle::ValueRange;

struct Options {
  std::string file;
  bool clip = false;
  bool json = false;
  bool details = false;
  bool quiet = false;
  bool all = false;
};

/// The self-check tests the first kCheckedFirst fragments, and then one in kCheckedEvery.
constexpr std::size_t kCheckedFirst = 16;
constexpr std::size_t kCheckedEvery = 256;

/// Hands every fragment to `print`, and some of them to the oracle's self-check, whose result it
/// returns.
Result<void> for_each_checked(
    const oracle::SceneTruth& scene,
    const std::function<void(const Fragment&, const TriangleTruth&)>& print) {
  std::size_t index = 0;
  std::optional<std::string> difference;
  oracle::for_each_fragment(scene, [&](const Fragment& f, const TriangleTruth& truth) {
    if (index < kCheckedFirst || index % kCheckedEvery == 0) {
      difference = oracle::self_check(scene, f);
    }
    ++index;
    print(f, truth);
    return !difference && std::ferror(stdout) == 0;
  });
  if (difference) return tl::unexpected(Error{"", "", *difference});
  return {};
}

/// Scripts rely on this output (docs/commands.md).
Result<void> print_json(const oracle::SceneTruth& scene, const Options& options) {
  fmt::print(R"({{"format": "rastercheck-oracle", "version": 1, "case": {}, "fragments": [)",
             cases::json_string(scene.source().name));
  std::string_view separator = "\n  ";
  auto checked = for_each_checked(scene, [&](const Fragment& f, const TriangleTruth& truth) {
    fmt::print("{}{}", separator,
               options.details ? oracle::to_detailed_json(f, truth) : oracle::to_json(f));
    separator = ",\n  ";
  });
  fmt::print("\n]}}\n");
  return checked;
}

// --- A table for people --------------------------------------------------------------------------

constexpr int kDigits = 9;  // nine digits tell a float32 from its neighbours

/// Returns the exact value if it is short enough to read; otherwise a decimal with only significant
/// digits.
std::string readable(const oracle::Rational& value) {
  constexpr std::size_t kReadable = 13;  // fits into one column, after the decimal
  std::string decimal = records::to_decimal(value.enclosure(), kDigits);
  const std::string fraction = value.to_string();
  if (fraction == decimal || fraction.size() > kReadable) return decimal;
  return decimal + " = " + fraction;
}

std::string readable(const std::optional<ValueRange>& value) {
  if (!value) return "undefined";
  if (!value->is_open || value->lo == value->hi) return readable(value->lo);
  return fmt::format("{} ... {}", records::to_decimal(value->lo.enclosure(), kDigits),
                     records::to_decimal(value->hi.enclosure(), kDigits));
}

std::string coverage_words(const cases::Case& c) {
  if (!c.coverage) return "exact coverage";
  return fmt::format("snapped to {} subpixel bits ({}), basis {}", c.coverage->subpixel_bits,
                     cases::name_of(c.coverage->rounding), cases::name_of(c.basis));
}

Result<void> print_table(const oracle::SceneTruth& scene, const Options& options) {
  const cases::Case& c = scene.source();
  constexpr std::string_view kRow = "{:>8} {:>5} {:>5} {:>3}  {:<9} {:<9} {:>11}  {:<28}";
  if (!options.quiet) {
    fmt::print("{}: {} x {} pixels, {} sample{}, {} rules, {}\n",
               c.name.empty() ? "(case)" : cases::printable(c.name), c.framebuffer.width,
               c.framebuffer.height, c.framebuffer.samples, c.framebuffer.samples == 1 ? "" : "s",
               cases::name_of(c.rules), coverage_words(c));
    std::string header =
        fmt::format(kRow, "triangle", "x", "y", "s", "verdict", "reason", "distance/px", "depth");
    for (const cases::Attribute& a : c.attributes)
      header += fmt::format(" {:<28}", cases::printable(a.name));
    header.erase(header.find_last_not_of(' ') + 1);
    fmt::print("{}\n", header);
  }
  std::size_t required = 0;
  std::size_t permitted = 0;
  auto checked = for_each_checked(scene, [&](const Fragment& f, const TriangleTruth& truth) {
    ++(f.decision.verdict == records::Verdict::required ? required : permitted);
    const auto distance = truth.distance(static_cast<int>(f.place.x), static_cast<int>(f.place.y),
                                         static_cast<int>(f.place.sample));
    std::string row =
        fmt::format(kRow, f.place.triangle, f.place.x, f.place.y, f.place.sample,
                    to_string(f.decision.verdict), to_string(f.decision.reason),
                    distance ? records::to_decimal(*distance, 5) : "-", readable(f.depth));
    for (const auto& value : f.attributes) row += fmt::format(" {:<28}", readable(value));
    row.erase(row.find_last_not_of(' ') + 1);
    fmt::print("{}\n", row);
  });
  if (!options.quiet) {
    fmt::print("{} fragments: {} required, {} permitted\n", required + permitted, required,
               permitted);
  }
  return checked;
}

ExitCode run(const Options& options) {
  if (cases::is_mesh_file(options.file)) {
    return fail({options.file, "", "is a mesh, not a case; convert it with rastercheck import"});
  }
  Result<cases::Case> c = cases::read_case(options.file);
  if (c && options.clip) c = oracle::to_clip_case(*c, options.file);
  if (!c) return fail(c.error());
  if (const auto few = check_sample_count(*c, options.file, options.all); !few) {
    return fail(few.error());
  }
  const oracle::SceneTruth scene(*c, cases::contract_of(*c));
  const auto checked = options.json ? print_json(scene, options) : print_table(scene, options);
  return checked ? ExitCode::ok : fail_internally(checked.error());
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("CASE", options->file, "Case file; - reads standard input")
      ->type_name(kFile)
      ->required();
  app.add_flag("--clip", options->clip,
               "Use clip positions rounded to float32, as backends receive them");
  CLI::Option* json = app.add_flag("--json", options->json,
                                   "Print the fragments as JSON, with values as fractions");
  app.add_flag("--details", options->details,
               "With --json: also print distances to the edges, derivatives and condition numbers")
      ->needs(json);
  app.add_flag("--all", options->all, "Allow more than 2^26 samples");
  app.add_flag("-q,--quiet", options->quiet,
               "Print only the fragments, without header and summary");
  app.footer(
      "Lists every sample that must be drawn (required) or may be drawn (permitted), with its "
      "exact depth and attributes.\n\n"
      "Example:\n"
      "  rastercheck oracle cases/corpus/behind-the-eye.json");
  return [options] { return run(*options); };
}

const Registration kRegistration("oracle", "Print exactly what must be drawn for a case", &set_up);

}  // namespace
}  // namespace rastercheck::cli::oracle_command
