#include "cases/error_json.h"

#include <nlohmann/json.hpp>

namespace rastercheck::cases {

nlohmann::json error_to_json(const Error& error) {
  return {{"error", {{"file", error.file}, {"place", error.place}, {"reason", error.reason}}}};
}

Error error_from_json(const JsonNode& node) {
  node.expect_object({"error"});
  const JsonNode inner = node["error"];
  inner.expect_object({"file", "place", "reason"});
  Error error{inner["file"].text(), inner["place"].text(), inner["reason"].text()};
  if (error.reason.empty()) inner["reason"].refuse("must not be empty");
  return error;
}

}  // namespace rastercheck::cases
