#include "cli/contract_option.h"

#include "backends/held_backend.h"
#include "cases/contract_json.h"
#include "cli/command.h"

namespace rastercheck::cli {

CLI::Option* add_contract(CLI::App& app, std::string& file) {
  return app
      .add_option("--contract", file,
                  "File of what backends are held to, instead of what they promise "
                  "themselves (rastercheck probe --contract-out writes one); - reads "
                  "standard input")
      ->type_name(kFile);
}

Result<cases::ContractTerms> hold_backends_to(const std::string& file) {
  if (file.empty()) return cases::ContractTerms{};
  Result<cases::ContractTerms> terms = cases::read_contract(file);
  if (terms) backends::hold_backends_to(*terms);
  return terms;
}

}  // namespace rastercheck::cli
