#pragma once

// Contract files: JSON, "rastercheck-contract", version 1. cases/schema/contract.schema.json says
// what each key means; all but "format" and "version" are optional.

#include <cstdint>
#include <string>
#include <string_view>

#include "cases/contract_terms.h"
#include "cases/error.h"
#include "cases/json_node.h"

namespace rastercheck::cases {

/// Formats one key per line, and numbers in decimal that read back as exactly the same floats.
std::string to_json(const ContractTerms& terms);

/// A hash of the terms that ignores their name and the way the file writes them.
std::uint64_t digest_of(ContractTerms terms);

/// Refuses unknown keys, and values that no contract can have.
ContractTerms read_contract_terms(const JsonNode& root);
/// For records that contain terms (json_members.h).
void write_value(nlohmann::json& to, const ContractTerms& terms);
void read_value(const JsonNode& node, ContractTerms& terms);
Result<ContractTerms> parse_contract(std::string_view text, const std::string& file);
/// Reads a contract file, or standard input for "-".
Result<ContractTerms> read_contract(const std::string& file);

}  // namespace rastercheck::cases
