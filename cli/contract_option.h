#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "cases/contract_terms.h"
#include "cases/error.h"

namespace rastercheck::cli {

/// The option `--contract FILE` of commands that judge; empty without it.
CLI::Option* add_contract(CLI::App& app, std::string& file);

/// Reads that file, if there is one.
Result<std::optional<cases::ContractTerms>> read_terms(const std::string& file);

}  // namespace rastercheck::cli
