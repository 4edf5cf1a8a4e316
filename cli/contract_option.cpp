#include "cli/contract_option.h"

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

Result<std::optional<cases::ContractTerms>> read_terms(const std::string& file) {
  if (file.empty()) return std::nullopt;
  return cases::read_contract(file);
}

}  // namespace rastercheck::cli
