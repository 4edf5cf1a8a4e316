// `rastercheck oracle CASE`: the exact answer of a case.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "cases/case_reader.h"
#include "cases/names.h"
#include "cli/command.h"
#include "cli/output.h"
#include "oracle/fragments.h"
#include "oracle/transform.h"

namespace rastercheck::cli {
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

/// More samples than this are asked for by --all, so that nobody waits for them by mistake.
constexpr std::int64_t kManySamples = std::int64_t{1} << 26;

std::int64_t sample_count(const cases::FramebufferSize& size) {
  return std::int64_t{size.width} * size.height * size.samples;
}

// --- JSON: CONTRACT, `oracle` and `render` output ------------------------------------------------

std::string json_value(const std::optional<ValueRange>& value) {
  if (!value) return "null";
  if (!value->is_open) return fmt::format("\"{}\"", value->lo.to_string());
  return fmt::format(R"(["{}", "{}"])", value->lo.to_string(), value->hi.to_string());
}

/// An end of an enclosure; JSON has no infinities, null is "no bound".
std::string json_double(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

std::string json_rational(const std::optional<oracle::Rational>& value) {
  return value ? fmt::format("\"{}\"", value->to_string()) : "null";
}

/// What --details adds to a fragment.
std::string json_details(const cases::Case& c, const Fragment& f, const TriangleTruth& truth) {
  const auto distance = truth.distance(f.x, f.y, f.sample);
  std::string text = fmt::format(
      R"(, "distance": {})",
      distance ? fmt::format("[{}, {}]", json_double(distance->lo), json_double(distance->hi))
               : "null");
  std::string derivatives;
  std::string kappa;
  std::string kappa_d;
  for (std::size_t a = 0; a < c.attributes.size(); ++a) {
    const std::string_view comma = a == 0 ? "" : ", ";
    const auto d = truth.derivatives(a, f.x, f.y, f.sample);
    derivatives += fmt::format(
        "{}{}", comma,
        d ? fmt::format(R"(["{}", "{}"])", d->du.to_string(), d->dv.to_string()) : "null");
    const auto k = truth.conditioning(a, f.x, f.y, f.sample);
    kappa += fmt::format("{}{}", comma, k ? json_rational(k->kappa) : "null");
    kappa_d += fmt::format("{}{}", comma, k ? json_rational(k->kappa_d) : "null");
  }
  return text + fmt::format(R"(, "derivatives": [{}], "kappa": [{}], "kappa_d": [{}])", derivatives,
                            kappa, kappa_d);
}

void print_json(const oracle::SceneTruth& scene, const Options& options) {
  const cases::Case& c = scene.source();
  fmt::print(R"({{"format": "rastercheck-oracle", "version": 1, "case": {}, "fragments": [)",
             json_string(c.name));
  std::string_view separator = "\n  ";
  oracle::for_each_fragment(scene, [&](const Fragment& f, const TriangleTruth& truth) {
    std::string attributes;
    for (const auto& value : f.attributes) {
      attributes += fmt::format("{}{}", attributes.empty() ? "" : ", ", json_value(value));
    }
    fmt::print(R"({}{{"triangle": {}, "x": {}, "y": {}, "sample": {}, "verdict": "{}", )"
               R"("reason": "{}", "depth": {}, "attributes": [{}]{}}})",
               separator, f.triangle, f.x, f.y, f.sample, to_string(f.judgment.verdict),
               to_string(f.judgment.reason), json_value(f.depth), attributes,
               options.details ? json_details(c, f, truth) : "");
    separator = ",\n  ";
    return std::ferror(stdout) == 0;
  });
  fmt::print("\n]}}\n");
}

// --- A table for people --------------------------------------------------------------------------

constexpr int kDigits = 9;  // a float32 is told from its neighbours by nine

/// The exact value where it is short enough to be read, else a decimal of which each digit counts.
std::string readable(const oracle::Rational& value) {
  constexpr std::size_t kReadable = 15;
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

void print_table(const oracle::SceneTruth& scene, const Options& options) {
  const cases::Case& c = scene.source();
  constexpr std::string_view kRow = "{:>8} {:>5} {:>5} {:>3}  {:<9} {:<9} {:>11}  {:<24}";
  if (!options.quiet) {
    fmt::print("{}: {} x {} pixels, {} sample{}, {} rules, {}\n",
               c.name.empty() ? "(case)" : c.name, c.framebuffer.width, c.framebuffer.height,
               c.framebuffer.samples, c.framebuffer.samples == 1 ? "" : "s",
               cases::name_of(c.rules), coverage_words(c));
    std::string header =
        fmt::format(kRow, "triangle", "x", "y", "s", "verdict", "reason", "distance/px", "depth");
    for (const cases::Attribute& a : c.attributes) header += fmt::format(" {:<24}", a.name);
    header.erase(header.find_last_not_of(' ') + 1);
    fmt::print("{}\n", header);
  }
  std::size_t required = 0;
  std::size_t permitted = 0;
  oracle::for_each_fragment(scene, [&](const Fragment& f, const TriangleTruth& truth) {
    ++(f.judgment.verdict == records::Verdict::required ? required : permitted);
    const auto distance = truth.distance(f.x, f.y, f.sample);
    std::string row =
        fmt::format(kRow, f.triangle, f.x, f.y, f.sample, to_string(f.judgment.verdict),
                    to_string(f.judgment.reason),
                    distance ? records::to_decimal(*distance, 5) : "-", readable(f.depth));
    for (const auto& value : f.attributes) row += fmt::format(" {:<24}", readable(value));
    row.erase(row.find_last_not_of(' ') + 1);
    fmt::print("{}\n", row);
    return std::ferror(stdout) == 0;
  });
  if (!options.quiet) {
    fmt::print("{} fragments: {} required, {} permitted\n", required + permitted, required,
               permitted);
  }
}

ExitCode run(const Options& options) {
  Result<cases::Case> c = cases::read_case(options.file);
  if (c && options.clip) c = oracle::to_clip_case(*c, options.file);
  if (!c) return fail(c.error());
  const std::int64_t samples = sample_count(c->framebuffer);
  if (samples > kManySamples && !options.all) {
    return fail({options.file, "/framebuffer",
                 fmt::format("{} samples are more than 2^26; --all looks at them", samples)});
  }
  const oracle::SceneTruth scene(*c, cases::contract_of(*c));
  if (options.json) {
    print_json(scene, options);
  } else {
    print_table(scene, options);
  }
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("CASE", options->file, "Case file; - reads standard input")->required();
  app.add_flag("--clip", options->clip,
               "Of the clip positions rounded once to float32, as backends are handed them");
  app.add_flag("--json", options->json, "The fragments as JSON, values as fractions");
  app.add_flag("--details", options->details,
               "With --json: distance to the boundary, derivatives and condition numbers too");
  app.add_flag("--all", options->all, "Also where the framebuffer has more than 2^26 samples");
  app.add_flag("-q,--quiet", options->quiet, "No header and no summary");
  app.footer("Lists every sample that has to be drawn (required) or may be (permitted).");
  return [options] { return run(*options); };
}

const Registration kRegistration("oracle", "The exact answer of a case", &set_up);

}  // namespace
}  // namespace rastercheck::cli
