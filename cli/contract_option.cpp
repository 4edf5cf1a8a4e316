#include "cli/contract_option.h"

#include "cases/contract_json.h"
#include "cli/command.h"
#include "records/plan.h"

namespace rastercheck::cli {

CLI::Option* add_contract(CLI::App& app, std::string& file) {
  return app
      .add_option("--contract", file,
                  "Contract file to judge backends by, instead of their own promises (rastercheck "
                  "probe --contract-out writes one); - reads standard input")
      ->type_name(kFile);
}

CLI::Option* add_promise(CLI::App& app, std::optional<cases::DriverPromise>& promise) {
  constexpr auto names = names_of(cases::DriverPromise{});
  return app
      .add_option_function<std::string>(
          "--promise",
          [&promise](const std::string& name) {
            promise = cases::from_name<cases::DriverPromise>(name);
          },
          "What drivers must satisfy: spec, the text of OpenGL and Vulkan; conformance, the limits "
          "of Khronos' conformance tests; ieee, float32 arithmetic; default: ieee for drivers that "
          "draw on the processor, else conformance")
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())))
      ->type_name("NAME");
}

Result<std::optional<cases::ContractTerms>> read_terms(
    const std::string& file, std::optional<cases::DriverPromise> promise) {
  std::optional<cases::ContractTerms> terms;
  if (!file.empty()) {
    Result<cases::ContractTerms> read = cases::read_contract(file);
    if (!read) return tl::unexpected(read.error());
    terms = *std::move(read);
  }
  return records::with_promise(std::move(terms), promise);
}

}  // namespace rastercheck::cli
