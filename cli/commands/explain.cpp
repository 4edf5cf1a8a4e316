// `rastercheck explain CASE --pixel X,Y`: shows how one sample was drawn, and the exact result.

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "cases/case_reader.h"
#include "cases/json.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/contract_option.h"
#include "cli/isolation.h"
#include "cli/sample_limit.h"
#include "cli/whole_number.h"
#include "properties/drawing.h"
#include "properties/inspect/case_to_draw.h"
#include "properties/inspect/focus.h"
#include "properties/inspect/inspect.h"
#include "records/inspection_json.h"
#include "reports/commands.h"
#include "reports/inspection_text.h"

namespace rastercheck::cli::explain_command {
namespace {

struct Pixel {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

struct Options {
  std::string file;
  std::optional<Pixel> pixel;
  std::optional<std::uint32_t> sample;
  std::optional<std::uint32_t> triangle;
  std::string backend;
  std::string attribute;
  std::string contract;
  std::optional<cases::DriverPromise> promise;
  double timeout = kDefaultTimeout;
  bool all = false;
  bool json = false;
  bool quiet = false;
};

constexpr const char* kDepth = "depth";
constexpr std::uint64_t kMostNumber = std::numeric_limits<std::uint32_t>::max();

/// Reads a pixel such as "3,5"; throws CLI::ValidationError for any other text.
Pixel pixel_of(const std::string& text) {
  const auto numbers = two_whole_numbers_in(text, ',');
  if (numbers && numbers->first <= kMostNumber && numbers->second <= kMostNumber) {
    return {static_cast<std::uint32_t>(numbers->first),
            static_cast<std::uint32_t>(numbers->second)};
  }
  throw CLI::ValidationError(
      "--pixel", fmt::format("{} is not X,Y, two whole numbers as in 3,5", cases::printable(text)));
}

/// Returns the request that the options describe; fails if the attribute does not exist.
Result<properties::FocusRequest> request_of(const Options& options, const cases::Case& c) {
  properties::FocusRequest request;
  request.triangle = options.triangle;
  request.sample = options.sample;
  if (options.pixel) {
    request.x = options.pixel->x;
    request.y = options.pixel->y;
  }
  if (options.attribute.empty()) return request;
  for (std::uint32_t i = 0; i < c.attributes.size(); ++i) {
    if (c.attributes[i].name != options.attribute) continue;
    request.attribute = i;
    return request;
  }
  request.is_depth = options.attribute == kDepth;
  if (request.is_depth) return request;
  return tl::unexpected(
      Error{options.file, "--attribute",
            fmt::format("there is no attribute '{}'", cases::printable(options.attribute))});
}

/// Returns the index of the value of a sample to show (0: the depth); empty, for all values, if
/// --attribute is not given.
std::optional<std::size_t> shown_value(const properties::FocusRequest& request) {
  if (request.attribute) return 1 + *request.attribute;
  return request.is_depth ? std::optional<std::size_t>(0) : std::nullopt;
}

Result<records::Inspection> inspect(const cases::Case& c, const properties::FocusRequest& request,
                                    const std::string& specification, backends::Backend& backend) {
  const Result<cases::ClipCase> clip = properties::case_to_draw(c);
  if (!clip) return tl::unexpected(clip.error());
  const Result<backends::Drawn> drawn = properties::draw(*clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  const properties::Focus focus = properties::find_focus(*clip, *drawn, request);
  Result<records::Inspection> inspection =
      properties::inspect(*clip, *drawn, focus, properties::trace_sample(*clip, focus.at, backend));
  if (!inspection) return inspection;
  inspection->occasion = records::Occasion::asked_for;
  inspection->backend = specification;
  if (c.found) inspection->law = c.found->law;
  return inspection;
}

/// The commands to try next. Standard input cannot be read twice.
std::string next_text(const Options& options, const std::string& specification,
                      const cases::SamplePlace& place) {
  if (options.file == "-") return "";
  const auto command = [&options](const char* name, const std::string& backend,
                                  const std::vector<std::string>& more) {
    std::vector<std::string> words{"rastercheck", name, options.file, "--backend", backend};
    words.insert(words.end(), more.begin(), more.end());
    if (!options.contract.empty()) words.insert(words.end(), {"--contract", options.contract});
    if (options.promise) {
      words.insert(words.end(), {"--promise", std::string(cases::name_of(*options.promise))});
    }
    return reports::command_line(words);
  };
  std::string text = "To try next:\n";
  text += "  all that is wrong with the case: " + command("replay", specification, {}) + "\n";
  if (specification != "cpu") {
    text += "  the same, drawn by cpu: " +
            command("explain", "cpu",
                    {"--pixel", fmt::format("{},{}", place.x, place.y), "--sample",
                     std::to_string(place.sample), "--triangle", std::to_string(place.triangle)}) +
            "\n";
  }
  return text;
}

ExitCode run(const Options& options) {
  const auto terms = read_terms(options.contract, options.promise);
  if (!terms) return fail(terms.error());
  const Result<cases::Case> c = cases::read_case(options.file);
  if (!c) return fail(c.error());
  if (const auto few = check_sample_count(*c, options.file, options.all); !few) {
    return fail(few.error());
  }
  const Result<properties::FocusRequest> request = request_of(options, *c);
  if (!request) return fail(request.error());
  std::string specification = options.backend;
  if (specification.empty()) specification = c->found ? c->found->backend : "cpu";
  const auto backend = backend_factory(options.timeout, *terms).make(specification);
  if (!backend) return fail_backend(backend.error());
  const Result<records::Inspection> found = inspect(*c, *request, specification, **backend);
  if (!found) return fail({options.file, found.error().place, found.error().reason});
  if (options.json) {
    fmt::print("{}\n", cases::json_line(cases::json_of(*found)));
  } else {
    fmt::print("{}", reports::inspection_text(*found, shown_value(*request)));
    if (!options.quiet) {
      fmt::print("\n{}\n{}", reports::inspection_legend(),
                 next_text(options, specification, found->place));
    }
  }
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("CASE", options->file, "Case file or counterexample; - reads standard input")
      ->type_name(kFile)
      ->required();
  app.add_option_function<std::string>(
         "--pixel", [options](const std::string& text) { options->pixel = pixel_of(text); },
         "Pixel; default: that of the worst sample of the case")
      ->type_name("X,Y");
  app.add_option("--sample", options->sample,
                 "Number of the sample, from 0; default: the worst of the pixel")
      ->transform(whole_number(kMostNumber))
      ->type_name("N");
  app.add_option("--triangle", options->triangle,
                 "Number of the triangle, from 0; default: one that is drawn there, or must be")
      ->transform(whole_number(kMostNumber))
      ->type_name("N");
  app.add_option("--backend", options->backend,
                 "What draws; default: the backend of a counterexample, else cpu")
      ->type_name(kBackend);
  app.add_option("--attribute", options->attribute,
                 "Only this value: an attribute's name, or depth")
      ->type_name("NAME");
  add_contract(app, options->contract);
  add_promise(app, options->promise);
  add_timeout(app, options->timeout);
  app.add_flag("--all", options->all, "Allow more than 2^26 samples");
  app.add_flag("--json", options->json, "Print it as JSON, with the pixels around");
  app.add_flag("-q,--quiet", options->quiet, "Omit the explanation of the numbers");
  app.footer(
      "The triangle is drawn alone: a depth test has no say. A case with a camera is drawn from "
      "its clip positions, rounded to float32.\n\n"
      "Example:\n"
      "  rastercheck explain cases/corpus/behind-the-eye.json --pixel 3,5");
  return [options] { return run(*options); };
}

const Registration kRegistration("explain",
                                 "Explain one sample: what is right, what was drawn, and why",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::explain_command
