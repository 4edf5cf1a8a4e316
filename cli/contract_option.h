#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "cases/contract_terms.h"
#include "cases/error.h"

namespace rastercheck::cli {

/// The option `--contract FILE` of commands that judge; empty without it.
CLI::Option* add_contract(CLI::App& app, std::string& file);

/// The option `--promise NAME` of commands that judge; nothing without it.
CLI::Option* add_promise(CLI::App& app, std::optional<cases::DriverPromise>& promise);

/// Reads that file, if there is one, and puts the promise in place of its own.
Result<std::optional<cases::ContractTerms>> read_terms(const std::string& file,
                                                       std::optional<cases::DriverPromise> promise);

}  // namespace rastercheck::cli
