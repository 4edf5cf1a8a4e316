// case: a case file, with --round for one whose numbers are decimals.

#include <fmt/format.h>

#include "cases/case_reader.h"
#include "cases/importer.h"
#include "cases/json_node.h"

namespace rastercheck::cases::case_file_importer {
namespace {

bool recognises(std::string_view text) {
  constexpr std::size_t kBeginning = 1000;
  return text.substr(0, kBeginning).find("\"rastercheck-case\"") != std::string_view::npos;
}

Result<Imported> import(std::string_view text, const std::string& file,
                        const ImportOptions& options) {
  ImportOptions only_round;
  only_round.round = options.round;
  if (options != only_round) {
    return tl::unexpected(Error{file, "", "is a case, which takes no option but --round"});
  }
  DecimalRounding rounding{options.round};
  return parse_case(text, file, rounding).map([&](Case&& c) {
    Imported imported{std::move(c), {}};
    if (rounding.rounded > 0) {
      imported.notes.push_back(fmt::format("{} number{} rounded to the nearest float32",
                                           rounding.rounded, rounding.rounded == 1 ? "" : "s"));
    }
    return imported;
  });
}

const ImporterRegistration kRegistration(
    {"case", "a case file; with --round, one whose numbers are decimals", &recognises, &import});

}  // namespace
}  // namespace rastercheck::cases::case_file_importer
