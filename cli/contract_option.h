#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cases/contract_terms.h"
#include "cases/error.h"

namespace rastercheck::cli {

/// The option `--contract FILE` of commands that judge; empty without it.
CLI::Option* add_contract(CLI::App& app, std::string& file);

/// Reads that file, if there is one, and from now on holds all backends to it.
Result<cases::ContractTerms> hold_backends_to(const std::string& file);

}  // namespace rastercheck::cli
