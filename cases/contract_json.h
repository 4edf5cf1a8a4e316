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

/// One key a line; numbers in decimal, as exactly those floats.
std::string to_json(const ContractTerms& terms);

/// Tells terms apart that are not the same, whatever their names and however files say them.
std::uint64_t digest_of(ContractTerms terms);

/// Refuses unknown keys, and what no contract has.
ContractTerms read_contract_terms(const JsonNode& root);
/// For records that have such terms (json_members.h).
void write_value(nlohmann::json& to, const ContractTerms& terms);
void read_value(const JsonNode& node, ContractTerms& terms);
Result<ContractTerms> parse_contract(std::string_view text, const std::string& file);
/// "-" is standard input.
Result<ContractTerms> read_contract(const std::string& file);

}  // namespace rastercheck::cases
