// `rastercheck deqp LOG`: a second opinion on dEQP's tests of rasterization.

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "backends/api_promise.h"
#include "cases/case_writer.h"
#include "cases/child_process.h"
#include "cases/deqp_log.h"
#include "cases/files.h"
#include "cases/json.h"
#include "cases/names.h"
#include "cases/picture_view.h"
#include "cases/picture_writer.h"
#include "cli/command.h"
#include "cli/contract_option.h"
#include "cli/output.h"
#include "cli/picture_option.h"
#include "oracle/picture_judge.h"
#include "reports/text_table.h"

namespace rastercheck::cli::deqp_command {
namespace {

using cases::DeqpDrawing;
using cases::DeqpTest;
using nlohmann::json;

/// The smallest number of subpixel bits that OpenGL and Vulkan allow.
constexpr int kLeastSubpixelBits = 4;

struct Options {
  std::string file;
  std::optional<int> subpixel_bits;
  std::optional<cases::DriverPromise> promise;
  std::string save;
  bool json = false;
  bool quiet = false;
};

/// This program's opinion about a test's result.
enum class Opinion { same, opposite, none };

struct JudgedTest {
  const DeqpTest* test = nullptr;
  Opinion opinion = Opinion::none;
  std::uint64_t pixels = 0;
  std::uint64_t wrong = 0;
  std::string reason;  ///< why there is no opinion
};

/// Decodes the bytes of a PNG file in a separate process.
Result<cases::PictureFile> picture_of_png(const std::string& bytes, const std::string& file) {
  // The file is not closed on exec, because the process that reads it inherits the descriptor.
  const cases::Descriptor memory(::memfd_create("picture", 0));
  if (!memory.is_open()) return tl::unexpected(Error{file, "", "no memory for a picture"});
  const std::string name = fmt::format("/proc/self/fd/{}", memory.number());
  if (::write(memory.number(), bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
    return tl::unexpected(Error{file, "", "no memory for a picture"});
  }
  return picture_from_file(name, false).map_error([&file](Error error) {
    error.file = file;
    return error;
  });
}

Result<cases::PictureFile> picture_of(const cases::DeqpImage& image, const std::string& file) {
  cases::PictureFile picture;
  if (image.is_png) {
    Result<cases::PictureFile> read = picture_of_png(image.bytes, file);
    if (!read) return read;
    picture = *std::move(read);
  } else {
    picture.width = image.width;
    picture.height = image.height;
    picture.channels = cases::default_channel_names(static_cast<std::size_t>(image.channels));
    picture.stored.assign(picture.channels.size(), cases::Storage::unorm8);
    for (const char byte : image.bytes) {
      picture.values.push_back(static_cast<float>(static_cast<unsigned char>(byte)));
    }
  }
  const bool fits = picture.width == image.width && picture.height == image.height &&
                    picture.channels.size() == static_cast<std::size_t>(image.channels) &&
                    picture.values.size() == picture.value_count();
  if (!fits)
    return tl::unexpected(Error{file, "", "the picture has not the size that the log says"});
  return picture;
}

/// The API's promise for the case, widened by the uncertainty of the log's numbers.
cases::Contract contract_for(const cases::Case& c, int subpixel_bits, cases::DriverPromise promise,
                             const cases::DeqpUncertainty& open) {
  cases::Contract contract = backends::api_promise(c, {subpixel_bits}, promise);
  const auto no_less = [](double sum) {
    return sum == 0 ? 0.0F
                    : std::nextafter(static_cast<float>(sum), std::numeric_limits<float>::max());
  };
  const double units = std::ldexp(open.pixels, subpixel_bits);
  const auto widen = [&](float& position_error, cases::ValueBounds& bounds) {
    position_error = no_less(double{position_error} + units);
    bounds.smooth.range_share = no_less(double{bounds.smooth.range_share} + open.weights);
  };
  if (units > 0 || open.weights > 0) {
    widen(contract.coverage->position_error, contract.bounds);
    for (cases::TrianglePromise& one : contract.triangles) widen(one.position_error, one.bounds);
  }
  return contract;
}

/// Returns a file name for a test's drawing: the test's path, with `_` for unusual characters.
std::string file_name_of(const DeqpTest& test, std::size_t number) {
  std::string name = test.path.substr(0, 200);
  for (char& c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
    if (!is_plain) c = '_';
  }
  return fmt::format("{}-{}", name, number);
}

/// Judges one drawing and adds its pixels to `judged`. Returns why it cannot be judged, or "".
Result<std::string> judge_drawing(const Options& options, const DeqpDrawing& drawing,
                                  const std::string& name, JudgedTest& judged) {
  const DeqpTest& test = *judged.test;
  const std::string file = options.file + ": " + test.path;
  const auto picture = picture_of(drawing.image, file);
  if (!picture) return tl::unexpected(picture.error());
  const cases::Case c = cases::case_of(test, drawing);
  const auto view = cases::view_of(c, *c.picture, *picture, file);
  if (!view) return tl::unexpected(view.error());
  const int bits = options.subpixel_bits.value_or(test.subpixel_bits.value_or(kLeastSubpixelBits));
  const auto open = cases::uncertainty_of(drawing);
  // A contract's position error is at most kMaxPositionError. The log's uncertainty may use half of
  // it, because the promise has an error of its own.
  if (!open || std::ldexp(open->pixels, bits) > cases::kMaxPositionError / 2) {
    return std::string("the log has too few digits of a small w");
  }
  const oracle::SceneTruth scene(
      c, contract_for(c, bits, options.promise.value_or(cases::DriverPromise::spec), *open));
  const records::JudgedPicture found = oracle::judge_picture(scene, *view, *picture);
  judged.pixels += found.pixels.size();
  judged.wrong += found.wrong();
  if (!options.save.empty()) {
    const auto path = (std::filesystem::path(options.save) / name).string();
    const auto saved = cases::write_file(path + ".json", cases::to_json(c)).and_then([&] {
      return cases::write_picture(*picture, path + ".png");
    });
    if (!saved) return tl::unexpected(saved.error());
  }
  if (found.wrong() == 0 && found.count(records::PixelVerdict::not_judged) > 0) {
    return std::string("nothing is promised about a triangle");
  }
  return std::string();
}

Opinion opinion_of(const std::string& status, std::uint64_t wrong) {
  // dEQP gives warnings only about how lines are drawn, so such a test passed.
  const bool passed = status == "Pass" || status.ends_with("Warning");
  if (!passed && status != "Fail") return Opinion::none;
  return passed == (wrong == 0) ? Opinion::same : Opinion::opposite;
}

Result<JudgedTest> judge_test(const Options& options, const DeqpTest& test) {
  JudgedTest judged{&test, Opinion::none, 0, 0, test.reason};
  if (!judged.reason.empty()) return judged;
  std::size_t number = 0;
  for (const DeqpDrawing& drawing : test.drawings) {
    const std::string name = file_name_of(test, ++number);
    Result<std::string> reason = judge_drawing(options, drawing, name, judged);
    if (!reason) return tl::unexpected(reason.error());
    if (judged.reason.empty()) judged.reason = *std::move(reason);
  }
  // If some pixels were not judged, only a wrong pixel gives a sure opinion.
  if (!judged.reason.empty() && judged.wrong == 0) return judged;
  judged.reason.clear();
  judged.opinion = opinion_of(test.status, judged.wrong);
  if (judged.opinion == Opinion::none) judged.reason = "the test has not finished";
  return judged;
}

std::string_view name_of(Opinion opinion) {
  switch (opinion) {
    case Opinion::same:
      return "agrees";
    case Opinion::opposite:
      return "disagrees";
    case Opinion::none:
      break;
  }
  return "not judged";
}

std::string text_of(const std::vector<JudgedTest>& tests, bool is_brief) {
  std::string text;
  std::array<std::size_t, 3> counts{};
  for (const JudgedTest& one : tests) {
    ++counts[static_cast<std::size_t>(one.opinion)];
    const std::string& told = one.test->status;
    const std::string status = told.empty() ? "unfinished" : told;
    text += fmt::format("{:<10}  {}: {}\n", name_of(one.opinion), cases::printable(one.test->path),
                        cases::printable(status));
    text += one.opinion == Opinion::none
                ? fmt::format("{:12}{}\n", "", one.reason)
                : fmt::format("{:12}{} of {} pixels are wrong\n", "", one.wrong, one.pixels);
  }
  if (is_brief) return text;
  return text +
         fmt::format("\n{} tests: agrees with dEQP on {}, disagrees on {}, no opinion on {}.\n",
                     tests.size(), counts[0], counts[1], counts[2]);
}

std::string json_of(const std::vector<JudgedTest>& tests) {
  json list = json::array();
  for (const JudgedTest& one : tests) {
    json entry{{"test", one.test->path},
               {"status", one.test->status},
               {"opinion", name_of(one.opinion)},
               {"pixels", one.pixels},
               {"wrong", one.wrong}};
    if (!one.reason.empty()) entry["reason"] = one.reason;
    list.push_back(std::move(entry));
  }
  return json{{"format", "rastercheck-deqp-opinion"}, {"version", 1}, {"tests", list}}.dump(
      -1, ' ', false, json::error_handler_t::replace);
}

ExitCode run(const Options& options) {
  const Result<std::vector<DeqpTest>> tests =
      cases::read_text(options.file).and_then([&](const std::string& text) {
        return cases::parse_deqp_log(text, options.file);
      });
  if (!tests) return fail(tests.error());
  if (!options.save.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.save, error);
    if (error) return fail({options.save, "", error.message()});
  }
  std::vector<JudgedTest> judged;
  bool has_opinion = false;
  bool disagrees = false;
  for (const DeqpTest& test : *tests) {
    Result<JudgedTest> one = judge_test(options, test);
    if (!one) return fail(one.error());
    has_opinion = has_opinion || one->opinion != Opinion::none;
    disagrees = disagrees || one->opinion == Opinion::opposite;
    judged.push_back(*std::move(one));
  }
  fmt::print("{}", options.json ? json_of(judged) + "\n" : text_of(judged, options.quiet));
  if (disagrees) return ExitCode::violated;
  return has_opinion ? ExitCode::ok : ExitCode::nothing_checked;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("LOG", options->file, "Log of dEQP (.qpa); - reads standard input")
      ->type_name(kFile)
      ->required();
  app.add_option("--subpixel-bits", options->subpixel_bits,
                 "Subpixel bits of the GPU; default: as the log says, or 4, the least allowed")
      ->check(CLI::Range(0, cases::kMaxSubpixelBits))
      ->type_name("N");
  add_promise(app, options->promise)
      ->description("What numbers are held to; default: spec, the text of OpenGL and Vulkan");
  app.add_option("--save", options->save,
                 "Write the case and the picture of each drawing that is judged to this folder")
      ->type_name(kFolder);
  app.add_flag("--json", options->json, "Print the opinions as JSON");
  app.add_flag("-q,--quiet", options->quiet, "Print only the tests");
  app.footer(
      "Reads the triangles and the pictures of dEQP's tests of rasterization and interpolation, "
      "and says of each whether dEQP's verdict is right: it passes if no pixel is wrong by what "
      "the API promises.\n\n"
      "Exit codes: 0 agrees with all verdicts that it can judge, 1 disagrees with some, 2 usage or "
      "unreadable input, 5 nothing could be judged.\n\n"
      "Example:\n"
      "  rastercheck deqp TestResults.qpa --save judged");
  return [options] { return run(*options); };
}

const Registration kRegistration("deqp", "Give a second opinion on dEQP's rasterization tests",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::deqp_command
