#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "cases/contract_terms.h"
#include "cases/error.h"

namespace rastercheck::cli {

/// Adds the option `--contract FILE` to a command that judges; `file` stays empty without the
/// option.
CLI::Option* add_contract(CLI::App& app, std::string& file);

/// Adds the option `--promise NAME` to a command that judges; `promise` stays empty without the
/// option.
CLI::Option* add_promise(CLI::App& app, std::optional<cases::DriverPromise>& promise);

/// Reads the contract file, if any; `promise`, if given, replaces the file's.
Result<std::optional<cases::ContractTerms>> read_terms(const std::string& file,
                                                       std::optional<cases::DriverPromise> promise);

}  // namespace rastercheck::cli
